#include "reports/scale/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/common/csv_row.hpp"
#include "reports/common/engines.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/overview.hpp"
#include "reports/common/sentences.hpp"
#include "results/json_fields.hpp"

namespace crossgrain::reports {

namespace {

std::string describeDisks(std::size_t disks) {
  return readableCount(static_cast<double>(disks)) + " disks";
}

std::string rounded(std::optional<double> value, int digits) {
  return value ? fmt::format("{:.{}f}", *value, digits) : absentText;
}

std::string sharePercent(std::optional<double> share) {
  return share ? fmt::format("{:.0f} %", 100.0 * *share) : absentText;
}

/// What workers are to the engine; empty: it has one.
std::string sharedBy(const ScaleResults& results, const std::string& engine) {
  const auto found = std::ranges::find(results.sharing, engine, &ScaleSharing::engine);
  return found == results.sharing.end() ? std::string() : found->workers;
}

/// "2 threads"; "one process" of an engine that has no workers.
std::string describeWorkers(const ScaleResults& results, const ScalePoint& point) {
  return results::describeWorkers({point.engine, sharedBy(results, point.engine)}, point.workers);
}

/// Names of the engine's deviations from the scene, on any cell that it ran.
std::vector<std::string> deviationsOf(const ScaleResults& results, const std::string& engine) {
  std::vector<std::string> names;
  for (const ScalePoint& point : results.points) {
    if (point.engine != engine || point.status != Status::finished) continue;
    for (const std::string& name : point.differs)
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

/// Of the tables on the page and the terminal; and what each column means.
constexpr std::pair<const char*, const char*> scaleColumns[] = {
    {"disks", "that move"},
    {"workers", "threads or ranks that share a step"},
    {"step", "wall time of a step, the fastest repetition's"},
    {"ns/disk", "of a step, for each disk"},
    {"spread", "the slowest repetition's step over the fastest's, less one"},
    {"strong", "T(1, N)/(p T(p, N)): of p workers on the cell that one has"},
    {"weak", "T(1, N/p)/T(p, N): of p workers on a cell p times as large"},
    {"× first", "step over that of the first engine with one worker on this cell"},
    {"bytes/disk", "most memory of all its processes, shared pages in each of them"}};

/// A cell for each column; a dash where there is no number.
std::vector<std::string> scaleCells(const ScaleResults& results, const ScalePoint& point) {
  const ScaleFigures figures = scaleFigures(results, point);
  return {readableCount(static_cast<double>(point.disks)),
          describeWorkers(results, point),
          shortDuration(figures.step),
          readable(times(figures.perDisk, 1e9)),
          sharePercent(figures.spread),
          rounded(figures.strong, 2),
          rounded(figures.weak, 2),
          readable(figures.ratio),
          readableCount(figures.bytes ? std::optional(std::round(*figures.bytes)) : std::nullopt)};
}

/// Of an engine's points that ran and have that figure, the one of the largest cell, and of that
/// the fastest, or of other figures the one of most workers; null where there is none.
const ScalePoint* largestWith(const ScaleResults& results, const std::string& engine,
                              std::optional<double> ScaleFigures::*figure) {
  const ScalePoint* largest = nullptr;
  std::optional<double> of;
  for (const ScalePoint& point : results.points) {
    const auto value = scaleFigures(results, point).*figure;
    if (point.engine != engine || !value) continue;
    const bool slower = largest && largest->disks == point.disks &&
                        figure == &ScaleFigures::perDisk && *value > *of;
    if (slower) continue;
    largest = &point;
    of = value;
  }
  return largest;
}

struct ScaleQuestion {
  const char *name, *asks, *unit;
  std::optional<double> ScaleFigures::*figure;
  double factor;
};

constexpr ScaleQuestion scaleQuestions[] = {
    {"per disk", "Time of a step for each disk, on the largest cell.", "ns", &ScaleFigures::perDisk,
     1e9},
    {"strong", "What p workers save of one's time on the same cell, of p times.", "%",
     &ScaleFigures::strong, 100.0},
    {"weak", "The time of one worker over that of p on a cell p times as large.", "%",
     &ScaleFigures::weak, 100.0},
    {"memory", "Most memory for each disk, on the largest cell.", "bytes", &ScaleFigures::bytes,
     1.0}};

OverviewCell scaleCell(const ScaleResults& results, const EngineRow& engine,
                       const ScaleQuestion& question) {
  OverviewCell cell{Verdict::notMeasured, {}, question.unit, {}, {}, "table"};
  const ScalePoint* const point = largestWith(results, engine.name, question.figure);
  if (!point) {
    const bool ofSharing =
        question.figure == &ScaleFigures::strong || question.figure == &ScaleFigures::weak;
    if (ofSharing && sharedBy(results, engine.name).empty())
      cell.verdict = Verdict::notApplicable;
    else if (engine.status == Status::failed) {
      cell.verdict = Verdict::fail;
      cell.shown = "failed";
    }
    return cell;
  }
  cell.verdict = std::nullopt;
  cell.value = question.factor * *(scaleFigures(results, *point).*question.figure);
  cell.shown = fmt::format("{} {}", readable(cell.value), question.unit);
  cell.words = fmt::format("{}, {}", describeDisks(point->disks), describeWorkers(results, *point));
  return cell;
}

/// "grain takes 25 ns a disk and step on 1 000 000 disks (2 threads)", with its deviations from the
/// scene: with them it has less to do, or more
std::string fastestOf(const ScaleResults& results, const std::string& engine) {
  const ScalePoint* const point = largestWith(results, engine, &ScaleFigures::perDisk);
  if (!point) return {};
  const auto differs = deviationsOf(results, engine);
  return fmt::format("{} takes {} ns a disk and step on {} ({}{})", engine,
                     readable(1e9 * *scaleFigures(results, *point).perDisk),
                     describeDisks(point->disks), describeWorkers(results, *point),
                     differs.empty() ? "" : "; deviations: " + listed(differs));
}

/// "3 cells of 1 000 to 100 000 disks, 2 engines: …"
std::string scaleLead(const ScaleResults& results) {
  if (results.cells.empty()) return "Nothing was timed.";
  const auto disks = [](const ScaleCell& cell) {
    return readableCount(static_cast<double>(cell.disks));
  };
  return fmt::format("{} of {} to {} disks, {}: {} of the same steps, a fresh process for each.",
                     counted(results.cells.size(), "cell"), disks(results.cells.front()),
                     disks(results.cells.back()), counted(results.engines.size(), "engine"),
                     counted(results.repetitions, "repetition"));
}

Panel scalePanel(const char* yLabel) {
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
        fmt::format("{}, {}{}", point.engine, describeWorkers(results, point), suffix);
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

void addScaleFigure(std::vector<Figure>& figures, const char* name, const char* title,
                    const char* caption, Panel panel) {
  if (!hasPoints(panel)) return;
  Figure figure;
  figure.name = name;
  figure.title = title;
  figure.caption = caption;
  figure.panels.push_back(std::move(panel));
  figures.push_back(std::move(figure));
}

/// scale_time, scale_efficiency and scale_memory, against disks.
std::vector<Figure> scaleFiguresOf(const ScaleResults& results) {
  std::vector<Figure> figures;
  Panel time = scalePanel("a step and disk [ns]");
  time.logY = true;
  addCurves(time, results, &ScaleFigures::perDisk, 1e9);
  addScaleFigure(
      figures, "scale_time", "Time of a step for each disk against disks",
      "Wall time of a step over disks: flat where a cell costs in proportion to its disks.",
      std::move(time));
  Panel efficiency = scalePanel("efficiency");
  efficiency.level = 1.0;
  addCurves(efficiency, results, &ScaleFigures::strong, 1.0, ", strong");
  addCurves(efficiency, results, &ScaleFigures::weak, 1.0, ", weak", true);
  addScaleFigure(
      figures, "scale_efficiency", "Strong and weak efficiency against disks",
      "1: p workers take a p-th of one's time (strong), or as long on p times as many disks "
      "(weak, dashed).",
      std::move(efficiency));
  Panel memory = scalePanel("memory of a disk [bytes]");
  memory.logY = true;
  addCurves(memory, results, &ScaleFigures::bytes, 1.0);
  addScaleFigure(
      figures, "scale_memory", "Most memory for each disk against disks",
      "Most resident memory of all processes of an engine over disks: of small cells most is "
      "the program itself.",
      std::move(memory));
  return figures;
}

/// A row per engine, size and number of workers.
std::string scaleCsv(const ScaleResults& results) {
  std::string table =
      "engine,disks,workers,workers_are,status,step_s,spread,ns_per_disk,strong,weak,ratio,"
      "memory_bytes,bytes_per_disk,contacts_per_step,steps,repetitions,dt_s,precision,measured,"
      "differs,reason\n";
  for (const ScalePoint& point : results.points) {
    const ScaleFigures figures = scaleFigures(results, point);
    const bool ran = point.status == Status::finished;
    std::string differs;
    for (const std::string& each : point.differs) differs += (differs.empty() ? "" : " ") + each;
    table += row(point.engine, point.disks, static_cast<std::size_t>(point.workers),
                 sharedBy(results, point.engine),
                 std::string(nameOf(point.status, engineStatusNames)), figures.step, figures.spread,
                 times(figures.perDisk, 1e9), figures.strong, figures.weak, figures.ratio,
                 point.memory, figures.bytes, point.contacts, static_cast<std::size_t>(point.steps),
                 point.seconds.size(), ran ? std::optional(point.dt) : std::nullopt,
                 point.precision, point.measured, differs, point.reason);
  }
  return table;
}

}  // namespace

Overview scaleOverview(const ScaleResults& results) {
  Overview overview;
  for (const ScaleQuestion& question : scaleQuestions)
    overview.columns.push_back({question.name, question.asks, "table"});
  std::vector<std::string> fastest, stopped;
  for (const EngineRow& engine : results.engines) {
    OverviewRow row{engine.name, true, {}};
    for (const ScaleQuestion& question : scaleQuestions)
      row.cells.push_back(scaleCell(results, engine, question));
    overview.rows.push_back(std::move(row));
    fastest.push_back(fastestOf(results, engine.name));
    const auto trouble = std::ranges::find_if(results.points, [&](const ScalePoint& point) {
      return point.engine == engine.name && point.status != Status::finished;
    });
    if (trouble != results.points.end())
      stopped.push_back(fmt::format("{} ends at {}: {}", engine.name, describeDisks(trouble->disks),
                                    trouble->reason));
  }
  fastest = nonEmpty(std::move(fastest));
  if (!fastest.empty()) overview.conclusion.push_back(listedShortly(fastest, 3) + ".");
  if (!stopped.empty()) overview.conclusion.push_back(listedShortly(stopped, 2) + ".");
  if (results.repetitions < 2)
    overview.conclusion.emplace_back(
        "Next: more repetitions; one says nothing of how much times scatter.");
  return overview;
}

std::string scaleText(const ScaleResults& results) {
  std::vector<std::vector<std::string>> rows = {{"engine"}};
  for (const auto& [name, meaning] : scaleColumns) rows[0].emplace_back(name);
  std::string notes;
  for (const EngineRow& engine : results.engines)
    if (const auto deviations = deviationsOf(results, engine.name); !deviations.empty())
      notes += fmt::format("{}: deviations from the scene: {}\n", engine.name, listed(deviations));
  for (const ScalePoint& point : results.points) {
    rows.push_back({point.engine});
    for (std::string& cell : scaleCells(results, point)) rows.back().push_back(std::move(cell));
    if (point.status != Status::finished)
      notes += fmt::format("{}, {}, {}: {}: {}\n", point.engine, describeDisks(point.disks),
                           describeWorkers(results, point), nameOf(point.status, engineStatusNames),
                           point.reason);
  }
  return alignedText(rows) + notes;
}

Report reportOf(const ScaleResults& results) {
  using Kind = Column::Kind;
  Report report{{results.head, results.engines, scaleOverview(results)}};
  report.elapsed = results.elapsed;
  report.engineColours = false;  // marks say how many workers there are, and plots have their keys
  report.notes = {
      scaleLead(results),
      "Times are of this machine as it was: ratios within one run compare, numbers of two runs do "
      "not."};
  report.figures = scaleFiguresOf(results);
  report.section("figures", "Time, efficiency and memory against disks", "Plots").blocks = {
      drawingsOf(report.figures, "scale_")};
  Table table{{{"engine", Kind::engines}}, {}};
  List reading;
  for (const auto& [name, meaning] : scaleColumns) {
    table.columns.emplace_back(name, Kind::number);
    reading.items.push_back({name, fmt::format("{}.", meaning)});
  }
  table.columns.emplace_back("steps", Kind::number);
  table.columns.emplace_back("deviations, or why it did not run", Kind::remark);
  for (const ScalePoint& point : results.points) {
    TableRow row{{point.engine}};
    for (const std::string& cell : scaleCells(results, point)) row.cells.emplace_back(cell);
    row.cells.emplace_back(readableCount(static_cast<double>(point.steps)));
    row.cells.emplace_back(point.status == Status::finished ? listed(point.differs) : point.reason);
    table.rows.push_back(std::move(row));
  }
  report.section("table", "All timings").blocks.push_back(std::move(table));
  Table cells{{{"disks", Kind::number},
               {"wall disks", Kind::number},
               {"outer radius [m]", Kind::number},
               {"volume fraction of the ring", Kind::number}},
              {}};
  for (const ScaleCell& cell : results.cells)
    cells.rows.push_back(
        {{readableCount(static_cast<double>(cell.disks)),
          readableCount(static_cast<double>(cell.wallDisks)), readable(cell.outerRadius),
          fmt::format("{:.4f}", cell.volumeFraction)}});
  report.section("cells", "Cells").blocks = {
      Paragraph{
          "The thesis' cell with radii grown: sizes of disks, the rim's speed and the volume "
          "fraction of the room between the walls are kept; that of the whole ring rises with "
          "the cell, as walls take less of it."},
      std::move(cells)};
  report.section("reading", "How to read it").blocks = {
      std::move(reading),
      Paragraph{"All engines of one size take turns from the same packing, in a fresh process each "
                "time, and the same steps are timed after a tenth as many to warm up, with the "
                "neighbour lists that they need."}};
  report.tables = {{"scale.csv", scaleCsv(results)}};
  return report;
}

}  // namespace crossgrain::reports
