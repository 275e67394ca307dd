#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/sentences.hpp"
#include "reports/flow/endpoint_text.hpp"
#include "reports/flow/figures.hpp"

namespace crossgrain::reports {

namespace {

constexpr double mostMargins = 5.0;  ///< of an axis: what lies beyond is marked at its end

/// An engine minus the reference, ring by ring, in margins; bars are ± half the ring's interval.
Curve differenceCurve(const FlowFrame& frame, const AgreementRow& row, const EngineRuns& engine) {
  Curve curve{engine.name, engine.style, Draw::linesAndPoints, {}, 1.5};
  const double sign = row.b == engine.name ? 1.0 : -1.0;
  for (const AgreementRing& ring : row.rings) {
    const auto x = at(binPlaces(frame), ring.ring), difference = finite(ring.difference),
               margin = finite(ring.margin);
    if (!x || !difference || !margin || *margin <= 0.0) continue;
    Point point{*x, sign * *difference / *margin, {}};
    if (const auto low = finite(ring.low), high = finite(ring.high); low && high)
      point.error = 0.5 * (*high - *low) / *margin;
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

/// Where a curve lies beyond the axis: a triangle at its end for each point, the farthest with its
/// number. @param above  at the upper end, else at the lower
std::optional<Curve> beyondTheAxis(const Panel& panel, const Curve& curve, bool above) {
  constexpr int upward = 9, downward = 11;  // gnuplot's filled triangles
  const double end = panel.yRange->high, sign = above ? 1.0 : -1.0;
  Curve marks{"", curve.style, Draw::points, {}, curve.width};
  marks.style.pointType = above ? upward : downward;
  double farthest = 0.0;
  std::size_t at = 0;
  for (const Point& point : curve.points) {
    const double distance = sign * point.y;
    if (distance <= end) continue;
    if (distance > farthest) at = marks.points.size();
    farthest = std::max(farthest, distance);
    marks.points.push_back({point.x, 0.97 * sign * end, {}});
  }
  if (marks.points.empty()) return std::nullopt;
  marks.points[at].label = (above ? "" : "−") + readable(farthest);
  return marks;
}

/// A curve of which nothing is within the panel is in the key by its marks.
void markWhatIsBeyond(Panel& panel) {
  const std::size_t engines = panel.curves.size();
  for (std::size_t k = 0; k < engines; ++k) {
    bool named = isSeen(panel, panel.curves[k]);
    for (const bool above : {true, false})
      if (auto marks = beyondTheAxis(panel, panel.curves[k], above)) {
        if (!named) marks->name = panel.curves[k].name;
        named = true;
        panel.curves.push_back(std::move(*marks));
      }
  }
}

}  // namespace

std::vector<Figure> differenceFigures(const CompareResults& results,
                                      const std::vector<EngineRuns>& engines) {
  std::vector<Figure> figures;
  if (engines.empty()) return figures;
  const std::string& reference = referenceOf(results);
  const std::string called = referenceWords(results);
  for (const std::string& field : fieldsOf(results.agreement)) {
    Panel panel;
    for (const EngineRuns& engine : engines)
      if (const AgreementRow* row = rowOf(results.agreement, reference, engine.name, field))
        if (Curve curve = differenceCurve(results, *row, engine); !curve.points.empty())
          panel.curves.push_back(std::move(curve));
    if (panel.curves.empty()) continue;
    panel.xLabel = binAxis(results);
    panel.yLabel = fmt::format("difference of {} [margins]", fieldWords(field));
    panel.xRange = rTildeRange(results);
    panel.yRange = marginRange(panel);
    panel.band = Range{-1.0, 1.0};
    panel.level = 0.0;
    const std::size_t engineCurves = panel.curves.size();
    markWhatIsBeyond(panel);
    std::string caption = capitalised(fmt::format(
        "{} minus that of {}, in the {}'s margin; blue: within it. Bars: ± half the interval "
        "that the {}'s colour rests on{}.",
        fieldWords(field), called, binWord(results), binWord(results),
        panel.curves.size() > engineCurves
            ? fmt::format(". Triangles: beyond {:g} margins; the number is an engine's farthest",
                          mostMargins)
            : ""));
    figures.push_back(
        {"difference_" + field,
         fmt::format("Difference of the {} from that of {}, in margins", fieldWords(field), called),
         std::move(caption),
         {panel}});
  }
  return figures;
}

}  // namespace crossgrain::reports
