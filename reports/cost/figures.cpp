#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "reports/common/figures.hpp"
#include "reports/cost/panels.hpp"

namespace crossgrain::reports {

namespace {

using Rows = std::vector<CostRow>;
using Engines = std::vector<EngineResults>;

std::optional<double> wallOf(const CostRow& row) {
  return row.wall;
}
std::optional<double> contactsOf(const CostRow& row) {
  return row.contacts;
}

constexpr const char* frontName = "Pareto front";

/// Steps down from point to point: what the best setting reaches in a given time.
Curve frontCurve(const Json& results, const Rows& all, const CostMeasure& measure,
                 const CostAxis& axis) {
  Curve curve{frontName, {"#c9d3dc", 7, false}, Draw::lines, {}, 6.0};
  for (const Json& front : list(results, "fronts")) {
    if (!text(front, "engine").empty() || text(front, "error_kind") != measure.kind ||
        text(front, "measure") != measure.name)
      continue;
    for (const Json& place : list(front, "points")) {
      const CostRow* row = rowAt(all, place);
      const auto point = row ? errorPoint(*row, axis) : std::nullopt;
      if (!point) continue;
      if (!curve.points.empty()) curve.points.push_back({point->x, curve.points.back().y, {}});
      curve.points.push_back({point->x, point->y, {}});
    }
  }
  return curve;
}

/// Each of an engine's schemes at its time steps, joined; its other settings, numbered; what may be
/// chance; what failed.
void addEngine(Panel& panel, const Rows& rows, const EngineResults& engine, const CostAxis& axis,
               const std::vector<OtherSetting>& others) {
  std::vector<Curve> schemes = {{engine.name, engine.style, Draw::linesAndPoints, {}, 1.5}};
  Curve marks{"", openMarks(engine.style), Draw::points, {}, 1.5};
  Curve chance{"", {engine.style.colour, openTriangle, false}, Draw::points, {}, 1.5};
  for (const CostRow& row : rows) {
    auto point = errorPoint(row, axis);
    if (row.engine != engine.name || !point) continue;
    const auto scheme = row.scheme();
    if (!scheme) {
      const auto place = std::ranges::find(others, OtherSetting{row.knob, row.setting});
      point->label = std::to_string(place - others.begin() + 1);
    }
    if (row.mayBeChance() || !scheme) {
      (row.mayBeChance() ? chance : marks).points.push_back(*point);
      continue;
    }
    const std::string name = scheme->empty() ? engine.name : engine.name + ", " + *scheme;
    auto curve = std::ranges::find(schemes, name, &Curve::name);
    if (curve == schemes.end()) {
      curve = schemes.insert(curve, {name, openMarks(engine.style), Draw::linesAndPoints, {}, 1.0});
      curve->style.dashed = true;
    }
    curve->points.push_back(*point);
  }
  for (Curve& scheme : schemes) std::ranges::sort(scheme.points, {}, &Point::x);
  addCurves(panel, std::move(schemes));
  addCurves(panel, {std::move(marks), std::move(chance), failures(panel, rows, engine, axis)});
}

Panel costPanel(const Rows& all, const Engines& engines, const CostMeasure& measure,
                const CostAxis& axis, Curve behind) {
  const Rows rows = rowsOf(all, measure);
  Panel panel = errorPanel(rows, measure.name, axis);
  addCurves(panel, {std::move(behind)});
  for (const EngineResults& engine : engines)
    addEngine(panel, rows, engine, axis, otherSettings(all));
  return panel;
}

std::string numbersInWords(const Rows& rows, const std::string& kind) {
  const auto all = otherSettings(rows);
  std::vector<std::string> words;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (std::ranges::any_of(rows, [&](const CostRow& row) {
          return row.kind == kind && row.counted() && OtherSetting{row.knob, row.setting} == all[k];
        }))
      words.push_back(fmt::format("{} {}", k + 1, settingWords(all[k])));
  return words.empty() ? "" : fmt::format(" Other settings: {}.", fmt::join(words, ", "));
}

/// What the figure's marks and colours mean, of those that are in it.
std::string drawnInWords(const Figure& figure) {
  std::string words = " Lines join the time steps of an engine";
  if (draws(figure, [](const Curve& curve) {
        return curve.style.dashed && curve.draw == Draw::linesAndPoints;
      }))
    words += ", dashed with another integrator";
  if (draws(figure, [](const Curve& curve) {
        return std::ranges::any_of(curve.points, [](const Point& p) { return !p.label.empty(); });
      }))
    words += "; numbered open marks: other settings";
  words += ".";
  if (draws(figure, [](const Curve& curve) { return curve.name == frontName; }))
    words += " Pale line: Pareto front.";
  if (std::ranges::any_of(figure.panels, [](const Panel& p) { return p.shadedTo.has_value(); }))
    words += " Grey: what the reference is uncertain by.";
  if (drawsMark(figure, openTriangle)) words += " ▽ may be chance: drawn at its upper bound.";
  if (drawsMark(figure, crossMark)) words += " ×, at the upper edge: failed.";
  return words;
}

std::string barsInWords(const Rows& rows, const std::string& kind) {
  const bool any = std::ranges::any_of(
      rows, [&](const CostRow& row) { return row.kind == kind && row.statistical; });
  return any ? " Bars: the statistical part." : "";
}

}  // namespace

Figure costTimeFigure(const Json& results, const Rows& rows, const Engines& engines,
                      const std::string& kind) {
  const CostAxis axis{wallOf, fmt::format("wall time of {} [s]", timeUnit(kind))};
  Figure figure;
  figure.name = "cost_" + kind;
  figure.title = "Error against time: " + kind;
  for (const CostMeasure& measure : costMeasures(rows))
    if (measure.kind == kind)
      figure.panels.push_back(
          costPanel(rows, engines, measure, axis, frontCurve(results, rows, measure, axis)));
  figure.caption =
      fmt::format("Error against the wall time of {}.{}{}{}", timeUnit(kind), drawnInWords(figure),
                  barsInWords(rows, kind), numbersInWords(rows, kind));
  arrange(figure);
  figure.png = true;
  return figure;
}

Figure costContactsFigure(const Rows& rows, const Engines& engines) {
  Figure figure;
  figure.name = "cost_contacts";
  figure.title = "Error against contact evaluations";
  figure.caption =
      "The same errors at the time steps, the first measure of each kind, against what does not "
      "depend on the machine: how often a contact's force was worked out. What then remains "
      "between "
      "engines is the method, not the code's speed.";
  Rows steps = rows;
  std::erase_if(steps, [](const CostRow& row) { return !row.scheme(); });
  const auto measures = costMeasures(steps);
  for (const std::string& kind : costKinds(steps)) {
    const auto measure = std::ranges::find(measures, kind, &CostMeasure::kind);
    Panel panel = costPanel(steps, engines, *measure,
                            {contactsOf, "contact evaluations in " + timeUnit(kind)}, {});
    panel.title = kind + ": " + panel.title;
    figure.panels.push_back(std::move(panel));
  }
  arrange(figure);
  return figure;
}

std::vector<Figure> costFigures(const Json& results) {
  const Rows rows = costRows(results);
  const Engines engines = costEngines(results);
  std::vector<Figure> figures;
  for (const std::string& kind : costKinds(rows)) {
    figures.push_back(costTimeFigure(results, rows, engines, kind));
    figures.push_back(costOrderFigure(results, rows, engines, kind));
  }
  figures.push_back(costPartsFigure(rows, engines));
  figures.push_back(costFallsFigure(results, engines));
  figures.push_back(costContactsFigure(rows, engines));
  figures.push_back(costGrowthFigure(results));
  std::erase_if(figures, [](const Figure& figure) { return figure.panels.empty(); });
  return figures;
}

}  // namespace crossgrain::reports
