// Figure 5.6: what the width of a ring does to the volume fraction in it.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/common/numbers.hpp"
#include "reports/thesis/figures.hpp"
#include "reports/thesis/findings.hpp"
#include "reports/thesis/leg_rings.hpp"

namespace crossgrain::reports {

namespace {

constexpr double figureRadii[] = {0.12, 0.13, 0.14, 0.20};  ///< [m]
constexpr double widestRing = 3.0;                          ///< [d]

/// ν of so many neighbouring rings together, those about a radius: volumes add up. Absent where
/// they do not lie in the cell.
std::optional<double> togetherAbout(const RingView& view, const Numbers& nu, double radius,
                                    std::size_t count) {
  const CouetteCell& cell = view.leg->cell;
  const double width =
      (cell.outerRadius - cell.innerRadius) / static_cast<double>(view.places.r.size());
  const auto first =
      std::lround((radius - cell.innerRadius) / width - 0.5 * static_cast<double>(count));
  if (first < 0 || static_cast<std::size_t>(first) + count > nu.size()) return std::nullopt;
  double disks = 0.0, room = 0.0;
  for (auto k = static_cast<std::size_t>(first); k < static_cast<std::size_t>(first) + count; ++k) {
    if (!nu[k]) return std::nullopt;
    disks += *nu[k] * view.places.r[k];  // a ring's volume goes as its radius
    room += view.places.r[k];
  }
  return disks / room;
}

/// Over the rings' width in d, mean over packings.
std::vector<Point> overWidths(const std::vector<RingView>& views, double radius) {
  std::vector<Point> points;
  if (views.empty()) return points;
  const CouetteCell& cell = views.front().leg->cell;
  const double finest = (cell.outerRadius - cell.innerRadius) /
                        static_cast<double>(views.front().places.r.size()) / cell.diameter;
  for (std::size_t count = 1; static_cast<double>(count) * finest <= widestRing; ++count) {
    std::vector<std::optional<double>> values;
    for (const RingView& view : views)
      values.push_back(togetherAbout(view, valuesIn(view, {"volume_fraction"}), radius, count));
    if (const auto [mean, error] = meanOfRuns(values); mean)
      points.push_back({static_cast<double>(count) * finest, *mean, error});
  }
  return points;
}

/// The largest distance between the two where rings are about one d wide, and where they are
/// narrowest.
std::string methodsClause(double radius, const std::vector<Point>& slices,
                          const std::vector<Point>& centres) {
  if (slices.empty() || slices.size() != centres.size()) return "";
  const auto off = [&](std::size_t k) { return readable(std::abs(centres[k].y - slices[k].y)); };
  const auto atD = static_cast<std::size_t>(
      std::ranges::min_element(slices, {}, [](const Point& p) { return std::abs(p.x - 1.0); }) -
      slices.begin());
  return fmt::format("r = {:.2f} m: the methods differ by {} at {:.2f} d, by {} at {:.2f} d",
                     radius, off(0), slices[0].x, off(atD), slices[atD].x);
}

}  // namespace

std::vector<Figure> widthOfRingFigures(const ThesisResults& results) {
  constexpr double label = 0.804;  // the thesis does not say which
  const ThesisLeg* leg = packingLeg(results, label);
  const auto engines = enginesWithRuns(results);
  if (!leg || engines.empty()) return {};
  const auto views = [&](const char* method) {
    return ringViews(results, *leg, engines.front(), RingWidth::finest, method);
  };
  const std::vector<RingView> slicing = views("slicing"), centre = views("centre");
  Panel panel;
  panel.xLabel = "Δr / d";
  panel.yLabel = "ν";
  panel.logX = true;
  panel.xRange = Range{0.25, 4.0};
  panel.xTicks = {0.3, 0.5, 1.0, 2.0, 3.0};
  std::vector<std::string> clauses;
  for (std::size_t k = 0; k < std::size(figureRadii); ++k) {
    const double radius = figureRadii[k];
    const auto slices = overWidths(slicing, radius), centres = overWidths(centre, radius);
    const std::string colour = thesisStyle(k, 0).colour;
    constexpr int open = 6, filled = 7;  // circles
    const std::string name = fmt::format("r = {:.2f} m", radius);
    if (!slices.empty())
      panel.curves.push_back({name, {colour, filled, false}, Draw::linesAndPoints, slices, 1.5});
    if (!centres.empty())
      panel.curves.push_back(
          {name + ", centres", {colour, open, true}, Draw::linesAndPoints, centres, 1.5});
    if (const std::string clause = methodsClause(radius, slices, centres); !clause.empty())
      clauses.push_back(clause);
  }
  if (panel.curves.empty()) return {};
  bool widened = false;
  panel.yRange = holding({0.0, 2.0}, panel.curves, false, widened);
  Figure figure = thesisFigureOf(
      "5.6", "Volume fraction against the width of the ring",
      thesisAndFound("slicing and centres meet at Δr = 0.97 to 1.03 d and at 2 d; between 0.1 and "
                     "2 d centres vary strongly",
                     clauses) +
          fmt::format(" ν̄ = {:.3f}, {}. Rings wider than the narrowest that were averaged are put "
                      "together of them, next to each radius; the thesis goes on to 0.01 d.",
                      label, engines.front()));
  figure.panels = {std::move(panel)};
  return {std::move(figure)};
}

}  // namespace crossgrain::reports
