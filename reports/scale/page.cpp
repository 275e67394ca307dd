#include "reports/common/page.hpp"

#include <fmt/format.h>

#include <cmath>

#include "reports/common/engines.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/overview.hpp"
#include "reports/common/sentences.hpp"
#include "reports/scale/overview.hpp"
#include "reports/scale/report.hpp"
#include "reports/scale/table.hpp"

namespace crossgrain::reports {

namespace {

Panel panelOf(const char* yLabel) {
  Panel panel;
  panel.xLabel = "disks";
  panel.yLabel = yLabel;
  panel.logX = true;
  return panel;
}

/// One curve for each engine and number of workers, of those that have that figure.
/// @param always  also curves of engines that are not shared
void addCurves(Panel& panel, const ScaleResults& results,
               std::optional<double> ScaleFigures::*figure, double factor,
               const std::string& suffix = "", bool dashed = false) {
  const std::vector<LineStyle> styles = engineStyles(results.engines);
  for (const ScalePoint& point : results.points) {
    const auto value = scaleFigures(results, point).*figure;
    if (!value) continue;
    const std::string name =
        fmt::format("{}, {}{}", point.engine, workersInWords(results, point), suffix);
    auto curve = std::ranges::find(panel.curves, name, &Curve::name);
    if (curve == panel.curves.end()) {
      const auto engine = std::ranges::find(results.engines, point.engine, &EngineRow::name);
      LineStyle style = styles.at(static_cast<std::size_t>(engine - results.engines.begin()));
      // More workers: another mark.
      constexpr int marks[] = {7, 5, 9, 11, 13};
      style.pointType = marks[static_cast<std::size_t>(std::log2(point.workers)) % 5];
      style.dashed = dashed;
      panel.curves.push_back({name, style, Draw::linesAndPoints, {}, 1.5});
      curve = panel.curves.end() - 1;
    }
    curve->points.push_back({static_cast<double>(point.disks), factor * *value, {}});
  }
}

void addFigure(std::vector<Figure>& figures, const char* name, const char* title,
               const char* caption, Panel panel) {
  if (!hasPoints(panel)) return;
  Figure figure;
  figure.name = name;
  figure.title = title;
  figure.caption = caption;
  figure.panels.push_back(std::move(panel));
  figures.push_back(std::move(figure));
}

Json tableRows(const ScaleResults& results) {
  Json rows = Json::array();
  for (const ScalePoint& point : results.points) {
    Json cells = Json::array();
    for (const std::string& cell : scaleCells(results, point)) cells.push_back(cell);
    Json row = {{"engine", point.engine}, {"cells", cells}};
    row["steps"] = readableCount(static_cast<double>(point.steps));
    row["differs"] = point.status == EngineStatus::ran ? listed(point.differs) : point.reason;
    rows.push_back(std::move(row));
  }
  return rows;
}

Json cellRows(const ScaleResults& results) {
  Json rows = Json::array();
  for (const ScaleCell& cell : results.cells)
    rows.push_back({{"disks", readableCount(static_cast<double>(cell.disks))},
                    {"walls", readableCount(static_cast<double>(cell.wallDisks))},
                    {"radius", readable(cell.outerRadius)},
                    {"fraction", fmt::format("{:.4f}", cell.volumeFraction)}});
  return rows;
}

}  // namespace

std::vector<Figure> scaleFiguresOf(const ScaleResults& results) {
  std::vector<Figure> figures;
  Panel time = panelOf("a step and disk [ns]");
  time.logY = true;
  addCurves(time, results, &ScaleFigures::perDisk, 1e9);
  addFigure(figures, "scale_time", "Time of a step for each disk against disks",
            "Wall time of a step over disks: flat where a cell costs in proportion to its disks.",
            std::move(time));
  Panel efficiency = panelOf("efficiency");
  efficiency.level = 1.0;
  addCurves(efficiency, results, &ScaleFigures::strong, 1.0, ", strong");
  addCurves(efficiency, results, &ScaleFigures::weak, 1.0, ", weak", true);
  addFigure(figures, "scale_efficiency", "Strong and weak efficiency against disks",
            "1: p workers take a p-th of one's time (strong), or as long on p times as many disks "
            "(weak, dashed).",
            std::move(efficiency));
  Panel memory = panelOf("memory of a disk [bytes]");
  memory.logY = true;
  addCurves(memory, results, &ScaleFigures::bytes, 1.0);
  addFigure(figures, "scale_memory", "Most memory for each disk against disks",
            "Most resident memory of all processes of an engine over disks: of small cells most is "
            "the program itself.",
            std::move(memory));
  return figures;
}

std::string scalePage(const ScaleResults& results, const Illustrations& shown) {
  Json view = commonView(results.head, results.elapsed, {}, shown);
  view["lead"] = scaleLead(results);
  view["sentences"] = {
      "Times are of this machine as it was: ratios within one run compare, figures of two runs do "
      "not."};
  addOverview(view, scaleOverview(results), results.engines);
  view["figures"] = figureViews(shown, "scale_");
  view["columns"] = Json::array();
  for (const ScaleColumn& column : scaleColumns())
    view["columns"].push_back({{"name", column.name}, {"meaning", column.meaning}});
  view["rows"] = tableRows(results);
  view["cells"] = cellRows(results);
  view["files"] = "Beside this page: results.json (everything) and scale.csv.";
  return render("report_scale.html", view);
}

}  // namespace crossgrain::reports
