#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/sentences.hpp"
#include "reports/flow/endpoint_text.hpp"
#include "reports/flow/engine_table.hpp"
#include "reports/flow/figures.hpp"
#include "reports/flow/overview.hpp"
#include "reports/flow/report.hpp"
#include "reports/lockstep/report.hpp"

namespace crossgrain::reports {

namespace {

using Engines = std::vector<EngineRuns>;
using Kind = Column::Kind;

const FitRow* fitOf(const EngineRuns& engine, const std::string& name) {
  const auto found = std::ranges::find(engine.fits(), name, &FitRow::name);
  return found == engine.fits().end() ? nullptr : &*found;
}

Cell fitCell(const FitRow* fit) {
  if (!fit) return absentText;
  const auto value = finite(fit->value), chi2 = finite(fit->chi2PerDof);
  std::vector<std::string> notes;
  if (value && chi2) notes.push_back("χ²/dof " + readable(chi2));
  if (fit->packings && fit->ofPackings && *fit->packings < *fit->ofPackings)
    notes.push_back(
        fmt::format("{} of {} packings can be fitted", *fit->packings, *fit->ofPackings));
  if (!value) notes.push_back(fit->reason);
  return {readable(value, fit->standardError), std::move(notes)};
}

Table fitTable(const Engines& engines) {
  Table table{engineColumns({"quantity", {"expected", Kind::number}}, engines), {}};
  table.columns.emplace_back("unit");
  std::vector<std::string> names;
  for (const EngineRuns& engine : engines)
    for (const FitRow& fit : engine.fits())
      if (std::ranges::find(names, fit.name) == names.end()) names.push_back(fit.name);
  for (const std::string& name : names) {
    TableRow row{{name, absentText}};
    std::string unit;
    for (const EngineRuns& engine : engines) {
      const FitRow* fit = fitOf(engine, name);
      row.cells.push_back(fitCell(fit));
      if (!fit) continue;
      if (!fit->label.empty()) row.cells[0].text = fit->label;
      if (fit->unit != "-" && fit->unit != "1") unit = fit->unit;
      if (finite(fit->expected)) row.cells[1].text = readableSetting(fit->expected);
    }
    row.cells.emplace_back(unit);
    table.rows.push_back(std::move(row));
  }
  table.note =
      "Errors: over packings where there are several, else of the one fit. χ²/dof is a mean over "
      "packings, with bars within the run; absent where points weigh alike. Where fewer than half "
      "of the packings can be fitted there is no value: a decay longer than the range of the "
      "rings, "
      "an amplitude far beyond the data or a curve that misses the points is not a result.";
  return table;
}

/// Checks of a single number: found, and expected, of each engine's first finished packing.
Table numberCheckTable(const Engines& engines) {
  Table table{
      {"check", {"engine", Kind::engines}, {"found", Kind::number}, {"expected", Kind::number}},
      {}};
  for (const EngineRuns& engine : engines)
    for (const CheckRow& check : engine.finished.front()->checks)
      if (check.value.size() == 1)
        table.rows.push_back({{{check.label, {check.note.value_or("")}},
                               engine.name,
                               readable(at(check.value, 0), at(check.standardError, 0)),
                               readable(at(check.reference, 0), check.referenceError)}});
  std::ranges::stable_sort(table.rows, {},
                           [](const TableRow& row) { return row.cells.front().text; });
  return table;
}

std::string instantOf(const CompareResults& results, const Engines& engines) {
  for (const EngineRuns& engine : engines)
    for (const FlowRun* run : engine.runs)
      if (run->picture && results.region)
        return fmt::format("after {:.3g} s", run->picture->time);
      else if (run->picture && std::isfinite(run->picture->rotation))
        return fmt::format("after {:.3g} rotations of the wheel", run->picture->rotation);
  return "at one instant";
}

void addPictures(Report& report, const CompareResults& results, const Engines& engines) {
  Drawings origins = drawingsOf(report.pictures, Picture::Shows::origins);
  Drawings forces = drawingsOf(report.pictures, Picture::Shows::forces);
  if (origins.names.empty()) return;
  Blocks& blocks = report.section("pictures", "Pictures").blocks;
  blocks = {Heading{"Where disks came from"},
            Paragraph{fmt::format(
                "Positions of the disks of the same packing {}, coloured by where they started: "
                "twelve sectors of angle{}, paler in every other band of two diameters.{}",
                instantOf(results, engines), results.region ? " about the origin" : "",
                results.region ? "" : " A straight sector bends where the cell shears.")},
            std::move(origins)};
  if (forces.names.empty()) return;
  const auto first = std::ranges::find(report.pictures, Picture::Shows::forces, &Picture::shows);
  blocks.push_back(Heading{"Force chains"});
  blocks.push_back(Paragraph{fmt::format(
      "The contact forces at the same instant: lines between the centres, width and darkness "
      "proportional to the normal force, all pictures on one scale: the widest line is the force "
      "that 99 % of {}'s contacts lie below.",
      first->engine)});
  blocks.push_back(std::move(forces));
}

std::string basisInWords(const CompareResults& results, const std::string& reference) {
  const std::string when = averagedRotations(results.averaging);
  const bool runs = !results.packings.empty();
  return fmt::format("Reference: {}. {}{}.", reference,
                     runs ? counted(results.packings.size(), "packing") : "Nothing was run",
                     when.empty() || !runs ? std::string() : "; averaged: " + when);
}

/// The error rates, and over how many pairs of engines that the user named.
std::string ratesInWords(const CompareResults& results) {
  std::set<std::pair<std::string, std::string>> pairs;
  for (const EndpointRow& row : results.endpoints.rows)
    if (row.kind == PairKind::peer) pairs.emplace(row.a, row.b);
  if (pairs.empty()) return {};
  return fmt::format(
      "{}; agree is tested endpoint by endpoint, disagree over the endpoints of each pair, at "
      "{:.3g} "
      "% each.",
      counted(pairs.size(), "pair"), 100.0 * (1.0 - results.averaging.confidence));
}

std::string troubleInWords(const EngineRuns& engine) {
  if (engine.status != Status::finished)
    return fmt::format("{} {}{}", engine.name,
                       engine.status == Status::refused ? "refused the scene" : "failed",
                       engine.reason.empty() ? "." : ": " + engine.reason);
  const std::size_t failed = engine.runs.size() - engine.finished.size();
  return failed == 0 ? std::string()
                     : fmt::format("{}: {} of {} did not finish.", engine.name, failed,
                                   counted(engine.runs.size(), "run"));
}

/// On what the verdicts rest, in which state the runs were, and what did not run.
std::vector<std::string> compareNotes(const CompareResults& results, const Engines& engines) {
  std::vector<std::string> notes;
  for (const AlarmRow& alarm : results.endpoints.alarms)
    notes.push_back("Alarm. " + describe(alarm));
  if (!engines.empty()) notes.push_back(basisInWords(results, referenceWords(results)));
  if (results.endpoints.looks.taken > 0) notes.push_back(describe(results.endpoints.looks));
  notes.push_back(ratesInWords(results));
  if (results.lockstep) notes.push_back("Lockstep: " + leadOf(*results.lockstep));
  std::ranges::move(stateSentences(results, engines), std::back_inserter(notes));
  for (const EngineRuns& engine : engines) notes.push_back(troubleInWords(engine));
  const auto isPaired = [](const EndpointRow& row) { return !row.unpaired; };
  if (results.packings.size() < 4 && std::ranges::all_of(results.endpoints.rows, isPaired) &&
      !peersOf(results, engines).empty())
    notes.emplace_back(
        "Fewer than 4 packings: differences between engines cannot be distinguished from those "
        "between packings, so no general verdict is given.");
  std::ranges::copy(results.notes, std::back_inserter(notes));
  return nonEmpty(std::move(notes));
}

}  // namespace

void addProfiles(Report& report, const CompareResults& results, const Engines& engines) {
  Engines withData;
  for (const EngineRuns& engine : engines)
    if (!engine.finished.empty()) withData.push_back(engine);
  const std::string bars = describeBars(engines);
  const auto drawings = [&](const char* prefix) { return drawingsOf(report.figures, prefix); };
  Blocks& profiles = report.section("profiles", "Profiles").blocks;
  profiles = {Paragraph{describeAverages(results, engines) + " " + bars}, drawings("profile_")};
  if (Drawings differences = drawings("difference_"); !differences.names.empty()) {
    profiles.push_back(
        Heading{"Differences from " + referenceWords(results) + ", in margins", "differences"});
    profiles.push_back(std::move(differences));
  }
  Table fits = fitTable(withData);
  Blocks& ofFits = report.section("fits", "Fits").blocks;
  ofFits.push_back(fits.rows.empty() ? Block(Paragraph{"None."}) : Block(std::move(fits)));
  Table numbers = numberCheckTable(withData);
  if (Drawings checks = drawings("check_"); !checks.names.empty() || !numbers.rows.empty())
    report.section("balance-checks", "Balance checks").blocks = {
        Paragraph{"Two routes to the same number inside one run, each engine's first finished "
                  "packing: found over expected is 1 in balance. They test the averaging and the "
                  "engine's contact forces, not agreement."},
        std::move(checks), std::move(numbers)};
  if (Drawings distributions = drawings("distribution_"); !distributions.names.empty())
    report.section("distributions", "Distributions").blocks = {
        Paragraph{"Of single disks and contacts over all snapshots, a mean over packings where "
                  "there are several. " +
                  bars},
        std::move(distributions)};
}

void addSeries(Report& report, const CompareResults& results, const Engines& engines) {
  Blocks& blocks = report.section("series", "Series").blocks;
  addStates(blocks, results, engines);
  Drawings series = drawingsOf(report.figures, "series_");
  if (series.names.empty()) {
    blocks.push_back(Paragraph{"None."});
    return;
  }
  const bool settling = std::ranges::any_of(report.figures, [](const Figure& figure) {
    return figure.name.starts_with("series_") && figure.panels.front().shaded;
  });
  blocks.push_back(Paragraph{std::string("Block means of every packing, one line each.") +
                             (settling ? " Shaded: settling after hand-over, not averaged." : "")});
  blocks.push_back(std::move(series));
}

Report compareReport(const CompareResults& results) {
  const Engines engines = engineRuns(results);
  Report report{{results.head, results.engines, compareOverview(results)}};
  report.elapsed = results.elapsed;
  report.notes = compareNotes(results, engines);
  report.figures = compareFigures(results);
  report.pictures = comparePictures(results);
  if (results.lockstep) {
    Blocks& blocks =
        report
            .section("lockstep", "Lockstep: whether engines have the laws that they declare",
                     "Lockstep")
            .blocks;
    blocks = lockstepTables(*results.lockstep);
    blocks.push_back(Details{"How to read it", {lockstepReading(*results.lockstep)}});
  }
  addEngineTable(report.section("engines", "Engines and their cost", "Engines and cost").blocks,
                 engines);
  addAgreement(report, results, engines);
  addProfiles(report, results, engines);
  addSeries(report, results, engines);
  addPictures(report, results, engines);
  addDetails(report, effectiveOf(results, engines));
  if (!results.packings.empty()) addPackings(report, results.packings);
  report.tables = averageTables(results);
  report.tables.emplace_back("endpoints.csv", endpointsCsv(results));
  report.tables.emplace_back("agreement.csv", agreementCsv(results));
  report.checks = matrixChecks(report);
  return report;
}

}  // namespace crossgrain::reports
