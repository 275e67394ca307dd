// The plots of error against time, and what settings and measures are called in them.
// Time of a step against the number of bodies and of workers.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <functional>

#include "reports/common/blocks.hpp"
#include "reports/common/engines.hpp"
#include "reports/cost/report.hpp"

namespace crossgrain::reports {

namespace {

using Points = std::vector<CostPoint>;

std::vector<CostMeasure> measuresIn(const Points& points) {
  std::vector<CostMeasure> measures;
  for (const CostPoint& point : points) addOnce(measures, CostMeasure{point.kind, point.measure});
  return measures;
}

/// Larger errors say no more than that the run is wrong: they stand at the upper edge.
constexpr double offScale = 10.0;
/// gnuplot's marks
constexpr int crossMark = 2, openTriangle = 10;
constexpr const char* frontName = "Pareto front";

/// @param place  among styles of one engine: each has another mark
LineStyle openMarks(LineStyle style, std::size_t place = 0) {
  constexpr std::array open = {4, 6, 8, 12};  // not openTriangle
  if (style.pointType % 2 == 1) style.pointType -= 1;
  const auto* const own = std::ranges::find(open, style.pointType);
  if (place > 0 && own != open.end())
    style.pointType = open[static_cast<std::size_t>(own - open.begin() + place) % open.size()];
  return style;
}

/// Whole decades around the errors, with room for what stands at the upper edge.
Range errorRange(const Points& points) {
  double low = offScale, high = 0.0;
  for (const CostPoint& point : points)
    if (const auto error = point.counted(); error && *error > 0.0 && *error <= offScale) {
      low = std::min(low, *error);
      high = std::max(high, *error);
    }
  if (high == 0.0) return {0.1, offScale};
  return {std::pow(10.0, std::floor(std::log10(low) - 0.1)),
          std::pow(10.0, std::ceil(std::log10(high) + 0.3))};
}

/// With what the point counts with; absent off scale or without a time. Bars are of the statistical
/// part.
std::optional<Point> markOf(const CostPoint& point) {
  const auto error = point.counted();
  if (!error || *error > offScale || !point.time()) return std::nullopt;
  Point mark{*point.time(), *error, {}};
  if (point.statistical && !point.mayBeChance()) mark.error = point.statistical;
  return mark;
}

void addCurve(Panel& panel, Curve curve) {
  std::ranges::sort(curve.points, {}, &Point::x);
  if (!curve.points.empty()) panel.curves.push_back(std::move(curve));
}

/// Steps down from point to point: what the best setting reaches in a given time. Points that are
/// on the front by a tie with one that errs less are left out.
Curve frontCurve(const CostResults& results, const CostMeasure& measure) {
  Curve curve{frontName, {"#c9d3dc", 7, false}, Draw::lines, {}, 6.0};
  for (const Front& front : results.fronts) {
    if (!front.engine.empty() || front.kind != measure.kind || front.measure != measure.name)
      continue;
    for (const std::size_t place : front.points) {
      const auto mark =
          place < results.points.size() ? markOf(results.points[place]) : std::nullopt;
      if (!mark || (!curve.points.empty() && mark->y >= curve.points.back().y)) continue;
      if (!curve.points.empty()) curve.points.push_back({mark->x, curve.points.back().y, {}});
      curve.points.push_back({mark->x, mark->y, {}});
    }
  }
  return curve;
}

/// Each of an engine's schemes at its time steps, joined; its other settings, numbered; what may be
/// chance; what failed.
void addEngine(Panel& panel, const Points& points, const std::string& engine,
               const LineStyle& style, const std::vector<OtherSetting>& others) {
  std::vector<Curve> schemes = {{engine, style, Draw::linesAndPoints, {}, 1.5}};
  Curve marks{"", openMarks(style), Draw::points, {}, 1.5};
  Curve chance{"", {style.colour, openTriangle, false}, Draw::points, {}, 1.5};
  Curve failures{"", {style.colour, crossMark, false}, Draw::points, {}, 1.5};
  constexpr double belowEdge = 1.35;
  for (const CostPoint& point : points) {
    if (point.engine != engine) continue;
    if ((point.status == Status::failed || point.counted().value_or(0.0) > offScale) &&
        point.time())
      failures.points.push_back({*point.time(), panel.yRange->high / belowEdge, {}});
    auto mark = markOf(point);
    if (!mark) continue;
    const auto scheme = schemeOf(point.knob, point.setting);
    if (!scheme) {
      const auto place = std::ranges::find(others, OtherSetting{point.knob, point.setting});
      mark->label = std::to_string(place - others.begin() + 1);
    }
    if (point.mayBeChance() || !scheme) {
      (point.mayBeChance() ? chance : marks).points.push_back(*mark);
      continue;
    }
    const std::string name = scheme->empty() ? engine : engine + ", " + spaced(*scheme);
    auto curve = std::ranges::find(schemes, name, &Curve::name);
    if (curve == schemes.end()) {
      curve = schemes.insert(
          curve, {name, openMarks(style, schemes.size() - 1), Draw::linesAndPoints, {}, 1.0});
      curve->style.dashed = true;
    }
    curve->points.push_back(*mark);
  }
  for (Curve& scheme : schemes) addCurve(panel, std::move(scheme));
  for (Curve* const curve : {&marks, &chance, &failures}) addCurve(panel, std::move(*curve));
}

/// Empty, with log axes.
Panel errorPanel(const CostMeasure& measure, const char* what, std::string xLabel) {
  Panel panel;
  panel.title = mathGnuplot(measureText(measure.name)) + what;
  panel.xLabel = std::move(xLabel);
  panel.yLabel = "error";
  panel.logX = panel.logY = true;
  panel.key = Key::none;
  return panel;
}

/// Errors of one measure on log axes; grey up to the largest uncertainty of a reference.
Panel panelOf(const CostResults& results, const CostMeasure& measure) {
  Points points = results.points;
  std::erase_if(points, [&](const CostPoint& point) { return !measure.has(point); });
  Panel panel =
      errorPanel(measure, "", fmt::format("processor time of {} [s]", timeUnit(measure.kind)));
  panel.yRange = errorRange(points);
  double uncertain = 0.0;
  for (const CostPoint& point : points)
    uncertain = std::max(uncertain, point.referenceError.value_or(0.0));
  if (uncertain > panel.yRange->low) panel.shadedTo = std::min(uncertain, panel.yRange->high);
  if (Curve front = frontCurve(results, measure); !front.points.empty())
    panel.curves.push_back(std::move(front));
  const std::vector<LineStyle> styles = engineStyles(results.engines);
  const auto others = otherSettings(results.points);
  for (std::size_t k = 0; k < results.engines.size(); ++k)
    addEngine(panel, points, results.engines[k].name, styles[k], others);
  return panel;
}

/// Of an engine's own scheme, by step.
Points stepsOf(const CostResults& results, const std::string& engine, const CostMeasure& measure) {
  Points points;
  for (const CostPoint& point : results.points)
    if (point.engine == engine && measure.has(point) && point.knob == "time_step" &&
        point.counted() && point.time())
      points.push_back(point);
  std::ranges::sort(points, std::greater<>(),
                    [](const CostPoint& one) { return one.dt.value_or(0.0); });
  return points;
}

/// Errors of an endpoint against time: a line per engine over its steps, upright bars their
/// intervals over packings, grey up to the case's margin, a ring at the largest step whose whole
/// interval lies inside.
Panel endpointPanel(const CostResults& results, const CostMeasure& measure) {
  Panel panel = errorPanel(measure, "", "processor time of a simulated second [s]");
  Points all = results.points;
  std::erase_if(all, [&](const CostPoint& point) { return !measure.has(point); });
  const auto margin = std::ranges::find(results.margins, measure.name, &CostMargin::measure);
  const bool hasMargin = margin != results.margins.end();
  Range range = errorRange(all);
  if (hasMargin) {
    range = {std::min(range.low, 0.1 * margin->margin), std::max(range.high, 3.0 * margin->margin)};
    panel.shadedTo = margin->margin;
  }
  panel.yRange = range;
  const std::vector<LineStyle> styles = engineStyles(results.engines);
  Curve rings{"", {"#000000", 6, false}, Draw::points, {}, 2.5};
  for (std::size_t e = 0; e < results.engines.size(); ++e) {
    Curve line{results.engines[e].name, styles[e], Draw::linesAndPoints, {}, 1.5};
    std::vector<Curve> bars;
    bool ringed = false;
    for (const CostPoint& point : stepsOf(results, line.name, measure)) {
      const Point mark{*point.time(), std::clamp(*point.error, range.low, range.high), {}};
      line.points.push_back(mark);
      bars.push_back({"",
                      styles[e],
                      Draw::lines,
                      {{mark.x, std::clamp(point.low(), range.low, range.high), {}},
                       {mark.x, std::clamp(point.high(), range.low, range.high), {}}},
                      1.0});
      if (ringed || !hasMargin || point.high() > margin->margin) continue;
      ringed = true;
      rings.points.push_back(mark);
      // Short enough for the largest time, at the frame.
      rings.points.back().label = point.fragment.empty() ? "own" : point.setting;
    }
    addCurve(panel, std::move(line));
    for (Curve& bar : bars) panel.curves.push_back(std::move(bar));
  }
  addCurve(panel, std::move(rings));
  return panel;
}

/// Errors of collisions against steps: the worst over phases of a step and over every pair of the
/// scene, dashed their rms, of the pair for which it is largest.
Panel envelopePanel(const CostResults& results, const CostMeasure& measure) {
  Panel panel = errorPanel(measure, " of collisions, worst", "steps per contact");
  const std::vector<LineStyle> styles = engineStyles(results.engines);
  for (std::size_t e = 0; e < results.engines.size(); ++e) {
    Curve worst{results.engines[e].name, styles[e], Draw::linesAndPoints, {}, 1.5};
    Curve rms{"", styles[e], Draw::lines, {}, 1.0};
    rms.style.dashed = true;
    for (const CostPoint& point : stepsOf(results, worst.name, measure)) {
      if (!point.stepsPerContact) continue;
      if (point.worst) worst.points.push_back({*point.stepsPerContact, *point.worst, {}});
      rms.points.push_back({*point.stepsPerContact, *point.error, {}});
    }
    addCurve(panel, std::move(worst));
    addCurve(panel, std::move(rms));
  }
  return panel;
}

/// Errors of rigid bodies in margins against time: a line per engine over its front, open its other
/// settings, a ring at the cheapest within the margin.
Panel marginPanel(const CostResults& results, const CostMeasure& measure) {
  Panel panel = errorPanel(measure, "", "processor time of a simulated second [s]");
  panel.yLabel = "error [margins]";
  // Limits of the axis: beyond a thousand margins a run is wrong, below a thousandth exact enough.
  constexpr Range range{1e-3, 1e3};
  panel.yRange = range;
  panel.shadedTo = 1.0;
  const std::vector<LineStyle> styles = engineStyles(results.engines);
  Curve rings{"", {"#000000", 6, false}, Draw::points, {}, 2.5};
  for (std::size_t e = 0; e < results.engines.size(); ++e) {
    const std::string& engine = results.engines[e].name;
    Curve line{engine, styles[e], Draw::linesAndPoints, {}, 1.5};
    Curve others{"", openMarks(styles[e]), Draw::points, {}, 0.7};
    const auto front = std::ranges::find_if(results.fronts, [&](const Front& one) {
      return one.engine == engine && one.measure == measure.name;
    });
    for (std::size_t k = 0; k < results.points.size(); ++k) {
      const CostPoint& point = results.points[k];
      if (point.engine != engine || !measure.has(point) || !point.measured() || !point.time())
        continue;
      const Point mark{*point.time(), std::clamp(*point.error, range.low, range.high), {}};
      const bool isBest = front != results.fronts.end() &&
                          std::ranges::find(front->points, k) != front->points.end();
      (isBest ? line : others).points.push_back(mark);
      if (std::ranges::any_of(results.advice, [&](const Advice& one) {
            return one.engine == engine && one.target == 1.0 && one.verdict == Verdict::pass &&
                   one.knob == point.knob && one.setting == point.setting;
          }))
        rings.points.push_back(mark);
    }
    addCurve(panel, std::move(line));
    addCurve(panel, std::move(others));
  }
  addCurve(panel, std::move(rings));
  return panel;
}

/// A figure per measure, as narrow as a small screen.
std::vector<Figure> pictureOf(const CostResults& results) {
  std::vector<Figure> figures;
  std::vector<CostMeasure> measures = measuresIn(results.points);
  std::ranges::stable_partition(
      measures, [](const CostMeasure& measure) { return measure.name == largestError; });
  for (const CostKind kind : {CostKind::averages, CostKind::collision})
    for (const CostMeasure& measure : measures) {
      if (measure.kind != kind || isOwn(measure.name)) continue;
      const bool isEndpoint = kind == CostKind::averages;
      Figure figure;
      figure.name = "cost_picture_" + measure.name;
      figure.panels = {results.inMargins ? marginPanel(results, measure)
                       : isEndpoint      ? endpointPanel(results, measure)
                                         : envelopePanel(results, measure)};
      if (!hasPoints(figure.panels.front())) continue;
      figure.title = fmt::format("Error of {} against {}", measureText(measure.name),
                                 isEndpoint ? "processor time" : "steps per contact");
      figure.caption = figure.title + ".";
      figure.keyAbove = true;
      figure.panelWidth = 380;
      figure.panelHeight = 400;
      figure.png = true;
      figures.push_back(std::move(figure));
    }
  return figures;
}

std::string captionOf(const Points& points, CostKind kind) {
  std::string caption = fmt::format(
      "Error against the processor time of {}. Lines join the time steps of an engine, dashed with "
      "another integrator; pale line: Pareto front; grey: uncertainty of the reference; bars: the "
      "statistical part; ▽ may be chance: drawn at its upper end; ×, at the upper edge: failed.",
      timeUnit(kind));
  const auto all = otherSettings(points);
  Names numbers;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (std::ranges::any_of(points, [&](const CostPoint& point) {
          return point.kind == kind && point.counted() &&
                 OtherSetting{point.knob, point.setting} == all[k];
        }))
      numbers.push_back(fmt::format("{} {}", k + 1, settingText(all[k].knob, all[k].setting)));
  if (numbers.empty()) return caption;
  return caption + fmt::format(" Open, numbered: other settings: {}.", fmt::join(numbers, ", "));
}

std::string rounded(std::optional<double> value) {
  return value ? fmt::format("{:.2f}", *value) : absentText;
}

std::string bodiesText(const StepTime& time) {
  return readableCount(static_cast<double>(time.bodies));
}

/// A curve for each engine and number of workers, of those that have that figure; bars are the 95 %
/// interval of a time.
Panel stepPanel(const CostResults& results, const char* title, const char* yLabel,
                std::optional<double> StepFigures::*figure, double factor) {
  Panel panel;
  panel.title = title;
  panel.xLabel = "bodies that move";
  panel.yLabel = yLabel;
  panel.logX = true;
  panel.key = Key::none;
  const std::vector<LineStyle> styles = engineStyles(results.engines);
  for (const StepTime& time : results.steps) {
    const auto value = stepFigures(results.steps, time).*figure;
    if (!value) continue;
    const std::string name = fmt::format("{}, {}", time.engine, describeWorkers(time));
    auto curve = std::ranges::find(panel.curves, name, &Curve::name);
    if (curve == panel.curves.end()) {
      const auto engine = std::ranges::find(results.engines, time.engine, &EngineRow::name);
      LineStyle style = styles.at(static_cast<std::size_t>(engine - results.engines.begin()));
      // More workers: another mark.
      constexpr int marks[] = {7, 5, 9, 11, 13};
      style.pointType = marks[static_cast<std::size_t>(std::log2(time.workers)) % 5];
      style.dashed = time.workers > 1;
      curve = panel.curves.insert(curve, {name, style, Draw::linesAndPoints, {}, 1.5});
    }
    Point point{static_cast<double>(time.bodies), factor * *value, {}};
    if (figure == &StepFigures::step && time.low && time.high)
      point.error = 0.5 * factor * (*time.high - *time.low);
    curve->points.push_back(point);
  }
  return panel;
}

}  // namespace

std::string settingText(const std::string& knob, const std::string& setting) {
  const bool speaks = speaksForItself(knob) || knob.starts_with("effect:");
  std::string text = speaks || setting.starts_with(knob) ? setting : knob + " " + setting;
  const auto isLetter = [&](std::size_t k) {
    return k < text.size() && std::isalpha(static_cast<unsigned char>(text[k])) != 0;
  };
  for (std::size_t k = 2; k < text.size(); ++k)  // "t_c" keeps its mark
    if (text[k] == '_' && isLetter(k - 1) && isLetter(k - 2)) text[k] = ' ';
  return text;
}

std::string measureText(const std::string& measure) {
  constexpr std::string_view positions = "position_rms_";
  const std::string scene = withoutOwn(measure);
  if (scene != measure) return measureText(scene) + ", own limit";
  if (measure == "psi_f") return "Ψ_f";
  if (measure == "e_n") return measure;
  if (measure == largestError) return "the endpoint that is farthest off";
  if (!measure.starts_with(positions)) return fieldWords(measure);
  const std::string whom = measure.substr(positions.size());
  return "positions, compared with " + (whom == "own" ? "itself" : whom);
}

std::string timeUnit(CostKind kind) {
  constexpr std::array units = {"one sweep of collisions", "the window", "a second of the scene"};
  return units[static_cast<std::size_t>(kind)];
}

std::vector<CostKind> kindsIn(const Points& points) {
  std::vector<CostKind> kinds;
  for (const CostPoint& point : points) addOnce(kinds, point.kind);
  return kinds;
}

std::vector<OtherSetting> otherSettings(const Points& points) {
  std::vector<OtherSetting> settings;
  for (const CostPoint& point : points)
    if (point.counted() && !schemeOf(point.knob, point.setting))
      addOnce(settings, OtherSetting{point.knob, point.setting});
  return settings;
}

std::vector<Figure> costFigures(const CostResults& results) {
  std::vector<Figure> figures = pictureOf(results);
  for (const CostKind kind : kindsIn(results.points)) {
    if (kind == CostKind::averages) continue;  // has the picture
    Figure figure;
    figure.name = "cost_" + toString(kind);
    figure.title = "Error against time: " + toString(kind);
    for (const CostMeasure& measure : measuresIn(results.points))
      if (measure.kind == kind) figure.panels.push_back(panelOf(results, measure));
    std::erase_if(figure.panels, [](const Panel& panel) { return !hasPoints(panel); });
    if (figure.panels.empty()) continue;
    figure.caption = captionOf(results.points, kind);
    figure.keyAbove = true;
    figure.columns = figure.panels.size() > 1 ? 2 : 1;
    figure.panelWidth = 1040 / figure.columns;
    figure.panelHeight = 360;
    figure.png = true;
    figures.push_back(std::move(figure));
  }
  return figures;
}

std::string scaleCsv(const CostResults& results) {
  std::string table =
      "engine,disks,workers,workers_are,status,step_s,spread,ns_per_disk,strong,weak,ratio,memory_"
      "bytes,bytes_per_disk,contacts_per_step,steps,repetitions,dt_s,precision,measured,differs,"
      "reason,low_s,high_s\n";
  for (const StepTime& time : results.steps) {
    const StepFigures figures = stepFigures(results.steps, time);
    std::string differs;
    for (const std::string& each : time.differs) differs += (differs.empty() ? "" : " ") + each;
    table += row(time.engine, time.bodies, static_cast<std::size_t>(time.workers), time.workersAre,
                 std::string(nameOf(time.status, costStatusNames)), figures.step, figures.spread,
                 times(figures.perBody, 1e9), figures.strong, figures.weak, figures.ratio,
                 time.memory, figures.bytes, time.contacts, static_cast<std::size_t>(time.steps),
                 time.seconds.size(), time.ran() ? std::optional(time.dt) : std::nullopt,
                 time.precision, time.measured, differs, time.reason, time.low, time.high);
  }
  return table;
}

std::optional<Figure> stepFigure(const CostResults& results) {
  Figure figure;
  figure.name = "cost_steps";
  figure.title = "Time of a step against bodies and workers";
  figure.caption =
      "Wall time of a step as the scene grows and threads or ranks (dashed) share it; bars: its 95 "
      "% interval from the rounds. Efficiency 1: p workers take a p-th of one worker's time.";
  figure.panels = {stepPanel(results, "time of a step", "[µs]", &StepFigures::step, 1e6),
                   stepPanel(results, "efficiency of several workers", "T(1)/(p T(p))",
                             &StepFigures::strong, 1.0)};
  figure.panels[0].logY = true;
  figure.panels[1].level = 1.0;
  std::erase_if(figure.panels, [](const Panel& panel) { return !hasPoints(panel); });
  if (figure.panels.empty()) return std::nullopt;
  figure.keyAbove = true;
  figure.columns = static_cast<int>(figure.panels.size());
  figure.panelWidth = 1040 / figure.columns;
  figure.panelHeight = 360;
  return figure;
}

Table stepTable(const CostResults& results) {
  Table table{{engineNames("engine"), numbers("bodies"), numbers("workers"), numbers("step"),
               numbers("ns/body"), numbers("strong"), numbers("weak"), numbers("× first"),
               numbers("bytes/body"), remarks("deviations, or why it did not run")}};
  for (const StepTime& time : results.steps) {
    const StepFigures figures = stepFigures(results.steps, time);
    const auto bytes = figures.bytes ? std::optional(std::round(*figures.bytes)) : std::nullopt;
    const std::string step =
        withEnds(shortDuration(figures.step), shortDuration(time.low), shortDuration(time.high));
    table.rows.push_back({{time.engine, bodiesText(time), describeWorkers(time), step,
                           readable(times(figures.perBody, 1e9)), rounded(figures.strong),
                           rounded(figures.weak), readable(figures.ratio), readableCount(bytes),
                           time.ran() ? listed(time.differs) : time.reason}});
  }
  table.note =
      "Wall time of a step from a state along the flow: geometric mean over the rounds with its 95 "
      "% interval; engines take turns, each round in a fresh process. Strong: T(1, N)/(p T(p, N)); "
      "weak: T(1, N/p)/T(p, N), p workers on a scene p times as large; × first: over the first "
      "engine's with one worker on this scene. Memory is the most of all processes.";
  return table;
}

}  // namespace crossgrain::reports
