// Time of a step against the number of bodies and of workers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/common/csv_row.hpp"
#include "reports/common/engines.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/sentences.hpp"
#include "reports/cost/report.hpp"

namespace crossgrain::reports {

namespace {

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

std::string scaleCsv(const CostResults& results) {
  std::string table =
      "engine,disks,workers,workers_are,status,step_s,spread,ns_per_disk,strong,weak,ratio,"
      "memory_bytes,bytes_per_disk,contacts_per_step,steps,repetitions,dt_s,precision,measured,"
      "differs,reason,low_s,high_s\n";
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
      "% "
      "interval from the rounds. Efficiency 1: p workers take a p-th of one worker's time.";
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
  Table table{{{"engine", Column::Kind::engines},
               {"bodies", Column::Kind::number},
               {"workers", Column::Kind::number},
               {"step", Column::Kind::number},
               {"ns/body", Column::Kind::number},
               {"strong", Column::Kind::number},
               {"weak", Column::Kind::number},
               {"× first", Column::Kind::number},
               {"bytes/body", Column::Kind::number},
               {"deviations, or why it did not run", Column::Kind::remark}},
              {}};
  for (const StepTime& time : results.steps) {
    const StepFigures figures = stepFigures(results.steps, time);
    const auto bytes = figures.bytes ? std::optional(std::round(*figures.bytes)) : std::nullopt;
    std::string step = shortDuration(figures.step);
    if (time.low && time.high)
      step += fmt::format(" ({} to {})", shortDuration(time.low), shortDuration(time.high));
    table.rows.push_back({{time.engine, bodiesText(time), describeWorkers(time), step,
                           readable(times(figures.perBody, 1e9)), rounded(figures.strong),
                           rounded(figures.weak), readable(figures.ratio), readableCount(bytes),
                           time.ran() ? listed(time.differs) : time.reason}});
  }
  table.note =
      "Wall time of a step from a state along the flow: geometric mean over the rounds with its "
      "95 % interval; engines take turns, each round in a fresh process. Strong: T(1, N)/(p T(p, "
      "N)); weak: T(1, N/p)/T(p, N), p workers on a scene p times as large; × first: over the "
      "first "
      "engine's with one worker on this scene. Memory is the most of all processes.";
  return table;
}

}  // namespace crossgrain::reports
