#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "reports/cost/panels.hpp"
#include "reports/cost/report.hpp"
#include "reports/cost/words.hpp"

namespace crossgrain::reports {

namespace {

using CostEngines = std::vector<CostEngine>;

std::optional<double> wallOf(const CostPoint& point) {
  return point.wallSeconds;
}
std::optional<double> contactsOf(const CostPoint& point) {
  return point.contactEvaluations;
}

constexpr const char* frontName = "Pareto front";

/// Steps down from point to point: what the best setting reaches in a given time.
Curve frontCurve(const CostResults& results, const CostMeasure& measure, const CostAxis& axis) {
  Curve curve{frontName, {"#c9d3dc", 7, false}, Draw::lines, {}, 6.0};
  for (const Front& front : results.fronts) {
    if (!front.engine.empty() || front.kind != measure.kind || front.measure != measure.name)
      continue;
    for (const std::size_t place : front.points) {
      const CostPoint* point = pointAt(results.points, place);
      const auto mark = point ? errorPoint(*point, axis) : std::nullopt;
      if (!mark) continue;
      if (!curve.points.empty()) curve.points.push_back({mark->x, curve.points.back().y, {}});
      curve.points.push_back({mark->x, mark->y, {}});
    }
  }
  return curve;
}

/// Each of an engine's schemes at its time steps, joined; its other settings, numbered; what may be
/// chance; what failed.
void addEngine(Panel& panel, const CostPoints& points, const CostEngine& engine,
               const CostAxis& axis, const std::vector<OtherSetting>& others) {
  std::vector<Curve> schemes = {{engine.name, engine.style, Draw::linesAndPoints, {}, 1.5}};
  Curve marks{"", openMarks(engine.style), Draw::points, {}, 1.5};
  Curve chance{"", {engine.style.colour, openTriangle, false}, Draw::points, {}, 1.5};
  for (const CostPoint& point : points) {
    auto mark = errorPoint(point, axis);
    if (point.engine != engine.name || !mark) continue;
    const auto scheme = schemeOf(point);
    if (!scheme) {
      const auto place = std::ranges::find(others, OtherSetting{point.knob, point.setting});
      mark->label = std::to_string(place - others.begin() + 1);
    }
    if (mayBeChance(point) || !scheme) {
      (mayBeChance(point) ? chance : marks).points.push_back(*mark);
      continue;
    }
    const std::string name = scheme->empty() ? engine.name : engine.name + ", " + *scheme;
    auto curve = std::ranges::find(schemes, name, &Curve::name);
    if (curve == schemes.end()) {
      curve = schemes.insert(curve, {name, openMarks(engine.style), Draw::linesAndPoints, {}, 1.0});
      curve->style.dashed = true;
    }
    curve->points.push_back(*mark);
  }
  for (Curve& scheme : schemes) std::ranges::sort(scheme.points, {}, &Point::x);
  addCurves(panel, std::move(schemes));
  addCurves(panel, {std::move(marks), std::move(chance), failures(panel, points, engine, axis)});
}

Panel costPanel(const CostPoints& all, const CostEngines& engines, const CostMeasure& measure,
                const CostAxis& axis, Curve behind) {
  const CostPoints points = pointsOf(all, measure);
  Panel panel = errorPanel(points, measure.name, axis);
  addCurves(panel, {std::move(behind)});
  for (const CostEngine& engine : engines)
    addEngine(panel, points, engine, axis, otherSettings(all));
  return panel;
}

std::string numbersInWords(const CostPoints& points, CostKind kind) {
  const auto all = otherSettings(points);
  std::vector<std::string> words;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (std::ranges::any_of(points, [&](const CostPoint& point) {
          return point.kind == kind && countedError(point) &&
                 OtherSetting{point.knob, point.setting} == all[k];
        }))
      words.push_back(fmt::format("{} {}", k + 1, settingWords(all[k].knob, all[k].setting)));
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

std::string barsInWords(const CostPoints& points, CostKind kind) {
  const bool any = std::ranges::any_of(
      points, [&](const CostPoint& point) { return point.kind == kind && point.statistical; });
  return any ? " Bars: the statistical part." : "";
}

}  // namespace

Figure costTimeFigure(const CostResults& results, const CostEngines& engines, CostKind kind) {
  const CostPoints& points = results.points;
  const CostAxis axis{wallOf, fmt::format("wall time of {} [s]", timeUnit(kind))};
  Figure figure;
  figure.name = "cost_" + toString(kind);
  figure.title = "Error against time: " + toString(kind);
  for (const CostMeasure& measure : measuresDrawn(points))
    if (measure.kind == kind)
      figure.panels.push_back(
          costPanel(points, engines, measure, axis, frontCurve(results, measure, axis)));
  figure.caption =
      fmt::format("Error against the wall time of {}.{}{}{}", timeUnit(kind), drawnInWords(figure),
                  barsInWords(points, kind), numbersInWords(points, kind));
  arrange(figure);
  figure.png = true;
  return figure;
}

Figure costContactsFigure(const CostPoints& points, const CostEngines& engines) {
  Figure figure;
  figure.name = "cost_contacts";
  figure.title = "Error against contact evaluations";
  figure.caption =
      "The same errors at the time steps, the first measure of each kind, against what does not "
      "depend on the machine: how often a contact's force was worked out. What then remains "
      "between "
      "engines is the method, not the code's speed.";
  CostPoints steps = points;
  std::erase_if(steps, [](const CostPoint& point) { return !schemeOf(point); });
  const auto measures = measuresDrawn(steps);
  for (const CostKind kind : kindsIn(steps)) {
    const auto measure = std::ranges::find(measures, kind, &CostMeasure::kind);
    Panel panel = costPanel(steps, engines, *measure,
                            {contactsOf, "contact evaluations in " + timeUnit(kind)}, {});
    panel.title = toString(kind) + ": " + panel.title;
    figure.panels.push_back(std::move(panel));
  }
  arrange(figure);
  return figure;
}

std::vector<Figure> costFigures(const CostResults& results) {
  const CostPoints& points = results.points;
  const CostEngines engines = costEngines(results);
  std::vector<Figure> figures;
  for (const CostKind kind : kindsIn(points)) {
    figures.push_back(costTimeFigure(results, engines, kind));
    figures.push_back(costOrderFigure(results, engines, kind));
  }
  figures.push_back(costPartsFigure(points, engines));
  figures.push_back(costFallsFigure(results, engines));
  figures.push_back(costContactsFigure(points, engines));
  figures.push_back(costGrowthFigure(results));
  std::erase_if(figures, [](const Figure& figure) { return figure.panels.empty(); });
  return figures;
}

}  // namespace crossgrain::reports
