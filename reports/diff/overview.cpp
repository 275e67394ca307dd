#include "reports/diff/overview.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/sentences.hpp"
#include "reports/couette/overview.hpp"
#include "reports/diff/words.hpp"
#include "reports/lockstep/overview.hpp"
#include "reports/lockstep/words.hpp"
#include "results/json_fields.hpp"

namespace crossgrain::reports {
namespace {

CellState stateOf(DiffVerdict verdict) {
  if (verdict == DiffVerdict::notMeasured) return CellState::notMeasured;
  if (verdict == DiffVerdict::undecided) return CellState::undecided;
  return verdict == DiffVerdict::differs ? CellState::bad : CellState::good;
}

OverviewCell windowsCell(const DiffRow& row, const LockstepRules& rules) {
  if (row.forcesVerdict == DiffVerdict::differs && row.windowsVerdict != DiffVerdict::differs) {
    const double most = std::max({row.forces->normal, row.forces->tangential, row.forces->walls});
    return {CellState::bad, 100.0 * most, "%", percentInWords(most), "reported forces", {}};
  }
  OverviewCell cell{stateOf(row.windowsVerdict), {}, "%", {}, {}, {}};
  if (cell.state == CellState::notMeasured) return cell;
  cell.words = spaced(nameOf(row.windowsVerdict));
  if (row.windowsVerdict == DiffVerdict::sameBits) {
    cell.value = 0.0;
    cell.shown = "same bits";
  } else if (row.windows && row.windows->equivalent) {
    const OverviewCell windows = lockstepCell(&*row.windows, rules, false);
    cell.value = windows.value;
    cell.shown = windows.shown;
  }
  return cell;
}

OverviewCell collisionsCell(const DiffRow& row) {
  OverviewCell cell{stateOf(row.collisionsVerdict), {}, "%", {}, {}, {}};
  if (cell.state == CellState::notMeasured) return cell;
  if (row.collisions.empty()) {
    cell.value = 0.0;
    cell.shown = "same bits";
    return cell;
  }
  const auto worst = std::ranges::max_element(row.collisions, {}, &CollisionChange::relative);
  cell.value = 100.0 * worst->relative;
  cell.shown = percentInWords(worst->relative);
  cell.words = spaced(worst->quantity);
  return cell;
}

OverviewCell averagesCell(const DiffRow& row) {
  std::vector<const EndpointRow*> rows;
  for (const EndpointRow& endpoint : row.endpoints) rows.push_back(&endpoint);
  const EndpointRow* worst = gravestOf(rows);
  if (!worst) return {CellState::notMeasured, {}, "margins", {}, {}, {}};
  return endpointCell(*worst, false);
}

OverviewCell declaredCell(const DiffRow& row) {
  const std::size_t count = row.declared.size();
  return {CellState::figure,
          static_cast<double>(count),
          "changes",
          fmt::format("{}", count),
          count > 0 ? row.declared.front().name : "",
          {}};
}

/// Engine by engine what has changed, engines of which the same is said together.
std::string whatChanged(const DiffResults& results) {
  SaidOf said;
  for (const DiffRow& row : results.rows) said.add(row.engine, verdictInWords(row, results.rules));
  std::string sentence;
  for (const auto& [words, engines] : said.all())
    sentence += fmt::format("{}{}: {}", sentence.empty() ? "" : "; ", listed(engines), words);
  return sentence + ".";
}

std::string whatIsOff(const DiffResults& results) {
  SaidOf said;
  for (const DiffRow& row : results.rows)
    if (row.verdict == DiffVerdict::differs && row.windows && row.windows->term)
      said.add(row.engine, constantWords(row.windows->term->name));
  if (said.empty()) return {};
  std::string sentence;
  for (const auto& [term, engines] : said.all())
    sentence += fmt::format("{}{} on {}", sentence.empty() ? "" : "; ", term, listed(engines));
  return fmt::format("What leaves least of the difference when it is changed: {}.", sentence);
}

std::string nextStep(const DiffResults& results) {
  std::vector<std::string> differ;
  for (const DiffRow& row : results.rows)
    if (row.verdict == DiffVerdict::differs) differ.push_back(row.engine);
  if (differ.empty()) return {};
  return fmt::format("Next: where the change of {} is meant, keep a new baseline.", listed(differ));
}

}  // namespace

Overview diffOverview(const DiffResults& results) {
  Overview overview;
  overview.columns = {
      {"windows", "Side by side with what was kept, step by step.", ""},
      {"collisions", "The quantity of two-particle collisions that changed most.", ""},
      {"averages", "The endpoint of whole runs that says most, in margins.", ""},
      {"declared", "What the engine declares otherwise than it did.", ""}};
  for (const DiffRow& row : results.rows)
    overview.rows.push_back({row.engine,
                             true,
                             {windowsCell(row, results.rules), collisionsCell(row),
                              averagesCell(row), declaredCell(row)}});
  if (results.rows.empty()) return overview;
  for (std::string& sentence :
       std::vector{whatChanged(results), whatIsOff(results), nextStep(results)})
    if (!sentence.empty()) overview.conclusion.push_back(std::move(sentence));
  return overview;
}

}  // namespace crossgrain::reports
