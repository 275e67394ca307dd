#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "reports/flow/report.hpp"

namespace crossgrain::reports {

namespace {

OverviewCell regimeCell(const FlowRun& run) {
  OverviewCell cell{Verdict::notMeasured, {}, {}, {}, {}, "regimes"};
  if (!run.regime) return cell;
  cell.verdict = Verdict::undecided;
  if (run.regime->regime) {
    cell.verdict.reset();
    cell.shown = toString(*run.regime->regime);
  }
  if (const auto number = finite(run.regime->inertialNumber)) {
    cell.value = number;
    cell.words = fmt::format("inertial number {}", readable(number));
  }
  return cell;
}

/// A series that drifts, else the one with the largest change that is not excluded.
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
  OverviewCell cell{Verdict::notMeasured, {}, "%", {}, {}, "steady-or-not"};
  const EngineDrift* worst = worstDrift(results);
  if (!worst) return cell;
  const RelativeDrift& drift = worst->drift;
  const bool open = std::ranges::any_of(results.steadiness, [](const EngineDrift& row) {
    return row.drift.verdict == Drift::cannotTell;
  });
  const bool drifts = drift.verdict == Drift::drifts;
  cell.verdict = drifts ? Verdict::borderline : open ? Verdict::undecided : Verdict::pass;
  const auto change = finite(drifts ? drift.change : drift.excluded);
  if (change) {
    cell.value = 100.0 * *change;
    cell.shown = fmt::format("{}{} %", drifts ? *change < 0.0 ? "−" : "+" : "± ",
                             readablePercent(std::abs(*change)));
  }
  cell.words = spaced(worst->quantity) + (drifts ? "" : " at most");
  return cell;
}

/// The largest relative error of a check's numbers.
std::optional<double> errorOf(const CheckRow& check) {
  std::optional<double> most;
  for (std::size_t k = 0; k < check.value.size(); ++k) {
    const auto found = at(check.value, k), expected = at(check.reference, k);
    if (!found || !expected || *expected == 0.0) continue;
    most = std::max(most.value_or(0.0), std::abs(*found / *expected - 1.0));
  }
  return most;
}

OverviewCell balanceCell(const FlowRun& run) {
  OverviewCell cell{Verdict::notMeasured, {}, "%", {}, {}, "balance-checks"};
  for (const CheckRow& check : run.checks) {
    const auto error = errorOf(check);
    if (!error || 100.0 * *error <= cell.value.value_or(-1.0)) continue;
    cell.verdict = std::nullopt;
    cell.value = 100.0 * *error;
    cell.shown = readablePercent(*error) + " %";
    cell.words = check.value.size() > 1 ? spaced(check.name) + ", worst ring" : spaced(check.name);
  }
  return cell;
}

/// Of a fit, or of the head's numbers: every number that a run of an assembly has, the case's
/// endpoints among them.
OverviewCell numberCell(const auto& number, const char* anchor) {
  OverviewCell cell{Verdict::notMeasured, finite(number.value), {}, {}, {}, anchor};
  if (!cell.value) return cell;
  cell.verdict = std::nullopt;
  if (number.unit != "-" && number.unit != "1") cell.unit = number.unit;
  cell.shown =
      readable(cell.value, number.standardError) + (cell.unit.empty() ? "" : " " + cell.unit);
  return cell;
}

OverviewCell fitCell(const EngineRuns& engine, std::string_view name) {
  OverviewCell cell{Verdict::notMeasured, {}, {}, {}, {}, "fits"};
  const FitRow* const fit = findBy(engine.fits(), name, &FitRow::name);
  if (!fit) return cell;
  cell = numberCell(*fit, "fits");
  if (!cell.value)
    cell.words = "no fit";
  else if (const auto expected = finite(fit->expected))
    cell.words = readableSetting(expected) + " by theory";
  return cell;
}

std::string averageNextStep(const CompareResults& results) {
  if (results.averaging.snapshots == 1)
    return "Next: average more snapshots; one is an instant, not a mean over time.";
  for (const EngineDrift& row : results.steadiness)
    if (row.drift.verdict == Drift::drifts)
      return "Next: average later snapshots; these are of a state that still changes.";
  return "Next: compare them with another engine: crossgrain compare CASE --engines "
         "OTHER,mine=FILES.";
}

/// Numbers that the thesis takes from its profiles.
struct FitColumn {
  const char *name, *fit, *asks;
};
constexpr std::array fitColumns = {
    FitColumn{"exponent of the shear stress", "stress_rp_exponent",
              "With which power of r does the shear stress fall? −2 without bottom friction."},
    FitColumn{"decay of the velocity", "velocity_decay",
              "Over which length does the velocity fall by e?"},
};

/// "t = 0.5 to 1.2 s"; empty without times.
std::string timesOf(const Engines& engines) {
  for (const EngineRuns& engine : engines)
    for (const FlowRun* run : engine.finished) {
      if (!run->series) continue;
      const Numbers& times = valuesOf(*run->series, "t_s");
      if (times.empty()) continue;
      const auto first = finite(times.front()), last = finite(times.back());
      if (first && last)
        return *first == *last
                   ? fmt::format("t = {} s", readableSetting(first))
                   : fmt::format("t = {} to {} s", readableSetting(first), readableSetting(last));
    }
  return {};
}

/// "12 fields in 20 rings".
std::string extentOf(const CompareResults& results, const Engines& engines) {
  std::ptrdiff_t fields = 0;
  for (const EngineRuns& engine : engines)
    fields += std::ranges::count(engine.profiles(), results.averaging.method, &Profile::method);
  return fmt::format("{} in {}", counted(static_cast<std::size_t>(fields), "field"),
                     counted(results.rings.r.size(), results.region ? "bin" : "ring"));
}

/// "40 snapshots of grain averaged: 12 fields in 20 rings.", "4 runs of grain averaged, of 40
/// snapshots each: …"
std::string averageLead(const CompareResults& results, const Engines& engines) {
  if (engines.empty() || engines.front().finished.empty()) return "Nothing was averaged.";
  const std::string snapshots =
      counted(static_cast<std::size_t>(results.averaging.snapshots), "snapshot");
  const std::string& name = engines.front().name;
  const std::string range = engines.front().snapshots();  // of which the study has the most
  const std::string several =
      range.find(' ') == std::string::npos ? snapshots : range + " snapshots";
  if (const std::size_t runs = engines.front().finished.size(); runs > 1)
    return fmt::format("{} of {} averaged, of {} each: {}.", counted(runs, "run"), name, several,
                       extentOf(results, engines));
  return fmt::format("{} of {} averaged: {}.", snapshots, name, extentOf(results, engines));
}

Names averageNotes(const CompareResults& results, const Engines& engines) {
  Names sentences;
  if (engines.empty() || engines.front().finished.empty()) return sentences;
  if (const std::string times = timesOf(engines); !times.empty())
    sentences.push_back("The snapshots are of " + times + ".");
  for (const std::string& state : stateSentences(results, engines)) sentences.push_back(state);
  if (const std::size_t runs = engines.front().finished.size(); runs > 1)
    sentences.push_back(fmt::format(
        "Nothing was run and nothing compared: bars are one standard error over {} runs.", runs));
  else
    sentences.emplace_back(
        "Nothing was run and nothing compared: bars are those within these snapshots, and say "
        "nothing about other packings.");
  if (results.averaging.snapshots == 1)
    sentences.emplace_back("One snapshot is an instant, not an average over time.");
  const std::vector<FitRow>& fits = engines.front().fits();
  const auto refused =
      std::ranges::count_if(fits, [](const FitRow& fit) { return !finite(fit.value); });
  if (refused > 0)
    sentences.push_back(fmt::format("{} of {} have no value; the table of fits has the reasons.",
                                    refused, counted(fits.size(), "fitted number")));
  std::ranges::copy(results.notes, std::back_inserter(sentences));
  return sentences;
}

void addRegionColumns(Overview& overview, const Engines& engines) {
  for (const EngineRuns& engine : engines) {
    OverviewRow row{engine.name, true, {}};
    for (const HeadNumber& number : engine.head()) {
      if (!finite(number.value)) continue;
      overview.columns.push_back({spaced(number.name), "", "engines"});
      row.cells.push_back(numberCell(number, "engines"));
    }
    if (!row.cells.empty()) overview.rows.push_back(std::move(row));
  }
  overview.states = {{std::nullopt, "a number that nothing is judged by"}};
}

/// Whose snapshots: in which state, how steady, how well balanced, and what the fits give.
Overview averageOverview(const CompareResults& results) {
  Overview overview;
  overview.rowsAre = "snapshots of";
  const Engines engines = engineRuns(results);
  if (results.region) {
    addRegionColumns(overview, engines);
    if (!overview.rows.empty())
      overview.conclusion = {averageLead(results, engines), averageNextStep(results)};
    return overview;
  }
  overview.columns = {
      {"regime", "In which state was the cell?", ""},
      {"change", "Was it steady? The largest change of a series while it was averaged.", ""},
      {"balance", "Largest relative error of a ring's stress against the walls' forces.", ""}};
  for (const FitColumn& column : fitColumns)
    overview.columns.push_back({column.name, column.asks, "fits"});
  overview.states = {{Verdict::pass, "no drift seen"},
                     {Verdict::borderline, "drifts"},
                     {Verdict::undecided, "cannot tell"},
                     {std::nullopt, "a number that nothing is judged by"}};
  for (const EngineRuns& engine : engines) {
    if (engine.finished.empty()) continue;
    const FlowRun& run = *engine.finished.front();
    OverviewRow row{engine.name, true, {regimeCell(run), steadyCell(results), balanceCell(run)}};
    for (const FitColumn& column : fitColumns) row.cells.push_back(fitCell(engine, column.fit));
    overview.rows.push_back(std::move(row));
  }
  if (overview.rows.empty()) return overview;
  overview.conclusion = {averageLead(results, engines), averageNextStep(results)};
  const auto states = stateSentences(results, engines);
  if (!states.empty()) overview.conclusion.insert(overview.conclusion.begin() + 1, states.back());
  return overview;
}

}  // namespace

Report averageReport(const CompareResults& results) {
  const Engines engines = engineRuns(results);
  Report report{{results.head, results.engines, averageOverview(results)}, results.elapsed};
  report.caseHeading = results.region ? "The case: its averaged part and weights"
                                      : "The case: its cell, rings and weights";
  report.notes = averageNotes(results, engines);
  report.figures = compareFigures(results);
  if (Table state = stateTable(engines); !state.rows.empty())
    report.section("engines", results.region ? "Numbers" : "State of the cell", "State").blocks = {
        std::move(state)};
  addProfiles(report, results, engines);
  addSeries(report, results, engines);
  report.tables = averageTables(results);
  return report;
}

}  // namespace crossgrain::reports
