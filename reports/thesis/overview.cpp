#include "reports/thesis/overview.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reports/common/numbers.hpp"
#include "reports/common/overview_marks.hpp"
#include "reports/common/page.hpp"
#include "reports/common/sentences.hpp"
#include "reports/thesis/report.hpp"

namespace crossgrain::reports {

namespace {

using Names = std::vector<std::string>;

constexpr std::size_t mostIds = 6;     ///< ids are short
constexpr const char* noEngine = "-";  ///< a claim's engine where none takes part

CellState stateOf(ClaimVerdict verdict) {
  if (verdict == ClaimVerdict::reproduced) return CellState::good;
  return verdict == ClaimVerdict::refuted ? CellState::bad : CellState::undecided;
}

/// A claim on one engine, its first reading first.
std::vector<const ClaimRow*> readingsOf(const ThesisResults& results, const std::string& engine,
                                        const std::string& id) {
  std::vector<const ClaimRow*> readings;
  for (const ClaimRow& claim : results.claims)
    if (claim.engine == engine && claim.id == id) readings.push_back(&claim);
  return readings;
}

/// The figure that refutes a claim, or leaves it open; else the one that stands for it.
const ClaimFigure* decidingFigure(const ClaimRow& claim) {
  if (claim.figures.empty()) return nullptr;
  const auto decides = std::ranges::find(claim.figures, claim.verdict, &ClaimFigure::verdict);
  return decides == claim.figures.end() ? &claim.figures.front() : &*decides;
}

/// "C⁻¹ [4 … 7]; ✓ under wall spacing 7 mm"
std::string wordsOf(const std::vector<const ClaimRow*>& readings, const ClaimFigure* figure) {
  std::string words;
  if (figure) {
    const std::string bounds = boundsInWords(*figure);
    words = figure->name + (bounds.empty() ? "" : " [" + bounds + "]");
  }
  for (std::size_t k = 1; k < readings.size(); ++k) {
    const ClaimRow& other = *readings[k];
    if (other.verdict == readings.front()->verdict || other.verdict == ClaimVerdict::undecided)
      continue;
    words += fmt::format("{}{} under {}", words.empty() ? "" : "; ",
                         lookOf(stateOf(other.verdict)).mark, other.reading);
    break;  // the table has the others
  }
  return words;
}

OverviewCell cellOf(const std::vector<const ClaimRow*>& readings) {
  OverviewCell cell{CellState::notApplicable, {}, {}, {}, {}, {}};
  if (readings.empty()) return cell;
  const ClaimRow& claim = *readings.front();
  cell.state = stateOf(claim.verdict);
  cell.anchor = claim.id;
  const ClaimFigure* figure = decidingFigure(claim);
  cell.words = wordsOf(readings, figure);
  if (!figure || !finite(figure->value)) return cell;
  cell.value = figure->value;
  cell.unit = figure->unit;
  cell.shown = readable(cell.value) + (cell.unit.empty() ? "" : "\u00a0" + cell.unit);
  return cell;
}

/// Those that claims are about, as the results have them; then what needs none.
Names rowsOf(const ThesisResults& results) {
  Names rows;
  const auto add = [&](const std::string& name) {
    const bool judged =
        std::ranges::find(results.claims, name, &ClaimRow::engine) != results.claims.end();
    if (judged && std::ranges::find(rows, name) == rows.end()) rows.push_back(name);
  };
  for (const EngineRow& engine : results.engines) add(engine.name);
  for (const ClaimRow& claim : results.claims)
    if (claim.engine != noEngine) add(claim.engine);
  add(noEngine);
  return rows;
}

std::string inWords(const std::string& engine) {
  return engine == noEngine ? "without any engine" : "on " + engine;
}

/// First readings with that verdict on an engine.
std::vector<const ClaimRow*> claimsWith(const ThesisResults& results, const std::string& engine,
                                        ClaimVerdict verdict) {
  std::vector<const ClaimRow*> claims;
  Names seen;
  for (const ClaimRow& claim : results.claims) {
    if (claim.engine != engine || std::ranges::find(seen, claim.id) != seen.end()) continue;
    seen.push_back(claim.id);
    if (claim.verdict == verdict) claims.push_back(&claim);
  }
  return claims;
}

/// "On grain 9 claims are reproduced, 9 refuted and 9 undecided; …"
std::string howManyHold(const ThesisResults& results) {
  std::string words;
  for (const std::string& engine : rowsOf(results)) {
    const auto count = [&](ClaimVerdict verdict) {
      return claimsWith(results, engine, verdict).size();
    };
    words += fmt::format("{}{}: {} reproduced, {} refuted, {} undecided",
                         words.empty() ? "Claims " : "; ", inWords(engine),
                         count(ClaimVerdict::reproduced), count(ClaimVerdict::refuted),
                         count(ClaimVerdict::undecided));
  }
  return words.empty() ? words : words + ".";
}

/// Which are refuted, and whether anybody knows why.
std::string whatIsRefuted(const ThesisResults& results) {
  Names parts;
  std::size_t all = 0, unexplained = 0;
  for (const std::string& engine : rowsOf(results)) {
    Names ids;
    for (const ClaimRow* claim : claimsWith(results, engine, ClaimVerdict::refuted)) {
      ids.push_back(claim->id);
      unexplained += claim->reasons.empty();
    }
    all += ids.size();
    if (!ids.empty())
      parts.push_back(fmt::format("{} {}", listedShortly(ids, mostIds), inWords(engine)));
  }
  if (parts.empty()) return {};
  std::string words = "Refuted: ";
  for (std::size_t k = 0; k < parts.size(); ++k) words += (k == 0 ? "" : "; ") + parts[k];
  return fmt::format("{}; the table of claims has what was found of {}.", words,
                     unexplained == 0 ? all == 1 ? std::string("the reason") : "their reasons"
                                      : fmt::format("why, of {} nothing", unexplained));
}

std::string nextStep(const ThesisResults& results) {
  const auto ran = [&](const ThesisLeg& leg) {
    return std::ranges::any_of(results.runs, [&](const ThesisRun& run) {
      return run.leg == leg.name && run.run.finished();
    });
  };
  const auto left = static_cast<std::size_t>(
      std::ranges::count_if(results.legs, [&](const ThesisLeg& leg) { return !ran(leg); }));
  std::size_t open = 0;
  for (const std::string& engine : rowsOf(results))
    open += claimsWith(results, engine, ClaimVerdict::undecided).size();
  if (open == 0) return "Nothing is left to decide by these rules.";
  if (left > 0)
    return fmt::format(
        "Next: the same command with a larger --budget runs the {} of {} legs that nobody has run; "
        "what is undecided may rest on them.",
        left, results.legs.size());
  return "Next: see what each undecided claim lacks, in the table of claims.";
}

}  // namespace

Overview thesisOverview(const ThesisResults& results) {
  Overview overview;
  overview.states = {{CellState::good, "reproduced"},
                     {CellState::bad, "refuted"},
                     {CellState::notApplicable, "no claim of it"}};
  for (const ClaimRow& claim : results.claims)
    if (std::ranges::find(overview.columns, claim.id, &OverviewColumn::name) ==
        overview.columns.end())
      overview.columns.push_back({claim.id, claim.claim, claim.id});
  for (const std::string& engine : rowsOf(results)) {
    OverviewRow row{engine == noEngine ? "no engine" : engine, engine != noEngine, {}};
    for (const OverviewColumn& column : overview.columns)
      row.cells.push_back(cellOf(readingsOf(results, engine, column.name)));
    overview.rows.push_back(std::move(row));
  }
  if (overview.rows.empty()) return overview;
  for (std::string& sentence :
       std::vector{howManyHold(results), whatIsRefuted(results), nextStep(results)})
    if (!sentence.empty()) overview.conclusion.push_back(std::move(sentence));
  return overview;
}

}  // namespace crossgrain::reports
