#include "reports/scale/overview.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"
#include "reports/common/sentences.hpp"
#include "reports/scale/table.hpp"

namespace crossgrain::reports {

namespace {

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

std::string disksInWords(const ScalePoint& point) {
  return readableCount(static_cast<double>(point.disks)) + " disks";
}

struct Question {
  const char *name, *asks, *unit;
  std::optional<double> ScaleFigures::*figure;
  double factor;
};

constexpr Question questions[] = {
    {"per disk", "Time of a step for each disk, on the largest cell.", "ns", &ScaleFigures::perDisk,
     1e9},
    {"strong", "What p workers save of one's time on the same cell, of p times.", "%",
     &ScaleFigures::strong, 100.0},
    {"weak", "The time of one worker over that of p on a cell p times as large.", "%",
     &ScaleFigures::weak, 100.0},
    {"memory", "Most memory for each disk, on the largest cell.", "bytes", &ScaleFigures::bytes,
     1.0}};

OverviewCell cellOf(const ScaleResults& results, const EngineRow& engine,
                    const Question& question) {
  OverviewCell cell{CellState::notMeasured, {}, question.unit, {}, {}, "table"};
  const ScalePoint* const point = largestWith(results, engine.name, question.figure);
  if (!point) {
    const bool ofSharing =
        question.figure == &ScaleFigures::strong || question.figure == &ScaleFigures::weak;
    if (ofSharing && workersOf(results, engine.name).empty())
      cell.state = CellState::notApplicable;
    else if (engine.status == EngineStatus::failed) {
      cell.state = CellState::bad;
      cell.shown = "failed";
    }
    return cell;
  }
  cell.state = CellState::figure;
  cell.value = question.factor * *(scaleFigures(results, *point).*question.figure);
  cell.shown = fmt::format("{} {}", readable(cell.value), question.unit);
  cell.words = fmt::format("{}, {}", disksInWords(*point), workersInWords(results, *point));
  return cell;
}

/// "grain takes 25 ns a disk and step on 1 000 000 disks (2 threads)"; behind the threads what it
/// does otherwise than the scene says, for it has less to do, or more
std::string fastestOf(const ScaleResults& results, const std::string& engine) {
  const ScalePoint* const point = largestWith(results, engine, &ScaleFigures::perDisk);
  if (!point) return {};
  const auto differs = scaleDifferences(results, engine);
  return fmt::format("{} takes {} ns a disk and step on {} ({}{})", engine,
                     readable(1e9 * *scaleFigures(results, *point).perDisk), disksInWords(*point),
                     workersInWords(results, *point),
                     differs.empty() ? "" : "; otherwise than the scene: " + listed(differs));
}

}  // namespace

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

Overview scaleOverview(const ScaleResults& results) {
  Overview overview;
  for (const Question& question : questions)
    overview.columns.push_back({question.name, question.asks, "table"});
  std::vector<std::string> fastest, stopped;
  for (const EngineRow& engine : results.engines) {
    OverviewRow row{engine.name, true, {}};
    for (const Question& question : questions)
      row.cells.push_back(cellOf(results, engine, question));
    overview.rows.push_back(std::move(row));
    if (std::string words = fastestOf(results, engine.name); !words.empty())
      fastest.push_back(std::move(words));
    const auto trouble = std::ranges::find_if(results.points, [&](const ScalePoint& point) {
      return point.engine == engine.name && point.status != EngineStatus::ran;
    });
    if (trouble != results.points.end())
      stopped.push_back(
          fmt::format("{} ends at {}: {}", engine.name, disksInWords(*trouble), trouble->reason));
  }
  if (!fastest.empty()) overview.conclusion.push_back(listedShortly(fastest, 3) + ".");
  if (!stopped.empty()) overview.conclusion.push_back(listedShortly(stopped, 2) + ".");
  if (results.repetitions < 2)
    overview.conclusion.emplace_back(
        "Next: more repetitions; one says nothing of how much times scatter.");
  return overview;
}

}  // namespace crossgrain::reports
