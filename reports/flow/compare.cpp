#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "reports/flow/endpoint_text.hpp"
#include "reports/flow/report.hpp"
#include "reports/lockstep/report.hpp"

namespace crossgrain::reports {

namespace {

const FitRow* fitOf(const EngineRuns& engine, const std::string& name) {
  return findBy(engine.fits(), name, &FitRow::name);
}

Cell fitCell(const FitRow* fit) {
  if (!fit) return absentText;
  const auto value = finite(fit->value), chi2 = finite(fit->chi2PerDof);
  Names notes;
  if (value && chi2) notes.push_back("χ²/dof " + readable(chi2));
  if (fit->packings && fit->ofPackings && *fit->packings < *fit->ofPackings)
    notes.push_back(
        fmt::format("{} of {} packings can be fitted", *fit->packings, *fit->ofPackings));
  if (!value) notes.push_back(fit->reason);
  return {readable(value, fit->standardError), std::move(notes)};
}

Table fitTable(const Engines& engines) {
  Table table{engineColumns({"quantity", numbers("expected")}, engines)};
  table.columns.emplace_back("unit");
  Names names;
  for (const EngineRuns& engine : engines)
    for (const FitRow& fit : engine.fits()) addOnce(names, fit.name);
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
      "rings, an amplitude far beyond the data or a curve that misses the points is not a result.";
  return table;
}

/// Checks of a single number: found, and expected, of each engine's first finished packing.
Table numberCheckTable(const Engines& engines) {
  Table table{{"check", engineNames("engine"), numbers("found"), numbers("expected")}};
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

/// How pictures of scenes are to be read.
std::string sceneWords(const CompareResults& results, const ScenePicture& picture, double fastest,
                       const std::string& instant) {
  const std::string speed = readable(fastest) + " m/s";
  std::string text = fmt::format(
      "The first packing {}, coloured by {}.", instant,
      fastest == 0.0 ? "size"
      : fastest > restingSpeed(picture)
          ? fmt::format("speed, from 0 (dark) to {} and more (yellow)", speed)
          : fmt::format("speed: all are at rest (dark), below {}, which takes the smallest a "
                        "hundredth of its diameter in the time since the start",
                        speed));
  const double cut = picture.cut.value_or(0.0);
  // A place that is less than a hundredth of a body from 0 is 0.
  const std::string place =
      readable(std::abs(cut) < 0.01 * at(picture.radius, 0).value_or(0.0) ? 0.0 : cut);
  if (picture.depth)
    text += fmt::format(
        " Seen along y, x to the right and z upward: particles in front of the plane y = {} m are "
        "left out.",
        place);
  else if (picture.cut || (results.region && !results.region->z.empty()))
    text += fmt::format(" A section along x and z{}.",
                        picture.cut ? fmt::format(", at y = {} m", place) : "");
  return text;
}

/// The scene of a few engines; folded: all others, where disks came from, and forces.
void addPictures(Report& report, const CompareResults& results, const Engines& engines) {
  constexpr std::size_t inSight = 4;
  Drawings scenes, others;
  const ScenePicture* first = nullptr;
  for (const Picture& picture : report.pictures) {
    if (picture.shows != Picture::Shows::scene) continue;
    const EngineRuns& engine = *findBy(engines, picture.engine, &EngineRuns::name);
    if (!first) first = firstPicture(engine);
    const bool seen = engine.mirrors.empty() && scenes.names.size() < inSight;
    (seen ? scenes : others).names.push_back(picture.name);
  }
  if (!first) return;
  const std::string instant = instantOf(results, engines);
  Blocks& blocks = report.section("pictures", "The scene", "Scene").blocks;
  blocks = {Paragraph{sceneWords(results, *first, fastestOf(engines), instant)}, std::move(scenes)};
  if (Drawings strip = drawingsOf(report.pictures, Picture::Shows::strip); !strip.names.empty()) {
    strip.side = false;
    blocks.push_back(std::move(strip));
  }
  if (!others.names.empty()) blocks.push_back(Details{"Other engines", {std::move(others)}});
  if (Drawings origins = drawingsOf(report.pictures, Picture::Shows::origins);
      !origins.names.empty())
    blocks.push_back(Details{
        "Where disks came from",
        {Paragraph{fmt::format("The same disks {}, coloured by where they started: twelve sectors "
                               "of angle, paler in every other band of two diameters. A straight "
                               "sector bends where the cell shears.",
                               instant)},
         std::move(origins)}});
  Drawings forces = drawingsOf(report.pictures, Picture::Shows::forces);
  if (forces.names.empty()) return;
  const auto of = std::ranges::find(report.pictures, Picture::Shows::forces, &Picture::shows);
  blocks.push_back(Details{
      "Force chains",
      {Paragraph{fmt::format(
           "Contact forces at the same instant: lines between the centres, width and darkness "
           "proportional to the normal force, all pictures on one scale: the widest line is the "
           "force that 99 % of {}'s contacts lie below.",
           of->engine)},
       std::move(forces)}});
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
      "{:.3g} % each.",
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
Names compareNotes(const CompareResults& results, const Engines& engines) {
  Names notes;
  for (const AlarmRow& alarm : results.endpoints.alarms)
    notes.push_back("Alarm. " + describe(alarm));
  if (!engines.empty()) notes.push_back(basisInWords(results, referenceWords(results)));
  if (results.endpoints.looks.taken > 0) notes.push_back(describe(results.endpoints.looks));
  notes.push_back(ratesInWords(results));
  if (results.lockstep) notes.push_back("Lockstep: " + leadOf(*results.lockstep));
  // Drifts stand beside the verdicts, where there are any.
  const std::string shown =
      results.endpoints.rows.empty() ? std::string() : driftSentence(results, engines);
  for (std::string& state : stateSentences(results, engines))
    if (state != shown) notes.push_back(std::move(state));
  for (const EngineRuns& engine : engines) notes.push_back(troubleInWords(engine));
  const auto isPaired = [](const EndpointRow& row) { return !row.unpaired; };
  if (results.packings.size() < 4 && std::ranges::all_of(results.endpoints.rows, isPaired) &&
      closedFormEngines(results.endpoints.rows).empty() && !peersOf(results, engines).empty())
    notes.emplace_back(
        "Fewer than 4 packings: differences between engines cannot be distinguished from those "
        "between packings, so no general verdict is given.");
  std::ranges::copy(results.notes, std::back_inserter(notes));
  return nonEmpty(std::move(notes));
}

}  // namespace

void addProfiles(Report& report, const CompareResults& results, const Engines& engines) {
  const Engines withData = only(engines, [](const EngineRuns& engine) {
    return !engine.finished.empty() && !engine.isSingle;
  });
  const std::string bars = describeBars(engines);
  const auto drawings = [&](const char* prefix) { return drawingsOf(report.figures, prefix); };
  Blocks& profiles = report.section("profiles", "Profiles").blocks;
  Drawings all = drawings("profile_");
  profiles = {Paragraph{describeAverages(results, engines) + (all.names.empty() ? "" : " " + bars)},
              drawings("overview")};
  if (!all.names.empty()) profiles.push_back(Details{"All profiles", {std::move(all)}});
  if (Drawings differences = drawings("difference_"); !differences.names.empty())
    profiles.push_back(Details{"Differences from " + referenceWords(results) + ", in margins",
                               {std::move(differences)}});
  if (Drawings single = drawings("single_runs"); !single.names.empty())
    report.section("single-runs", "Single runs").blocks = {std::move(single)};
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
        Paragraph{
            fmt::format("Of single particles and contacts over all snapshots, a mean over packings "
                        "where there are several. {}",
                        bars)},
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
  Report report{{results.head, results.engines, compareOverview(results)}, results.elapsed};
  report.notes = compareNotes(results, engines);
  report.figures = compareFigures(results);
  report.pictures = comparePictures(results);
  addAgreement(report, results, engines);
  addPictures(report, results, engines);
  addProfiles(report, results, engines);
  addCauses(report, results);
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
  addSeries(report, results, engines);
  addDetails(report, effectiveOf(results, engines));
  if (!results.packings.empty()) addPackings(report, results.packings);
  const bool drawn = findBy(report.figures, "overview", &Figure::name) != nullptr;
  report.foldAllBut({"agreement", "pictures", drawn ? "profiles" : ""});
  report.tables = averageTables(results);
  report.tables.emplace_back("endpoints.csv", endpointsCsv(results));
  report.tables.emplace_back("agreement.csv", agreementCsv(results));
  if (!results.causes.empty()) report.tables.emplace_back("causes.csv", causesCsv(results));
  report.checks = matrixChecks(report);
  return report;
}

}  // namespace crossgrain::reports
