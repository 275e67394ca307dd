// The report of a campaign: its matrix, its sections, its claims as CSV and for a terminal.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "reports/common/csv_row.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/overview.hpp"
#include "reports/common/sentences.hpp"
#include "reports/thesis/report.hpp"

namespace crossgrain::reports {
namespace {

using Names = std::vector<std::string>;
using Claims = std::vector<const ClaimRow*>;

constexpr const char* noEngine = "-";  ///< a claim's engine where none takes part

std::string wordOf(Verdict verdict) {
  return spaced(nameOf(verdict, claimVerdictNames));
}

/// What a rule asks of a figure: "0.791 … 0.796", "≥ 0.5"; empty: nothing.
std::string boundsText(const ClaimFigure& figure) {
  if (figure.low && figure.high)
    return fmt::format("{} … {}", readableSetting(figure.low), readableSetting(figure.high));
  if (figure.low) return "≥ " + readableSetting(figure.low);
  if (figure.high) return "≤ " + readableSetting(figure.high);
  return "";
}

std::string withBounds(std::string text, const ClaimFigure& figure) {
  const std::string bounds = boundsText(figure);
  return bounds.empty() ? text : text + " [" + bounds + "]";
}

// ---- The matrix: each claim under its first interpretation.

/// A claim on an engine under all interpretations, the first first.
Claims interpretationsOf(const ThesisResults& results, const std::string& engine,
                         const std::string& id) {
  Claims all;
  for (const ClaimRow& claim : results.claims)
    if (claim.engine == engine && claim.id == id) all.push_back(&claim);
  return all;
}

/// An engine's claims under their first interpretation.
Claims firstClaims(const ThesisResults& results, const std::string& engine) {
  Claims claims;
  for (const ClaimRow& claim : results.claims)
    if (claim.engine == engine && std::ranges::find(claims, claim.id, [](const auto* each) {
                                    return each->id;
                                  }) == claims.end())
      claims.push_back(&claim);
  return claims;
}

/// Engines that claims are about, as the results have them; then what needs none.
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

OverviewCell cellOf(const Claims& claims) {
  OverviewCell cell{Verdict::notApplicable, {}, {}, {}, {}, {}};
  if (claims.empty()) return cell;
  const ClaimRow& claim = *claims.front();
  cell.verdict = claim.verdict;
  cell.anchor = claim.id;
  // The figure that refutes a claim, leaves it undecided or cannot be tested; else the one that
  // stands for it.
  auto figure = std::ranges::find(claim.figures, claim.verdict, &ClaimFigure::verdict);
  if (figure == claim.figures.end()) figure = claim.figures.begin();
  if (figure != claim.figures.end()) cell.words = withBounds(figure->name, *figure);
  for (const ClaimRow* other : claims)
    if (other->verdict != claim.verdict && other->verdict != Verdict::undecided) {
      cell.words += fmt::format("{}{} under {}", cell.words.empty() ? "" : "; ",
                                lookOf(other->verdict).mark, other->interpretation);
      break;  // the table has the others
    }
  if (figure == claim.figures.end() || !finite(figure->value)) return cell;
  cell.value = figure->value;
  cell.unit = figure->unit;
  cell.shown = readable(cell.value) + (cell.unit.empty() ? "" : "\u00a0" + cell.unit);
  return cell;
}

std::string onEngine(const std::string& engine) {
  return engine == noEngine ? "without any engine" : "on " + engine;
}

std::size_t countOf(const Claims& claims, Verdict verdict) {
  return static_cast<std::size_t>(
      std::ranges::count(claims, verdict, [](const ClaimRow* claim) { return claim->verdict; }));
}

/// "18 reproduced, 5 refuted, 4 undecided"
std::string countsText(const Claims& claims) {
  const std::size_t untestable = countOf(claims, Verdict::notApplicable);
  return fmt::format("{} reproduced, {} refuted, {} undecided{}", countOf(claims, Verdict::pass),
                     countOf(claims, Verdict::fail), countOf(claims, Verdict::undecided),
                     untestable == 0 ? "" : fmt::format(", {} cannot be tested", untestable));
}

/// Which are refuted, and whether a reason is known.
std::string refutedText(const ThesisResults& results) {
  constexpr std::size_t mostIds = 6;
  Names parts;
  std::size_t all = 0, unexplained = 0;
  for (const std::string& engine : rowsOf(results)) {
    Names ids;
    for (const ClaimRow* claim : firstClaims(results, engine)) {
      if (claim->verdict != Verdict::fail) continue;
      ids.push_back(claim->id);
      unexplained += claim->reasons.empty();
    }
    all += ids.size();
    if (!ids.empty())
      parts.push_back(fmt::format("{} {}", listedShortly(ids, mostIds), onEngine(engine)));
  }
  if (parts.empty()) return {};
  return fmt::format("Refuted: {}; the table of claims has what was found of {}.",
                     fmt::join(parts, "; "),
                     unexplained == 0 ? all == 1 ? std::string("the reason") : "their reasons"
                                      : fmt::format("why, of {} nothing", unexplained));
}

std::string nextStep(const ThesisResults& results) {
  const auto left = std::ranges::count_if(results.cases, [&](const ThesisCase& setup) {
    return std::ranges::none_of(results.runs, [&](const ThesisRun& run) {
      return run.setup == setup.name && run.run.finished();
    });
  });
  std::size_t undecided = 0;
  for (const std::string& engine : rowsOf(results))
    undecided += countOf(firstClaims(results, engine), Verdict::undecided);
  if (undecided == 0) return "Nothing is left to decide by these rules.";
  if (left > 0)
    return fmt::format(
        "Next: the same command with a larger --budget runs the {} of {} cases that nobody has "
        "run; what is undecided may rest on them.",
        left, results.cases.size());
  return "Next: see what each undecided claim lacks, in the table of claims.";
}

// ---- Sections.

/// "C⁻¹ = 9.00 ± 0.50 d [4 … 7]"
std::string figureText(const ClaimFigure& figure) {
  return withBounds(
      fmt::format("{} = {}{}{}", figure.name, readable(figure.value, figure.standardError),
                  figure.unit.empty() ? "" : " ", figure.unit),
      figure);
}

Table claimTable(const ThesisResults& results) {
  Table table{{"claim",
               {"engine", Column::Kind::engines},
               "verdict",
               {"figures, and where they should lie", Column::Kind::remark},
               {"why, and under which interpretation", Column::Kind::remark}},
              {}};
  std::string before;
  for (const ClaimRow& claim : results.claims) {
    const bool first = claim.id != before;
    before = claim.id;
    Names figures, remarks = {claim.interpretation};
    for (const ClaimFigure& figure : claim.figures) figures.push_back(figureText(figure));
    remarks.insert(remarks.end(), claim.reasons.begin(), claim.reasons.end());
    if (claim.verdict == Verdict::fail && claim.reasons.empty())
      remarks.emplace_back("No reason was found.");
    remarks.push_back(fmt::format("{}", fmt::join(claim.cases, ", ")));
    remarks.push_back(claim.plot);
    table.rows.push_back(
        {{first ? Cell(claim.id, {claim.claim}) : Cell(),
          Cell(claim.engine, {claim.mirror.empty() ? "" : "and runs of " + claim.mirror}),
          Cell(wordOf(claim.verdict), {}, claim.verdict, true), Cell("", std::move(figures)),
          Cell(claim.why, std::move(remarks))},
         "",
         first ? claim.id : ""});
  }
  return table;
}

/// A row for each engine of a case, the cases in groups.
Table caseTable(const ThesisResults& results) {
  using enum Column::Kind;
  Table table{{{"engine", engines},
               {"ν̄ of the table", number},
               {"ν̄ of the disks", number},
               "disks",
               {"Ω [/s]", number},
               {"wall spacing [mm]", number},
               "rotations averaged",
               {"packings", number},
               {"wall time a rotation", number},
               {"CPU time", number},
               "pressure on the ring, first → last rotation [N/m²]"},
              {}};
  for (const ThesisCase& setup : results.cases) {
    std::string group =
        fmt::format("{}: {} ({})", setup.name, setup.purpose, fmt::join(setup.families, ", "));
    const std::vector<Cell> ofCase = {
        fmt::format("{:.3f}", setup.label),
        fmt::format("{:.4f}", setup.cell.volumeFraction),
        fmt::format("{} + {}", setup.cell.small, setup.cell.large),
        readableSetting(setup.cell.omega),
        readableSetting(1e3 * setup.cell.wallSpacing),
        fmt::format("{} to {}", readableSetting(setup.settleRotations),
                    readableSetting(setup.endRotation()))};
    const auto add = [&](const std::string& engine, const std::vector<Cell>& rest) {
      TableRow& row = table.rows.emplace_back(TableRow{{engine}, std::exchange(group, {})});
      row.cells.insert(row.cells.end(), ofCase.begin(), ofCase.end());
      row.cells.insert(row.cells.end(), rest.begin(), rest.end());
    };
    for (const std::string& engine : enginesWithRuns(results)) {
      const std::vector<CaseRun> runs = finishedRuns(results, setup, engine);
      if (runs.empty()) continue;
      double wall = 0.0, cpu = 0.0;  // s
      for (const CaseRun& at : runs)
        if (const auto& stats = at.run->run.stats) {
          wall += stats->wallSeconds;
          cpu += stats->cpuSeconds;
        }
      const double rotations = static_cast<double>(runs.size()) * setup.endRotation();
      const auto& history = runs.front().run->history;
      add(engine, {fmt::to_string(runs.size()), readableDuration(wall / rotations),
                   readableDuration(cpu / rotations),
                   history.empty() ? absentText
                                   : fmt::format("{} → {}", readable(history.front().outerPressure),
                                                 readable(history.back().outerPressure))});
    }
    if (!group.empty()) add("not run", {});
  }
  table.note = "Pressures are of the first packing that there is.";
  return table;
}

Table interpretationTable(const ThesisResults& results) {
  using enum Column::Kind;
  Table table{{"interpretation", {"engine", engines}, "at ν̄", "rotations", {"pairs", number}}, {}};
  for (const ProfileNumber& each : profileNumbers)
    table.columns.emplace_back(
        *each.unit == '\0' ? each.label : fmt::format("{} [{}]", each.label, each.unit), number);
  for (const InterpretationRow& of : interpretationRows(results)) {
    Names labels;
    for (const double label : of.labels) labels.push_back(fmt::format("{:.3f}", label));
    TableRow& row = table.rows.emplace_back(
        TableRow{{of.label, of.engine, fmt::format("{}", fmt::join(labels, ", ")), of.rotations,
                  fmt::to_string(of.pairs)}});
    for (const InterpretationChange& change : of.changes)
      row.cells.emplace_back(
          readableDifference(change.change, change.error),
          Names{change.change ? "of " + readable(change.standard) : std::string()});
  }
  table.note =
      "Change from the default to the interpretation, with its standard error over pairs of runs: "
      "of the same ν̄, the same packing's index and the same rotations. Below it the default's own "
      "value. One pair has no error; a dash is where runs are missing. Bulk: 8 ≤ r̃ < 16. "
      "readings.csv has each ν̄ by itself.";
  return table;
}

List howToRead() {
  return {
      {{"✓ reproduced",
        "the figures lie, with their errors over packings, where the rule asks for them (in square "
        "brackets). ✗ refuted: they do not, and the reason says how. ? undecided: too few "
        "packings, "
        "or none of the runs that the rule is about. A refuted claim is a finding, no failure."},
       {"Below a refuted claim",
        "why, as far as it was found: in which state its runs were, and where else the same rule "
        "has "
        "its figures in their bands; verdicts do not change. A sentence that names its evidence "
        "was "
        "written by a person and is shown while its conditions on the figures hold."},
       {"Rules", "and tolerances were fixed before any run was seen; each has its reason."},
       {"Interpretations",
        "where the thesis contradicts itself a claim is judged under each interpretation that "
        "there "
        "are runs of."},
       {"States change",
        "for many rotations. Each figure is of the rotations that its cases name, counted since "
        "the "
        "ring had closed; history.csv has them all, regime_map.csv has which packings still carry "
        "then."}}};
}

/// "grain: a rotation of the wheel at 0.1 /s takes 75 s of wall time …"; empty without runs.
std::string speedOf(const ThesisResults& results, const std::string& engine) {
  constexpr double secondsPerDay = 86400.0, thesisRate = 0.1;
  std::vector<std::pair<double, double>> perRotation;  // wall, CPU, at the thesis' own rate
  for (const ThesisRun& run : results.runs) {
    const auto setup = std::ranges::find(results.cases, run.setup, &ThesisCase::name);
    if (setup == results.cases.end() || run.engine != engine || !run.run.finished()) continue;
    if (!run.run.stats || setup->cell.omega <= 0.0) continue;
    // Steps of a rotation go as 1/Ω.
    const double scale = setup->cell.omega / thesisRate / setup->endRotation();
    perRotation.emplace_back(run.run.stats->wallSeconds * scale, run.run.stats->cpuSeconds * scale);
  }
  if (perRotation.empty()) return "";
  std::ranges::sort(perRotation);
  const auto [wall, cpu] = perRotation[perRotation.size() / 2];
  return fmt::format(
      "{}: a rotation of the wheel at 0.1 /s takes {} of wall time and {} of CPU time (the median "
      "of {}); in 2003 it took 1 to 2 CPU days, {} to {} times as much.",
      engine, readableDuration(wall), readableDuration(cpu), counted(perRotation.size(), "run"),
      readable(secondsPerDay / cpu), readable(2.0 * secondsPerDay / cpu));
}

/// What engines took, who stands for whom, and what failed.
Names notesOf(const ThesisResults& results) {
  Names notes;
  for (const std::string& engine : rowsOf(results))
    notes.push_back(fmt::format("Claims {}: {}.",
                                engine == noEngine ? "that need no engine" : "on " + engine,
                                countsText(firstClaims(results, engine))));
  for (const EngineRow& engine : results.engines) notes.push_back(speedOf(results, engine.name));
  for (const ThesisSurrogate& each : results.surrogates)
    notes.push_back(fmt::format(
        "{} {} {}: {}", each.engine,
        each.accepted ? "is evaluated through its mirror" : "is not evaluated through its mirror",
        each.mirror, each.why));
  for (const ThesisRun& run : results.runs)
    if (run.run.status == Status::failed) notes.push_back("Failed: " + run.run.reason);
  notes.insert(notes.end(), results.notes.begin(), results.notes.end());
  return nonEmpty(std::move(notes));
}

}  // namespace

Overview thesisOverview(const ThesisResults& results) {
  Overview overview;
  overview.states = {{Verdict::pass, "reproduced"},
                     {Verdict::fail, "refuted"},
                     {Verdict::notApplicable, "cannot be tested, or no claim of it"}};
  for (const ClaimRow& claim : results.claims)
    if (std::ranges::find(overview.columns, claim.id, &OverviewColumn::name) ==
        overview.columns.end())
      overview.columns.push_back({claim.id, claim.claim, claim.id});
  Names counts;
  for (const std::string& engine : rowsOf(results)) {
    OverviewRow row{engine == noEngine ? "no engine" : engine, engine != noEngine, {}};
    for (const OverviewColumn& column : overview.columns)
      row.cells.push_back(cellOf(interpretationsOf(results, engine, column.name)));
    overview.rows.push_back(std::move(row));
    counts.push_back(onEngine(engine) + ": " + countsText(firstClaims(results, engine)));
  }
  if (overview.rows.empty()) return overview;
  overview.conclusion = {fmt::format("Claims {}.", fmt::join(counts, "; ")), refutedText(results),
                         nextStep(results)};
  std::erase(overview.conclusion, "");
  return overview;
}

Report reportOf(const ThesisResults& results) {
  Report report{{results.head, results.engines, thesisOverview(results)}};
  report.elapsed = results.elapsed;
  report.notes = notesOf(results);
  report.figures = thesisFigures(results);
  report.engineColours = false;  // of most plots colours are volume fractions
  report.caseHeading = "The parameter sweep";
  report.tables = {{"claims.csv", claimsCsv(results)},
                   {"history.csv", historyCsv(results)},
                   {"regime_map.csv", regimeMapCsv(results)},
                   {"readings.csv", interpretationsCsv(results)}};
  Blocks& claims = report.section("claims", "The thesis' claims", "Claims").blocks;
  if (results.claims.empty())
    claims = {Paragraph{"None was judged."}};
  else
    claims = {claimTable(results)};
  report.section("reading", "How to read it").blocks = {howToRead()};
  if (!report.figures.empty())
    report.section("figures", "The thesis' figures, redrawn", "Figures").blocks = {
        drawingsOf(report.figures, "figure_")};
  if (Table table = interpretationTable(results); !table.rows.empty())
    report.section("interpretations", "What each interpretation changes", "Interpretations")
        .blocks = {std::move(table)};
  report.section("cases", "Cases").blocks = {caseTable(results)};
  report.section("rules", "Rules").blocks = {
      Details{"By what the claims are judged", {Code{results.rules}}}};
  return report;
}

std::string claimsText(const ThesisResults& results) {
  std::string text;
  for (const ClaimRow& claim : results.claims) {
    std::string figure;
    if (!claim.figures.empty()) {
      const ClaimFigure& first = claim.figures.front();
      figure = withBounds(
          fmt::format("{}: {}{}{}", first.name, readable(first.value, first.standardError),
                      first.unit.empty() ? "" : " ", first.unit),
          first);
    }
    text += fmt::format("{:<4} {:<10} {:<16} {}; {}\n", claim.id, wordOf(claim.verdict),
                        claim.engine, figure, claim.interpretation);
  }
  for (const std::string& note : results.notes) text += note + "\n";
  return text;
}

std::string claimsCsv(const ThesisResults& results) {
  std::string table =
      "id,engine,carrier,reading,figure,value,stderr,low,high,unit,verdict,why,figure_verdict,"
      "reasons\n";
  for (const ClaimRow& claim : results.claims) {
    const auto line = [&](const ClaimFigure& figure) {
      table +=
          row(claim.id, claim.engine, claim.mirror, claim.interpretation, figure.name, figure.value,
              figure.standardError, figure.low, figure.high, figure.unit, wordOf(claim.verdict),
              claim.why, figure.verdict ? wordOf(*figure.verdict) : std::string(),
              fmt::format("{}", fmt::join(claim.reasons, " ")));
    };
    for (const ClaimFigure& figure : claim.figures) line(figure);
    if (claim.figures.empty()) line({});
  }
  return table;
}

std::string historyCsv(const ThesisResults& results) {
  std::string table = "leg,engine,packing,from_rotation,to_rotation";
  for (const SpanNumber& number : spanNumbers) table += fmt::format(",{}", number.name);
  table += "\n";
  for (const ThesisRun& run : results.runs)
    for (const ThesisSpan& span : run.history) {
      std::string line = row(run.setup, run.engine, static_cast<std::size_t>(run.packing),
                             finite(span.from), finite(span.to));
      line.pop_back();
      for (const SpanNumber& number : spanNumbers) line += "," + cell(span.*number.of);
      table += line + "\n";
    }
  return table;
}

}  // namespace crossgrain::reports
