#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/couette/figures.hpp"

namespace crossgrain::reports {

namespace {

constexpr double mostMargins = 5.0;  ///< of an axis: who is beyond it is beyond it

/// An engine minus the reference, ring by ring, in margins; bars are ± half the ring's interval.
Curve differenceCurve(const CouetteFrame& frame, const AgreementRow& row,
                      const EngineRuns& engine) {
  Curve curve{engine.name, engine.style, Draw::linesAndPoints, {}, 1.5};
  const double sign = row.b == engine.name ? 1.0 : -1.0;
  for (const AgreementRing& ring : row.rings) {
    const auto x = at(binPlaces(frame), ring.ring), difference = finite(ring.difference),
               margin = finite(ring.margin);
    if (!x || !difference || !margin || *margin <= 0.0) continue;
    Point point{*x, sign * *difference / *margin, {}};
    if (const auto low = finite(ring.low), high = finite(ring.high); low && high)
      point.error = 0.5 * (*high - *low) / *margin;
    point.place = fmt::format("{} {}", binWord(frame), ring.ring + 1);
    curve.points.push_back(std::move(point));
  }
  return curve;
}

std::optional<Range> marginRange(const Panel& panel) {
  double most = 1.5;
  for (const Curve& curve : panel.curves)
    for (const Point& point : curve.points) most = std::max(most, 1.1 * std::abs(point.y));
  most = std::min(most, mostMargins);
  return Range{-most, most};
}

}  // namespace

std::vector<Figure> differenceFigures(const CompareResults& results,
                                      const std::vector<EngineRuns>& engines) {
  std::vector<Figure> figures;
  if (engines.empty()) return figures;
  const std::string& reference = engines.front().name;
  std::vector<std::string> fields;
  for (const AgreementRow& row : results.agreement)
    if (std::ranges::find(fields, row.field) == fields.end()) fields.push_back(row.field);
  for (const std::string& field : fields) {
    Panel panel;
    for (const EngineRuns& engine : engines)
      for (const AgreementRow& row : results.agreement)
        if (row.field == field && ((row.a == reference && row.b == engine.name) ||
                                   (row.b == reference && row.a == engine.name)))
          if (Curve curve = differenceCurve(results, row, engine); !curve.points.empty())
            panel.curves.push_back(std::move(curve));
    if (panel.curves.empty()) continue;
    panel.xLabel = binAxis(results);
    panel.yLabel = fmt::format("difference of {} [margins]", fieldWords(field));
    panel.xRange = rTildeRange(results);
    panel.yRange = marginRange(panel);
    panel.band = Range{-1.0, 1.0};
    panel.level = 0.0;
    Figure figure;
    figure.name = "difference_" + field;
    figure.title = fmt::format("Difference of the {} from that of {}, in margins",
                               fieldWords(field), reference);
    figure.caption = fmt::format(
        "{} minus that of {}, in the {}'s margin; blue: within it. Bars: ± half the interval "
        "that the {}'s colour rests on{}.",
        fieldWords(field), reference, binWord(results), binWord(results),
        panel.yRange->high == mostMargins
            ? fmt::format("; what lies beyond {:g} margins is off the axis", mostMargins)
            : "");
    figure.caption[0] =
        static_cast<char>(std::toupper(static_cast<unsigned char>(figure.caption[0])));
    figure.panels.push_back(std::move(panel));
    figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace crossgrain::reports
