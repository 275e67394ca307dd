// The page of a campaign, its matrix, its claims as CSV and for a terminal.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "reports/common/csv_row.hpp"
#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/overview.hpp"
#include "reports/common/overview_marks.hpp"
#include "reports/common/page.hpp"
#include "reports/common/sentences.hpp"
#include "reports/thesis/report.hpp"

namespace crossgrain::reports {
namespace {

using Names = std::vector<std::string>;
using Claims = std::vector<const ClaimRow*>;

constexpr const char* noEngine = "-";  ///< a claim's engine where none takes part

std::string wordOf(Verdict verdict) {
  return std::string(nameOf(verdict, claimVerdictNames));
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
  OverviewCell cell{CellState::notApplicable, {}, {}, {}, {}, {}};
  if (claims.empty()) return cell;
  const ClaimRow& claim = *claims.front();
  cell.state = stateOf(claim.verdict);
  cell.anchor = claim.id;
  // The figure that refutes a claim, or leaves it undecided; else the one that stands for it.
  auto figure = std::ranges::find(claim.figures, claim.verdict, &ClaimFigure::verdict);
  if (figure == claim.figures.end()) figure = claim.figures.begin();
  if (figure != claim.figures.end()) cell.words = withBounds(figure->name, *figure);
  for (const ClaimRow* other : claims)
    if (other->verdict != claim.verdict && other->verdict != Verdict::undecided) {
      cell.words += fmt::format("{}{} under {}", cell.words.empty() ? "" : "; ",
                                lookOf(stateOf(other->verdict)).mark, other->interpretation);
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
  return fmt::format("{} reproduced, {} refuted, {} undecided", countOf(claims, Verdict::pass),
                     countOf(claims, Verdict::fail), countOf(claims, Verdict::undecided));
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

// ---- The page.

/// "figure 7.14" is drawn as figure_7_14; empty: it is not drawn.
std::string drawnPlot(const std::string& plot, const Illustrations& shown) {
  std::string name = plot;
  std::ranges::replace_if(
      name, [](char c) { return c == ' ' || c == '.'; }, '_');
  const bool drawn = !shown.missing &&
                     std::ranges::find(shown.figures, name, &Figure::name) != shown.figures.end();
  return drawn ? name : "";
}

Json claimRows(const ThesisResults& results, const Illustrations& shown) {
  Json rows = Json::array();
  std::string before;
  for (const ClaimRow& claim : results.claims) {
    const bool first = claim.id != before;
    before = claim.id;
    Json figures = Json::array(), reasons = Json::array();
    for (const ClaimFigure& figure : claim.figures)
      figures.push_back({{"name", mathHtml(figure.name)},
                         {"value", readable(figure.value, figure.standardError)},
                         {"unit", figure.unit},
                         {"bounds", boundsText(figure)}});
    for (const std::string& reason : claim.reasons) reasons.push_back(mathHtml(reason));
    if (claim.verdict == Verdict::fail && reasons.empty())
      reasons.push_back("No reason was found.");
    const CellLook look = lookOf(stateOf(claim.verdict));
    rows.push_back({{"id", claim.id},
                    {"first", first},
                    {"claim", first ? mathHtml(claim.claim) : ""},
                    {"engine", claim.engine},
                    {"mirror", claim.mirror},
                    {"interpretation", claim.interpretation},
                    {"figures", figures},
                    {"verdict", fmt::format("{} {}", look.mark, wordOf(claim.verdict))},
                    {"class", std::string(look.cssClass)},
                    {"why", mathHtml(claim.why)},
                    {"reasons", reasons},
                    {"cases", fmt::format("{}", fmt::join(claim.cases, ", "))},
                    {"plot", claim.plot},
                    {"anchor", drawnPlot(claim.plot, shown)}});
  }
  return rows;
}

/// A row for each engine of a case, the case itself in the first.
Json caseRows(const ThesisResults& results) {
  Json rows = Json::array();
  for (const ThesisCase& setup : results.cases) {
    Json row = {{"first", true},
                {"name", setup.name},
                {"purpose", setup.purpose},
                {"families", fmt::format("{}", fmt::join(setup.families, ", "))},
                {"label", fmt::format("{:.3f}", setup.label)},
                {"nu", fmt::format("{:.4f}", setup.cell.volumeFraction)},
                {"counts", fmt::format("{} + {}", setup.cell.small, setup.cell.large)},
                {"omega", readableSetting(setup.cell.omega)},
                {"spacing", readableSetting(1e3 * setup.cell.wallSpacing)},
                {"rotations", fmt::format("{} to {}", readableSetting(setup.settleRotations),
                                          readableSetting(setup.endRotation()))},
                {"engine", "not run"},
                {"span", 1}};
    Names engines;
    for (const std::string& engine : enginesWithRuns(results))
      if (!finishedRuns(results, setup, engine).empty()) engines.push_back(engine);
    if (engines.empty()) rows.push_back(row);
    row["span"] = std::max<std::size_t>(engines.size(), 1);
    for (const std::string& engine : engines) {
      const std::vector<CaseRun> runs = finishedRuns(results, setup, engine);
      double wall = 0.0, cpu = 0.0;  // s
      for (const CaseRun& at : runs)
        if (const auto& stats = at.run->run.stats) {
          wall += stats->wallSeconds;
          cpu += stats->cpuSeconds;
        }
      const double rotations = static_cast<double>(runs.size()) * setup.endRotation();
      const auto& history = runs.front().run->history;
      row["engine"] = engine;
      row["packings"] = runs.size();
      row["wall"] = readableDuration(wall / rotations);
      row["cpu"] = readableDuration(cpu / rotations);
      row["pressures"] = history.empty()
                             ? absentText
                             : fmt::format("{} → {}", readable(history.front().outerPressure),
                                           readable(history.back().outerPressure));
      rows.push_back(row);
      row["first"] = false;
    }
  }
  return rows;
}

void addInterpretations(Json& view, const ThesisResults& results) {
  view["interpretationNumbers"] = Json::array();
  for (const ProfileNumber& number : profileNumbers)
    view["interpretationNumbers"].push_back(
        {{"name", mathHtml(number.label)}, {"unit", number.unit}});
  view["interpretations"] = Json::array();
  for (const InterpretationRow& of : interpretationRows(results)) {
    Json cells = Json::array();
    for (const InterpretationChange& change : of.changes)
      cells.push_back({{"change", readableDifference(change.change, change.error)},
                       {"from", readable(change.standard)},
                       {"there", change.change.has_value()}});
    Names labels;
    for (const double label : of.labels) labels.push_back(fmt::format("{:.3f}", label));
    view["interpretations"].push_back({{"label", mathHtml(of.label)},
                                       {"engine", of.engine},
                                       {"labels", fmt::format("{}", fmt::join(labels, ", "))},
                                       {"rotations", of.rotations},
                                       {"pairs", of.pairs},
                                       {"changes", cells}});
  }
  view["hasInterpretations"] = !view["interpretations"].empty();
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

void addSummary(Json& view, const ThesisResults& results) {
  Names sentences;
  for (const std::string& engine : rowsOf(results))
    sentences.push_back(fmt::format("Claims {}: {}.",
                                    engine == noEngine ? "that need no engine" : "on " + engine,
                                    countsText(firstClaims(results, engine))));
  view["lead"] = sentences.empty() ? "No claim was judged." : sentences.front();
  if (!sentences.empty()) sentences.erase(sentences.begin());
  for (const EngineRow& engine : results.engines)
    if (const std::string speed = speedOf(results, engine.name); !speed.empty())
      sentences.push_back(speed);
  for (const ThesisSurrogate& each : results.surrogates)
    sentences.push_back(fmt::format(
        "{} {} {}: {}", each.engine,
        each.accepted ? "is evaluated through its mirror" : "is not evaluated through its mirror",
        each.mirror, each.why));
  for (const ThesisRun& run : results.runs)
    if (run.run.status == RunStatus::failed) sentences.push_back("Failed: " + run.run.reason);
  view["sentences"] = sentences;
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

std::string thesisPage(const ThesisResults& results, const Illustrations& shown) {
  Json view = commonView(results.head, results.elapsed, results.notes, shown);
  addSummary(view, results);
  addOverview(view, thesisOverview(results), results.engines);
  view["claims"] = claimRows(results, shown);
  view["hasClaims"] = !results.claims.empty();
  view["cases"] = caseRows(results);
  view["figures"] = figureViews(shown, "figure_");
  view["map"] = figureViews(shown, "map_");
  view["hasMap"] = !view["map"].empty();
  view["hasFigures"] = !view["figures"].empty();
  addInterpretations(view, results);
  view["rules"] = results.rules;
  view["sweep"] = results.head.setup.toml;
  view["toml"] = "";  // of a case: a sweep has many
  view["files"] =
      "Beside this page: results.json (everything), claims.csv (every figure of every claim), "
      "history.csv (every rotation of every run), regime_map.csv (states over ν̄ and rotations) and "
      "readings.csv (what each interpretation changes). "
      "Whole runs, with series and all fields, are in runs/ where they were made.";
  return render("report_thesis.html", view);
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
  std::string table =
      "leg,engine,packing,from_rotation,to_rotation,outer_pressure,wheel_torque,wheel_contacts,"
      "wheel_touched,coordination,volume_fraction_at_wheel,volume_fraction_outside,"
      "velocity_at_wheel,kinetic_energy,max_overlap,mean_overlap\n";
  for (const ThesisRun& run : results.runs)
    for (const ThesisSpan& span : run.history) {
      std::string line = row(run.setup, run.engine, static_cast<std::size_t>(run.packing),
                             finite(span.from), finite(span.to));
      line.pop_back();
      for (const SpanNumber number : spanNumbers) line += "," + cell(span.*number);
      table += line + "\n";
    }
  return table;
}

}  // namespace crossgrain::reports
