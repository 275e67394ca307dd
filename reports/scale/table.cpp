#include "reports/scale/table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reports/common/csv_row.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/sentences.hpp"
#include "reports/scale/report.hpp"
#include "results/json_fields.hpp"

namespace crossgrain::reports {

namespace {

std::optional<double> times(double factor, std::optional<double> value) {
  return value ? std::optional(factor * *value) : std::nullopt;
}

std::string rounded(std::optional<double> value, int digits) {
  return value ? fmt::format("{:.{}f}", *value, digits) : absentText;
}

std::string percent(std::optional<double> share) {
  return share ? fmt::format("{:.0f} %", 100.0 * *share) : absentText;
}

/// Characters, not bytes: every cell's are one column wide.
std::size_t widthOf(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string aligned(const std::string& text, std::size_t width, bool left) {
  const std::string room(width - widthOf(text), ' ');
  return left ? text + room : room + text;
}

}  // namespace

const std::vector<ScaleColumn>& scaleColumns() {
  static const std::vector<ScaleColumn> columns = {
      {"disks", "that move"},
      {"workers", "threads or ranks that share a step"},
      {"step", "wall time of a step, the fastest repetition's"},
      {"ns/disk", "of a step, for each disk"},
      {"spread", "the slowest repetition's step over the fastest's, less one"},
      {"strong", "T(1, N)/(p T(p, N)): of p workers on the cell that one has"},
      {"weak", "T(1, N/p)/T(p, N): of p workers on a cell p times as large"},
      {"× first", "step over that of the first engine with one worker on this cell"},
      {"bytes/disk", "most memory of all its processes, shared pages in each of them"}};
  return columns;
}

std::string workersOf(const ScaleResults& results, const std::string& engine) {
  const auto found = std::ranges::find(results.sharing, engine, &ScaleSharing::engine);
  return found == results.sharing.end() ? std::string() : found->workers;
}

std::vector<std::string> scaleDifferences(const ScaleResults& results, const std::string& engine) {
  std::vector<std::string> differences;
  for (const ScalePoint& point : results.points) {
    if (point.engine != engine || point.status != EngineStatus::ran) continue;
    for (const std::string& name : point.differs)
      if (std::ranges::find(differences, name) == differences.end()) differences.push_back(name);
  }
  return differences;
}

std::string workersInWords(const ScaleResults& results, const ScalePoint& point) {
  return results::workersInWords({point.engine, workersOf(results, point.engine)}, point.workers);
}

std::vector<std::string> scaleCells(const ScaleResults& results, const ScalePoint& point) {
  const ScaleFigures figures = scaleFigures(results, point);
  return {readableCount(static_cast<double>(point.disks)),
          workersInWords(results, point),
          shortDuration(figures.step),
          readable(times(1e9, figures.perDisk)),
          percent(figures.spread),
          rounded(figures.strong, 2),
          rounded(figures.weak, 2),
          readable(figures.ratio),
          readableCount(figures.bytes ? std::optional(std::round(*figures.bytes)) : std::nullopt)};
}

std::string scaleText(const ScaleResults& results) {
  std::vector<std::vector<std::string>> rows = {{"engine"}};
  for (const ScaleColumn& column : scaleColumns()) rows[0].push_back(column.name);
  std::string notes;
  for (const EngineRow& engine : results.engines)
    if (const auto differs = scaleDifferences(results, engine.name); !differs.empty())
      notes += fmt::format("{} differs from the scene: {}\n", engine.name, listed(differs));
  for (const ScalePoint& point : results.points) {
    rows.push_back({point.engine});
    for (std::string& cell : scaleCells(results, point)) rows.back().push_back(std::move(cell));
    if (point.status != EngineStatus::ran)
      notes += fmt::format("{}, {} disks, {}: {}: {}\n", point.engine,
                           readableCount(static_cast<double>(point.disks)),
                           workersInWords(results, point), nameOf(point.status), point.reason);
  }
  std::vector<std::size_t> widths(rows[0].size(), 0);
  for (const auto& cells : rows)
    for (std::size_t k = 0; k < cells.size(); ++k)
      widths[k] = std::max(widths[k], widthOf(cells[k]));
  std::string text;
  for (const auto& cells : rows) {
    for (std::size_t k = 0; k < cells.size(); ++k)
      text += (k == 0 ? "" : "  ") + aligned(cells[k], widths[k], k == 0);
    text += '\n';
  }
  return text + notes;
}

std::string scaleCsv(const ScaleResults& results) {
  std::string table =
      "engine,disks,workers,workers_are,status,step_s,spread,ns_per_disk,strong,weak,ratio,"
      "memory_bytes,bytes_per_disk,contacts_per_step,steps,repetitions,dt_s,precision,measured,"
      "differs,reason\n";
  for (const ScalePoint& point : results.points) {
    const ScaleFigures figures = scaleFigures(results, point);
    const bool ran = point.status == EngineStatus::ran;
    std::string differs;
    for (const std::string& each : point.differs) differs += (differs.empty() ? "" : " ") + each;
    table += row(point.engine, point.disks, static_cast<std::size_t>(point.workers),
                 workersOf(results, point.engine), std::string(nameOf(point.status)), figures.step,
                 figures.spread, times(1e9, figures.perDisk), figures.strong, figures.weak,
                 figures.ratio, point.memory, figures.bytes, point.contacts,
                 static_cast<std::size_t>(point.steps), point.seconds.size(),
                 ran ? std::optional(point.dt) : std::nullopt, point.precision, point.measured,
                 differs, point.reason);
  }
  return table;
}

}  // namespace crossgrain::reports
