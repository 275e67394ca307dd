#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "reports/flow/endpoint_text.hpp"
#include "reports/flow/report.hpp"
#include "reports/lockstep/report.hpp"

namespace crossgrain::reports {

namespace {

/// The matrix' mark and colour of the same answer. @param brief  the distance alone
Cell answerCell(const CompareResults& results, const EndpointRow* row, bool brief = false) {
  if (!row) return absentText;
  const std::optional<Verdict> verdict = endpointCell(results, *row).verdict;
  std::string word = wordOf(*row);
  if (verdict == Verdict::modelDifference) word += " by the declared law";
  if (verdict == Verdict::notMeasured && row->verdict != verdict) word = "not judged";
  const std::string distance = describeDistance(*row);
  if (brief)
    return {row->verdict == Verdict::notMeasured ? absentText : distance, {}, verdict, true};
  Names more = {describeSurrogate(*row), describeNeeds(*row)};
  if (row->lost > 0)
    more.push_back(counted(static_cast<std::size_t>(row->lost), "packing") + " failed");
  more.push_back(row->reason);
  std::string detail =
      row->kind == PairKind::closedForm ? describeValue(*row) + ", " + distance : distance;
  return {std::move(word),
          {std::move(detail), fmt::format("{}", fmt::join(nonEmpty(std::move(more)), "; "))},
          verdict,
          true};
}

std::string endpointLabel(const std::string& name, bool ofCell) {
  const std::string symbol = endpointSymbol(name, ofCell);
  return symbol == spaced(name) ? symbol : endpointWords(name) + " " + symbol;
}

std::string marginInWords(const Endpoints& endpoints, const std::string& name) {
  const auto row = std::ranges::find(endpoints, name, &EndpointRow::endpoint);
  const std::string unit = row->unit == "-" ? "" : " " + row->unit;
  const std::string size = row->marginRelative
                               ? fmt::format("± {:.3g} % of the reference", row->margin * 100.0)
                               : "± " + readableSetting(row->margin) + unit;
  return row->marginWhy.empty() ? size : size + ": " + row->marginWhy;
}

/// Every endpoint with its margin; an engine per column, against a.
Table endpointVerdicts(const CompareResults& results, const std::string& a, const Names& engines) {
  const Endpoints& endpoints = results.endpoints.rows;
  Table table{{"endpoint and margin"}};
  for (const std::string& engine : engines)
    table.columns.emplace_back(engine, Column::Kind::engine);
  for (const std::string& name : endpointsOf(endpoints)) {
    TableRow row{{{endpointLabel(name, !results.region), {marginInWords(endpoints, name)}}}};
    for (const std::string& engine : engines)
      row.cells.push_back(answerCell(results, rowOf(endpoints, a, engine, name)));
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// Pairs of peers, or of mirrors, in the order of the results; an endpoint per column.
Table endpointPairTable(const CompareResults& results, bool peers) {
  Table table{{"pair"}};
  if (!peers) table.columns.emplace_back("difference of");
  const Names endpoints = endpointsOf(results.endpoints.rows);
  for (const std::string& name : endpoints)
    table.columns.emplace_back(endpointSymbol(name, !results.region));
  std::vector<std::pair<std::string, std::string>> seen;
  for (const EndpointRow& row : results.endpoints.rows) {
    if ((row.kind == PairKind::peer) != peers || row.kind == PairKind::closedForm ||
        row.a == medianName)
      continue;
    const std::pair pair(row.a, row.b);
    if (std::ranges::find(seen, pair) != seen.end()) continue;
    seen.push_back(pair);
    TableRow line{{row.a + " – " + row.b}};
    if (!peers)
      line.cells.emplace_back(row.kind == PairKind::mirrorModel ? "model" : "implementation");
    for (const std::string& name : endpoints)
      line.cells.push_back(
          answerCell(results, rowOf(results.endpoints.rows, row.a, row.b, name), true));
    table.rows.push_back(std::move(line));
  }
  return table;
}

std::string ringInWords(const AgreementRing& ring, const char* bin) {
  const std::string name = fmt::format("{} {}", bin, ring.ring + 1);
  if (!finite(ring.difference)) return name + ": nothing to compare";
  return fmt::format("{}: {}, margin {}", name,
                     readableDifference(ring.difference, ring.standardError),
                     readable(ring.margin));
}

/// Each field ring by ring, an engine per column.
Table ringTable(const CompareResults& results, const std::string& reference, const Names& peers) {
  const char* const bin = binWord(results);
  Table table{{"field"}};
  for (const std::string& peer : peers) table.columns.emplace_back(peer, Column::Kind::engine);
  for (const std::string& field : fieldsOf(results.agreement)) {
    TableRow row{{fieldLabel(field)}};
    for (const std::string& peer : peers) {
      Cell cell;
      if (const AgreementRow* pair = rowOf(results.agreement, reference, peer, field))
        for (const AgreementRing& ring : pair->rings)
          cell.strip.push_back({ring.verdict, ringInWords(ring, bin)});
      row.cells.push_back(std::move(cell));
    }
    table.rows.push_back(std::move(row));
  }
  table.note = fmt::format(
      "Each square is a {0}, {1}: ✓ within the {0}'s margin, ✗ beyond it, ? undecided. {0}s show "
      "where a difference is; they have no verdict of their own.",
      bin, results.region ? "in the order of their numbers" : "from the wheel outwards");
  return table;
}

List verdictReading(const CompareResults& results) {
  const bool paired = std::ranges::none_of(
      results.endpoints.rows, [](const EndpointRow& row) { return row.unpaired.has_value(); });
  return {
      {{"✓ agree",
        fmt::format("the difference{} lies within the margin (two one-sided t tests, {:.3g} % "
                    "confidence over all interim analyses together). No difference seen: its "
                    "interval contains 0. Small difference: it does not.",
                    paired ? ", paired over the same packings," : "",
                    100.0 * results.averaging.confidence)},
       {"✗ disagree", "it exceeds the margin (Holm's procedure over the endpoints of the pair)."},
       {"≈ borderline",
        "a difference is shown, and that it is below twice the margin; the margin lies in between. "
        "More packings will hardly change that."},
       {"? undecided",
        "none of these is shown. The number of packings is what decides with 90 % chance, for the "
        "ends of an 80 % interval of the scatter of all pairs."},
       {"Interim analyses",
        "packings are added until all is decided. A further analysis is no new chance of error: "
        "agree is tested at one level in every analysis, so much lower that all together have the "
        "chance that the confidence leaves (Pocock); disagree in each at its part of that chance, "
        "and the parts add up to it. What was decided stays."}}};
}

void addClosedForms(Blocks& blocks, const CompareResults& results) {
  const Names judged = closedFormEngines(results.endpoints.rows);
  if (judged.empty()) return;
  Table table = endpointVerdicts(results, closedFormName, judged);
  table.note =
      "The case gives the right value by a closed form. One start is run twice by every engine; a "
      "value that comes back the same has no scatter: within the margin it agrees, else it "
      "disagrees.";
  blocks.push_back(Heading{"Closed forms"});
  blocks.push_back(std::move(table));
  blocks.push_back(Heading{"Between engines"});
}

void addSurrogates(Blocks& blocks, const CompareResults& results) {
  if (results.endpoints.surrogates.empty()) return;
  List engines;
  for (const SurrogateEngine& own : results.endpoints.surrogates)
    engines.items.push_back({"", describe(own)});
  blocks.push_back(Heading{"Evaluated through mirrors"});
  blocks.push_back(std::move(engines));
  blocks.push_back(
      Paragraph{"An engine that the lockstep comparison finds equivalent to its mirror needs no "
                "packings of its own: the mirror runs them, and the engine one of them, compared "
                "with the mirror's for faults that begin late. If averages respond to so small a "
                "change in proportion, the engine's lie within B of the mirror's: ε_eq times what "
                "10 % of the law's constants do to them. B is subtracted from the margin.",
                Paragraph::Style::small});
}

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

void addPictures(Report& report, const CompareResults& results, const Engines& engines) {
  Drawings origins = drawingsOf(report.pictures, Picture::Shows::origins);
  Drawings forces = drawingsOf(report.pictures, Picture::Shows::forces);
  if (origins.names.empty()) return;
  Blocks& blocks = report.section("pictures", "Pictures").blocks;
  const bool convex = anyConvex(engines);
  blocks = {Heading{convex ? "Where bodies came from" : "Where disks came from"},
            Paragraph{fmt::format(
                "Positions of the {} of the same packing {}, coloured by where they started: "
                "twelve sectors of angle{}, paler in every other band of two diameters.{}",
                convex ? "bodies" : "disks", instantOf(results, engines),
                results.region ? " about the origin" : "",
                results.region ? "" : " A straight sector bends where the cell shears.")},
            std::move(origins)};
  if (forces.names.empty()) return;
  const auto first = std::ranges::find(report.pictures, Picture::Shows::forces, &Picture::shows);
  blocks.push_back(Heading{"Force chains"});
  blocks.push_back(Paragraph{
      fmt::format("The contact forces at the same instant: lines between the centres, width and "
                  "darkness proportional to the normal force, all pictures on one scale: the "
                  "widest line is the force that 99 % of {}'s contacts lie below.",
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
  std::ranges::move(stateSentences(results, engines), std::back_inserter(notes));
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

/// Verdicts against the reference, of all pairs, and model against implementation.
void addAgreement(Report& report, const CompareResults& results, const Engines& engines) {
  const Endpoints& endpoints = results.endpoints.rows;
  if (engines.empty()) return;
  const std::string& reference = referenceOf(results);
  const std::string called = referenceWords(results);
  const Names peers = peersOf(results, engines);
  const double falseAlarm = 100.0 * (1.0 - results.averaging.confidence);
  Blocks& blocks = report.section("agreement", "Agreement with " + called, "Agreement").blocks;
  if (!endpoints.empty()) {
    addClosedForms(blocks, results);
    if (results.endpoints.looks.taken > 0)
      blocks.push_back(Paragraph{describe(results.endpoints.looks)});
    Table table = endpointVerdicts(results, reference, peers);
    table.note = fmt::format(
        "A distance is the engine's value minus that of {}, in margins, with the interval that the "
        "verdict rests on. Agree is tested endpoint by endpoint, disagree over all endpoints of a "
        "pair: the chance of any false one is at most {:.3g} % for each pair.",
        called, falseAlarm);
    blocks.push_back(std::move(table));
    addSurrogates(blocks, results);
    blocks.push_back(Details{"How to read a verdict", {verdictReading(results)}});
  }
  if (Table pairs = endpointPairTable(results, true);
      pairs.rows.size() > peers.size() || reference == medianName)
    blocks.push_back(Details{"All pairs", {std::move(pairs)}});
  if (Table mirrors = endpointPairTable(results, false); !mirrors.rows.empty()) {
    blocks.push_back(Heading{"Model difference or implementation error?"});
    blocks.push_back(
        Paragraph{"A mirror is the in-house engine set to a peer's documented conventions. Against "
                  "the reference it shows the difference of models; against its peer that of the "
                  "implementation."});
    blocks.push_back(std::move(mirrors));
  }
  if (Table rings = ringTable(results, reference, peers); !rings.rows.empty()) {
    blocks.push_back(Heading{fmt::format("Where: {0} by {0}", binWord(results))});
    blocks.push_back(std::move(rings));
  }
  if (blocks.empty()) report.sections.pop_back();
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
        Paragraph{fmt::format("Of single {} and contacts over all snapshots, a mean over packings "
                              "where there are several. {}",
                              anyConvex(engines) ? "bodies" : "disks", bars)},
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
  addCauses(report, results);
  addProfiles(report, results, engines);
  addSeries(report, results, engines);
  addPictures(report, results, engines);
  addDetails(report, effectiveOf(results, engines));
  if (!results.packings.empty()) addPackings(report, results.packings);
  report.tables = averageTables(results);
  report.tables.emplace_back("endpoints.csv", endpointsCsv(results));
  report.tables.emplace_back("agreement.csv", agreementCsv(results));
  if (!results.causes.empty()) report.tables.emplace_back("causes.csv", causesCsv(results));
  report.checks = matrixChecks(report);
  return report;
}

}  // namespace crossgrain::reports
