#include "reports/common/figure_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "reports/common/gnuplot.hpp"
#include "reports/common/numbers.hpp"

namespace crossgrain::reports {

namespace {

/// Four digits are more than anybody reads off a plot.
double fewDigits(double value) {
  return std::strtod(fmt::format("{:.4g}", value).c_str(), nullptr);
}

/// A panel's line of the file of axes.
using Axes = std::array<double, 8>;

std::vector<Axes> axesOf(const std::string& text) {
  std::vector<Axes> all;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream numbers(line);
    Axes axes{};
    for (double& number : axes) numbers >> number;
    if (!numbers) return {};
    all.push_back(axes);
  }
  return all;
}

std::size_t heightOf(const Figure& figure) {
  const auto columns = static_cast<std::size_t>(figure.columns);
  return static_cast<std::size_t>(figure.panelHeight) *
         ((figure.panels.size() + columns - 1) / columns);
}

std::string partName(const Figure& figure, std::size_t element, std::size_t plot) {
  const std::string number = std::to_string(element);
  return isMultiplot(figure) ? number + static_cast<char>('a' + plot % 26) : number;
}

/// What all points of the curve are told by, so that it is told once; empty where they differ.
std::string commonPlace(const Curve& curve) {
  if (curve.points.empty()) return {};
  const std::string& first = curve.points.front().place;
  const bool same =
      std::ranges::all_of(curve.points, [&](const Point& point) { return point.place == first; });
  return same ? first : std::string();
}

/// @param place  told with the curve
Json pointsOf(const Panel& panel, const Curve& curve, const std::string& place) {
  Json points = Json::array();
  for (const Point& point : curve.points) {
    if (!drawable(panel, point)) continue;
    Json one = {fewDigits(point.x), fewDigits(point.y)};
    const bool barred = point.error && std::isfinite(*point.error);
    const bool ownPlace = point.place != place;
    if (barred || ownPlace) one.push_back(barred ? Json(fewDigits(*point.error)) : Json());
    if (ownPlace) one.push_back(point.place);
    points.push_back(std::move(one));
  }
  return points;
}

/// Where points are told by their place alone, as many are in several curves: the abscissae go to
/// the panel, each list once, and the curve has its place among them.
void shareAbscissae(Json& curve, Json& abscissae) {
  const Json& points = curve["points"];
  if (points.empty()) return;
  Json xs = Json::array(), ys = Json::array();
  for (const Json& point : points) {
    if (point.size() != 2) return;
    xs.push_back(point[0]);
    ys.push_back(point[1]);
  }
  const auto known = std::ranges::find(abscissae, xs);
  curve["xs"] = known - abscissae.begin();
  if (known == abscissae.end()) abscissae.push_back(std::move(xs));
  curve["ys"] = std::move(ys);
  curve.erase("points");
}

/// Of the points that pointsOf() tells; null where there is nothing to draw.
Json eachOf(const Panel& panel, const Curve& curve) {
  Json all = Json::array();
  for (const std::vector<double>& one : curve.each) {
    Json values = Json::array();
    for (std::size_t k = 0; k < curve.points.size(); ++k) {
      if (!drawable(panel, curve.points[k])) continue;
      const auto y = at(one, k);
      const bool there = y && drawable(panel, {curve.points[k].x, *y, {}});
      values.push_back(there ? Json(fewDigits(*y)) : Json());
    }
    all.push_back(std::move(values));
  }
  return all;
}

Json panelData(const Figure& figure, std::size_t place, const Axes& axes,
               const std::vector<LegendEntry>& legend) {
  const Panel& panel = figure.panels[place];
  const auto height = static_cast<double>(heightOf(figure));
  const std::vector<std::string> above = namesAbove(figure);
  Json curves = Json::array(), abscissae = Json::array();
  std::size_t element = 1;
  for (const Curve& curve : panel.curves) {
    Json parts = Json::array();
    for (std::size_t k = 0; k < elementCount(curve); ++k)
      parts.push_back(partName(figure, element++, place));
    if (const auto key = std::ranges::find(above, curve.name); key != above.end())
      parts.push_back(partName(figure, static_cast<std::size_t>(key - above.begin()) + 1,
                               figure.panels.size()));
    const std::string common = commonPlace(curve);
    Json data = {{"name", curve.name},
                 {"owner", ownerOf(curve, legend)},
                 {"parts", std::move(parts)},
                 {"points", pointsOf(panel, curve, common)}};
    if (!common.empty()) data["place"] = common;
    if (!curve.each.empty()) {
      data["each"] = eachOf(panel, curve);
      data["colour"] = curve.style.colour;
    }
    shareAbscissae(data, abscissae);
    curves.push_back(std::move(data));
  }
  return {
      {"xs", std::move(abscissae)}, {"box", {axes[0], axes[1], height - axes[3], height - axes[2]}},
      {"x", {axes[4], axes[5]}},    {"y", {axes[6], axes[7]}},
      {"logX", panel.logX},         {"logY", panel.logY},
      {"xLabel", panel.xLabel},     {"yLabel", panel.yLabel},
      {"rows", panel.rows},         {"columns", panel.columns},
      {"curves", std::move(curves)}};
}

}  // namespace

