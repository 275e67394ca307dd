#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reports/common/figures.hpp"

namespace crossgrain::reports {

namespace {

struct SeriesPlot {
  std::string name, title, label;
};

const std::vector<SeriesPlot>& seriesPlots() {
  static const std::vector<SeriesPlot> plots = {
      {"wheel_torque", "Torque of the wheel on the disks", "torque [N m]"},
      {"outer_pressure", "Pressure on the outer wall", "pressure [N/m^{2}]"},
      {"shear_share", "What layers take up of the wheel's rotation (below 0.1: blocked)",
       "shear among the disks / Ω"},
      {"coordination", "Contacts per disk", "contacts per disk"},
      {"kinetic_energy", "Kinetic energy", "kinetic energy [J]"},
  };
  return plots;
}

constexpr std::size_t shownPoints = 80;

/// Means of so many equal parts of a series, each at its mean time.
std::vector<Point> blockMeans(const Json& times, const Json& values, double timeScale) {
  const std::size_t size = std::min(times.size(), values.size());
  const std::size_t block = std::max<std::size_t>(1, (size + shownPoints - 1) / shownPoints);
  std::vector<Point> means;
  for (std::size_t begin = 0; begin < size; begin += block) {
    double x = 0.0, y = 0.0;
    int count = 0;
    for (std::size_t k = begin; k < std::min(size, begin + block); ++k) {
      const auto time = number(times[k]), value = number(values[k]);
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
std::optional<double> rotationRate(const Json& results) {
  const auto omega = number(member(results, "cell"), "omega");
  if (!omega || *omega == 0.0) return std::nullopt;
  return std::abs(*omega) / (2.0 * std::numbers::pi);
}

Panel seriesPanel(const Json& results, const std::vector<EngineResults>& engines,
                  const SeriesPlot& plot) {
  const auto rate = rotationRate(results);
  Panel panel;
  panel.xLabel = rate ? "rotations since hand-over" : "time since hand-over [s]";
  panel.yLabel = plot.label;
  const auto settle = number(member(results, "averaging"), "settle_rotations");
  if (rate && settle && *settle > 0.0) panel.shaded = Range{0.0, *settle};
  for (const EngineResults& engine : engines) {
    std::string name = engine.name;
    for (const Json* run : engine.runs) {
      const Json& series = member(*run, "series");
      Curve curve{name, engine.style, Draw::lines,
                  blockMeans(list(series, "t_s"), list(series, plot.name), rate.value_or(1.0)),
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
std::vector<Point> balancePoints(const Json& results, const Json& check) {
  std::vector<Point> points;
  for (std::size_t ring = 0; ring < list(check, "value").size(); ++ring) {
    const auto x = number(element(list(member(results, "rings"), "r_tilde"), ring));
    const auto value = number(list(check, "value")[ring]);
    const auto reference = number(element(list(check, "reference"), ring));
    const auto error = number(element(list(check, "stderr"), ring));
    if (!x || !value || !reference || *reference == 0.0) continue;
    Point point{*x, *value / *reference, {}};
    if (error) point.error = *error / std::abs(*reference);
    points.push_back(point);
  }
  return points;
}

}  // namespace

std::vector<Figure> seriesFigures(const Json& results, const std::vector<EngineResults>& engines) {
  std::vector<Figure> figures;
  for (const SeriesPlot& plot : seriesPlots()) {
    Panel panel = seriesPanel(results, engines, plot);
    if (!hasPoints(panel)) continue;
    Figure figure;
    figure.name = "series_" + plot.name;
    figure.title = plot.title + " against time";
    figure.caption = plot.title + ".";
    figure.panels.push_back(std::move(panel));
    figures.push_back(std::move(figure));
  }
  return figures;
}

std::vector<Figure> checkFigures(const Json& results, const std::vector<EngineResults>& engines) {
  std::vector<Figure> figures;
  std::vector<std::pair<std::string, std::string>> checks;  // name, label
  for (const EngineResults& engine : engines)
    if (!engine.finished.empty())
      for (const Json& check : list(*engine.finished.front(), "checks")) {
        if (list(check, "value").size() < 2) continue;
        const std::pair entry(text(check, "name"), text(check, "label"));
        if (std::ranges::find(checks, entry) == checks.end()) checks.push_back(entry);
      }
  for (const auto& [name, label] : checks) {
    Panel panel;
    panel.xLabel = "(r − R_{i}) / d";
    panel.yLabel = "found / expected";
    panel.xRange = rTildeRange(results);
    panel.level = 1.0;
    for (const EngineResults& engine : engines) {
      if (engine.finished.empty()) continue;
      const Json& check = findByText(*engine.finished.front(), "checks", "name", name);
      Curve curve{engine.name, engine.style, Draw::linesAndPoints, balancePoints(results, check),
                  1.5};
      if (!curve.points.empty()) panel.curves.push_back(std::move(curve));
    }
    if (!hasPoints(panel)) continue;
    Figure figure;
    figure.name = fmt::format("check_{}", figures.size() + 1);
    figure.title = label;
    figure.caption = label + ". Bars: ± one standard error within the run.";
    figure.panels.push_back(std::move(panel));
    figures.push_back(std::move(figure));
  }
  return figures;
}

std::vector<Figure> compareFigures(const Json& results) {
  const std::vector<EngineResults> engines = engineResults(results);
  std::vector<Figure> figures = profileFigures(results, engines);
  for (auto& figure : checkFigures(results, engines)) figures.push_back(std::move(figure));
  for (auto& figure : seriesFigures(results, engines)) figures.push_back(std::move(figure));
  for (auto& figure : distributionFigures(results, engines)) figures.push_back(std::move(figure));
  return figures;
}

}  // namespace crossgrain::reports
