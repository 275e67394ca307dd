#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"
#include "reports/couette/engine_runs.hpp"
#include "reports/couette/overview.hpp"
#include "reports/couette/state_view.hpp"

namespace crossgrain::reports {

namespace {

OverviewCell regimeCell(const CouetteRun& run) {
  OverviewCell cell{CellState::notMeasured, {}, {}, {}, {}, "regimes"};
  if (!run.regime) return cell;
  cell.state = run.regime->regime ? CellState::figure : CellState::undecided;
  if (run.regime->regime) cell.shown = toString(*run.regime->regime);
  if (const auto number = finite(run.regime->inertialNumber)) {
    cell.value = number;
    cell.words = fmt::format("inertial number {}", readable(number));
  }
  return cell;
}

/// The series that says most: one that drifts, else the one that may hide the largest change.
const EngineDrift* worstDrift(const CompareResults& results) {
  const EngineDrift* worst = nullptr;
  const auto rank = [](const EngineDrift& row) {
    return std::pair(row.drift.verdict == Drift::drifts, finite(row.drift.excluded).value_or(-1.0));
  };
  for (const EngineDrift& row : results.steadiness)
    if (!worst || rank(row) > rank(*worst)) worst = &row;
  return worst;
}

OverviewCell steadyCell(const CompareResults& results) {
  OverviewCell cell{CellState::notMeasured, {}, "%", {}, {}, "steady-or-not"};
  const EngineDrift* worst = worstDrift(results);
  if (!worst) return cell;
  const RelativeDrift& drift = worst->drift;
  const bool open = std::ranges::any_of(results.steadiness, [](const EngineDrift& row) {
    return row.drift.verdict == Drift::cannotTell;
  });
  const bool drifts = drift.verdict == Drift::drifts;
  cell.state = drifts ? CellState::borderline : open ? CellState::undecided : CellState::good;
  const auto change = finite(drifts ? drift.change : drift.excluded);
  if (change) {
    cell.value = 100.0 * *change;
    cell.shown = fmt::format("{}{} %", drifts ? *change < 0.0 ? "−" : "+" : "± ",
                             readablePercent(std::abs(*change)));
  }
  cell.words = spaced(worst->quantity) + (drifts ? "" : " at most");
  return cell;
}

/// How far the worst of a check's numbers is off what it should be, as a fraction.
std::optional<double> offOf(const CheckRow& check) {
  std::optional<double> most;
  for (std::size_t k = 0; k < check.value.size(); ++k) {
    const auto found = at(check.value, k), expected = at(check.reference, k);
    if (!found || !expected || *expected == 0.0) continue;
    most = std::max(most.value_or(0.0), std::abs(*found / *expected - 1.0));
  }
  return most;
}

OverviewCell balanceCell(const CouetteRun& run) {
  OverviewCell cell{CellState::notMeasured, {}, "%", {}, {}, "balance-checks"};
  for (const CheckRow& check : run.checks) {
    const auto off = offOf(check);
    if (!off || 100.0 * *off <= cell.value.value_or(-1.0)) continue;
    cell.state = CellState::figure;
    cell.value = 100.0 * *off;
    cell.shown = readablePercent(*off) + " % off";
    cell.words = check.value.size() > 1 ? spaced(check.name) + ", worst ring" : spaced(check.name);
  }
  return cell;
}

OverviewCell fitCell(const EngineRuns& engine, std::string_view name) {
  OverviewCell cell{CellState::notMeasured, {}, {}, {}, {}, "fits"};
  const auto fit = std::ranges::find(engine.fits(), name, &FitRow::name);
  if (fit == engine.fits().end()) return cell;
  cell.value = finite(fit->value);
  if (!cell.value) {
    cell.words = "no fit";
    return cell;
  }
  cell.state = CellState::figure;
  if (fit->unit != "-" && fit->unit != "1") cell.unit = fit->unit;
  cell.shown =
      readable(cell.value, fit->standardError) + (cell.unit.empty() ? "" : " " + cell.unit);
  if (const auto expected = finite(fit->expected))
    cell.words = readableSetting(expected) + " by theory";
  return cell;
}

std::string nextStep(const CompareResults& results) {
  if (results.averaging.snapshots == 1)
    return "Next: average more snapshots; one is an instant, not a mean over time.";
  for (const EngineDrift& row : results.steadiness)
    if (row.drift.verdict == Drift::drifts)
      return "Next: average later snapshots; these are of a state that still changes.";
  return "Next: hold these means against those of another engine, averaged in the same way.";
}

/// The numbers that the thesis reads off its profiles.
struct FitColumn {
  const char *name, *fit, *asks;
};
constexpr std::array fitColumns = {
    FitColumn{"exponent of the shear stress", "stress_rp_exponent",
              "With which power of r does the shear stress fall? −2 without bottom friction."},
    FitColumn{"decay of the velocity", "velocity_decay",
              "Over which length does the velocity fall by e?"},
};

}  // namespace

Overview averageOverview(const CompareResults& results) {
  Overview overview;
  overview.rowsAre = "snapshots of";
  overview.columns = {
      {"regime", "In which state was the cell?", ""},
      {"change", "Was it steady? The largest change of a series while it was averaged.", ""},
      {"balance", "How far is the stress of any ring off what the walls' forces call for?", ""}};
  for (const FitColumn& column : fitColumns)
    overview.columns.push_back({column.name, column.asks, "fits"});
  overview.states = {{CellState::good, "no drift seen"},
                     {CellState::borderline, "drifts"},
                     {CellState::undecided, "cannot tell"},
                     {CellState::figure, "nothing is judged by it"}};
  const std::vector<EngineRuns> engines = engineRuns(results);
  for (const EngineRuns& engine : engines) {
    if (engine.finished.empty()) continue;
    const CouetteRun& run = *engine.finished.front();
    OverviewRow row{engine.name, true, {regimeCell(run), steadyCell(results), balanceCell(run)}};
    for (const FitColumn& column : fitColumns) row.cells.push_back(fitCell(engine, column.fit));
    overview.rows.push_back(std::move(row));
  }
  if (overview.rows.empty()) return overview;
  overview.conclusion = {averageLead(results, engines), nextStep(results)};
  const auto states = stateSentences(results, engines);
  if (!states.empty()) overview.conclusion.insert(overview.conclusion.begin() + 1, states.back());
  return overview;
}

}  // namespace crossgrain::reports