std::vector<LegendEntry> sharedLegend(const std::vector<Figure>& figures) {
  struct Seen {
    LegendEntry entry;
    int panels = 0;
    bool one = true;  ///< colour; marks may say more
  };
  std::vector<Seen> all;
  for (const Figure& figure : figures)
    for (const Panel& panel : figure.panels)
      for (const Curve& curve : panel.curves) {
        // Lines without marks are guides.
        if (curve.name.empty() || curve.style.pointType == 0 || !isSeen(panel, curve)) continue;
        auto seen = std::ranges::find_if(
            all, [&](const Seen& other) { return other.entry.name == curve.name; });
        if (seen == all.end()) seen = all.insert(all.end(), {{curve.name, curve.style}, 0, true});
        seen->panels += 1;
        seen->one = seen->one && seen->entry.style.colour == curve.style.colour;
      }
  std::erase_if(all, [&](const Seen& seen) {
    const auto alike = std::ranges::count_if(
        all, [&](const Seen& other) { return other.entry.style == seen.entry.style; });
    return seen.panels < 2 || !seen.one || alike > 1;
  });
  std::vector<LegendEntry> legend;
  for (Seen& seen : all) legend.push_back(std::move(seen.entry));
  if (legend.size() < 2) legend.clear();
  return legend;
}

int ownerOf(const Curve& curve, const std::vector<LegendEntry>& legend) {
  const auto only = [&](const auto& fits) {
    const auto count = std::ranges::count_if(legend, fits);
    return count == 1 ? static_cast<int>(std::ranges::find_if(legend, fits) - legend.begin()) : -1;
  };
  const int named = only([&](const LegendEntry& entry) { return entry.name == curve.name; });
  if (named >= 0) return named;
  if (!curve.name.empty() && curve.style.pointType == 0) return -1;
  const int styled = only([&](const LegendEntry& entry) { return entry.style == curve.style; });
  if (styled >= 0) return styled;
  if (curve.draw == Draw::blocks || curve.draw == Draw::tiles) return -1;  // colours of their own
  const auto coloured = std::ranges::find(
      legend, curve.style.colour, [](const LegendEntry& entry) { return entry.style.colour; });
  return coloured == legend.end() ? -1 : static_cast<int>(coloured - legend.begin());
}

int keyRoom(const Figure& figure, const std::string& axes, const std::vector<LegendEntry>& legend) {
  const std::vector<Axes> all = axesOf(axes);
  if (all.size() != figure.panels.size() || all.empty()) return 0;
  const Panel& first = figure.panels.front();
  const bool titled = !first.title.empty() || !first.name.empty();
  if (!figure.keyAbove && (all.size() > 1 || first.key != Key::outside || titled)) return 0;
  for (const Panel& panel : figure.panels)
    for (const Curve& curve : panel.curves)
      if (!curve.name.empty() && isSeen(panel, curve) && ownerOf(curve, legend) < 0) return 0;
  constexpr double tick = 12.0, title = 40.0;  // letters above the axes [px]
  const double upper = static_cast<double>(heightOf(figure)) - all.front()[3];
  return std::max(0, static_cast<int>(upper - (titled ? title : tick)));
}

Json figureData(const Figure& figure, const std::string& axes,
                const std::vector<LegendEntry>& legend) {
  const std::vector<Axes> all = axesOf(axes);
  if (all.size() != figure.panels.size()) return nullptr;
  Json panels = Json::array();
  for (std::size_t k = 0; k < all.size(); ++k)
    panels.push_back(panelData(figure, k, all[k], legend));
  const int top = keyRoom(figure, axes, legend);
  return {{"top", top},
          {"height", static_cast<int>(heightOf(figure)) - top},
          {"panels", std::move(panels)}};
}

}  // namespace crossgrain::reports
