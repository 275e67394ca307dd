#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "reports/common/numbers.hpp"
#include "reports/flow/figures.hpp"
#include "reports/flow/report.hpp"

namespace crossgrain::reports {

namespace {

struct SeriesPlot {
  std::string name, title, label;
};

const std::vector<SeriesPlot>& seriesPlots() {
  static const std::vector<SeriesPlot> plots = {
      {"wheel_torque", "Torque of the wheel on the disks", "torque [N m]"},
      {"outer_pressure", "Pressure on the outer wall", "pressure [N/m^{2}]"},
      {"shear_share", "Shear among the disks, share of the wheel's rotation (below 0.1: blocked)",
       "shear among the disks / Ω"},
      {"coordination", "Contacts per disk", "contacts per disk"},
      {"kinetic_energy", "Kinetic energy", "kinetic energy [J]"},
      {"disks", "Disks in the averaged part", "disks"},
      {"top", "Highest point of the disks", "height [m]"},
      {"heap_slope", "Slope of the triangle with the disks' moments", "slope"},
  };
  return plots;
}

constexpr std::size_t shownPoints = 80;

/// Means of so many equal parts of a series, each at its mean time.
std::vector<Point> blockMeans(const Numbers& times, const Numbers& values, double timeScale) {
  const std::size_t size = std::min(times.size(), values.size());
  const std::size_t block = std::max<std::size_t>(1, (size + shownPoints - 1) / shownPoints);
  std::vector<Point> means;
  for (std::size_t begin = 0; begin < size; begin += block) {
    double x = 0.0, y = 0.0;
    int count = 0;
    for (std::size_t k = begin; k < std::min(size, begin + block); ++k) {
      const auto time = at(times, k), value = at(values, k);
      if (!time || !value) continue;
      x += *time;
      y += *value;
      ++count;
    }
    if (count > 0) means.push_back({x / count * timeScale, y / count, {}});
  }
  return means;
}

/// Rotations of the wheel per second; absent if it stands.
std::optional<double> rotationRate(const CouetteCell& cell) {
  if (cell.omega == 0.0) return std::nullopt;
  return std::abs(cell.omega) / (2.0 * std::numbers::pi);
}

Panel seriesPanel(const FlowFrame& frame, const std::vector<EngineRuns>& engines,
                  const SeriesPlot& plot) {
  const auto rate = rotationRate(frame.cell);
  Panel panel;
  panel.xLabel = rate ? "rotations since hand-over" : "time since hand-over [s]";
  panel.yLabel = plot.label;
  const auto settle = frame.averaging.settleRotations;
  if (rate && settle && *settle > 0.0) panel.shaded = Range{0.0, *settle};
  for (const EngineRuns& engine : engines) {
    std::string name = engine.name;
    for (const FlowRun* run : engine.runs) {
      if (!run->series) continue;
      const RunSeries& series = *run->series;
      Curve curve{
          name, engine.style, Draw::lines,
          blockMeans(valuesOf(series, "t_s"), valuesOf(series, plot.name), rate.value_or(1.0)),
          1.0};
      if (curve.points.empty()) continue;
      panel.curves.push_back(std::move(curve));
      name.clear();
    }
  }
  chooseLogY(panel);
  double last = 0.0;
  for (const Curve& curve : panel.curves) last = std::max(last, curve.points.back().x);
  if (last > 0.0) panel.xRange = Range{0.0, last};
  return panel;
}

/// value/reference per ring; 1 is balance.
std::vector<Point> balancePoints(const RingPlaces& rings, const CheckRow& check) {
  std::vector<Point> points;
  for (std::size_t ring = 0; ring < check.value.size(); ++ring) {
    const auto x = at(rings.rTilde, ring), value = at(check.value, ring);
    const auto reference = at(check.reference, ring), error = at(check.standardError, ring);
    if (!x || !value || !reference || *reference == 0.0) continue;
    Point point{*x, *value / *reference, {}};
    if (error) point.error = *error / std::abs(*reference);
    points.push_back(point);
  }
  return points;
}

std::vector<Figure> seriesFigures(const FlowFrame& frame, const std::vector<EngineRuns>& engines) {
  std::vector<Figure> figures;
  for (const SeriesPlot& plot : seriesPlots()) {
    Panel panel = seriesPanel(frame, engines, plot);
    if (!hasPoints(panel)) continue;
    figures.push_back(
        {"series_" + plot.name, plot.title + " against time", plot.title + ".", {panel}});
  }
  return figures;
}

std::vector<Figure> checkFigures(const FlowFrame& frame, const std::vector<EngineRuns>& engines) {
  std::vector<Figure> figures;
  std::vector<std::pair<std::string, std::string>> checks;  // name, label
  for (const EngineRuns& engine : engines)
    if (!engine.finished.empty())
      for (const CheckRow& check : engine.finished.front()->checks) {
        if (check.value.size() < 2) continue;
        const std::pair entry(check.name, check.label);
        if (std::ranges::find(checks, entry) == checks.end()) checks.push_back(entry);
      }
  for (const auto& [name, label] : checks) {
    Panel panel;
    panel.xLabel = "(r − R_{i}) / d";
    panel.yLabel = "found / expected";
    panel.xRange = rTildeRange(frame);
    panel.level = 1.0;
    for (const EngineRuns& engine : engines) {
      if (engine.finished.empty()) continue;
      const std::vector<CheckRow>& ofEngine = engine.finished.front()->checks;
      const auto check = std::ranges::find(ofEngine, name, &CheckRow::name);
      if (check == ofEngine.end()) continue;
      Curve curve{engine.name, engine.style, Draw::linesAndPoints,
                  balancePoints(frame.rings, *check), 1.5};
      if (!curve.points.empty()) panel.curves.push_back(std::move(curve));
    }
    if (!hasPoints(panel)) continue;
    figures.push_back({fmt::format("check_{}", figures.size() + 1),
                       label,
                       label + ". Bars: ± one standard error within the run.",
                       {panel}});
  }
  return figures;
}

}  // namespace

std::vector<Figure> compareFigures(const CompareResults& results) {
  const std::vector<EngineRuns> engines = engineRuns(results);
  std::vector<Figure> figures = profileFigures(results, engines);
  for (auto more : {differenceFigures(results, engines), checkFigures(results, engines),
                    seriesFigures(results, engines), distributionFigures(results, engines)})
    std::ranges::move(more, std::back_inserter(figures));
  return figures;
}

}  // namespace crossgrain::reports
