#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/overview.hpp"
#include "reports/common/page.hpp"
#include "reports/thesis/overview.hpp"
#include "reports/thesis/reading_changes.hpp"
#include "reports/thesis/report.hpp"

namespace crossgrain::reports {

namespace {

constexpr double secondsPerDay = 86400.0;

/// "figure 7.14" is drawn as figure_7_14; empty: it is not drawn.
std::string drawnPlot(const std::string& plot, const Illustrations& shown) {
  std::string name = plot;
  std::ranges::replace_if(
      name, [](char c) { return c == ' ' || c == '.'; }, '_');
  const bool drawn = !shown.missing &&
                     std::ranges::find(shown.figures, name, &Figure::name) != shown.figures.end();
  return drawn ? name : "";
}

Json figureRows(const ClaimRow& claim) {
  Json rows = Json::array();
  for (const ClaimFigure& figure : claim.figures)
    rows.push_back({{"name", mathHtml(figure.name)},
                    {"value", readable(figure.value, figure.standardError)},
                    {"unit", figure.unit},
                    {"bounds", boundsInWords(figure)}});
  return rows;
}

/// How a verdict is shown: class of the style sheet, mark before the word.
struct ClaimStyle {
  std::string_view cssClass, mark;
};
ClaimStyle styleOf(ClaimVerdict verdict) {
  if (verdict == ClaimVerdict::reproduced) return {"agree", "✓"};
  if (verdict == ClaimVerdict::refuted) return {"disagree", "✗"};
  return {"undecided", "?"};
}

/// Of a refuted claim each that was found; or that none was.
Json reasonsOf(const ClaimRow& claim) {
  Json reasons = Json::array();
  for (const std::string& reason : claim.reasons) reasons.push_back(mathHtml(reason));
  if (claim.verdict == ClaimVerdict::refuted && reasons.empty())
    reasons.push_back("No reason was found.");
  return reasons;
}

Json claimRows(const ThesisResults& results, const Illustrations& shown) {
  Json rows = Json::array();
  std::string before;
  for (const ClaimRow& claim : results.claims) {
    const ClaimStyle style = styleOf(claim.verdict);
    const bool first = claim.id != before;
    before = claim.id;
    rows.push_back({{"id", claim.id},
                    {"first", first},
                    {"claim", first ? mathHtml(claim.claim) : ""},
                    {"engine", claim.engine},
                    {"carrier", claim.carrier},
                    {"reading", claim.reading},
                    {"figures", figureRows(claim)},
                    {"verdict", fmt::format("{} {}", style.mark, nameOf(claim.verdict))},
                    {"class", style.cssClass},
                    {"why", mathHtml(claim.why)},
                    {"reasons", reasonsOf(claim)},
                    {"legs", fmt::format("{}", fmt::join(claim.legs, ", "))},
                    {"plot", claim.plot},
                    {"anchor", drawnPlot(claim.plot, shown)}});
  }
  return rows;
}

/// Of one engine's finished runs of a leg, all packings together.
struct LegRuns {
  std::string engine;
  int packings = 0;
  double wall = 0.0, cpu = 0.0;  ///< [s]
  const ThesisRun* first = nullptr;
};

std::vector<LegRuns> runsOf(const ThesisResults& results, const ThesisLeg& leg) {
  std::vector<LegRuns> all;
  for (const ThesisRun& run : results.runs) {
    if (run.leg != leg.name || !run.run.finished()) continue;
    auto own = std::ranges::find(all, run.engine, &LegRuns::engine);
    if (own == all.end()) own = all.insert(all.end(), {run.engine, 0, 0.0, 0.0, &run});
    ++own->packings;
    if (!run.run.stats) continue;
    own->wall += run.run.stats->wallSeconds;
    own->cpu += run.run.stats->cpuSeconds;
  }
  return all;
}

std::string rotationsOf(const ThesisLeg& leg) {
  return fmt::format("{} to {}", readableSetting(leg.settleRotations),
                     readableSetting(leg.settleRotations + leg.averagedRotations));
}

/// A row for each engine of a leg, the leg itself in the first.
Json legRows(const ThesisResults& results) {
  Json rows = Json::array();
  for (const ThesisLeg& leg : results.legs) {
    const double rotations = leg.settleRotations + leg.averagedRotations;
    Json row = {{"first", true},
                {"name", leg.name},
                {"purpose", leg.purpose},
                {"families", fmt::format("{}", fmt::join(leg.families, ", "))},
                {"label", fmt::format("{:.3f}", leg.label)},
                {"nu", fmt::format("{:.4f}", leg.cell.volumeFraction)},
                {"counts", fmt::format("{} + {}", leg.cell.small, leg.cell.large)},
                {"omega", readableSetting(leg.cell.omega)},
                {"spacing", readableSetting(1e3 * leg.cell.wallSpacing)},
                {"rotations", rotationsOf(leg)},
                {"engine", "not run"}};
    const std::vector<LegRuns> runs = runsOf(results, leg);
    row["span"] = std::max<std::size_t>(runs.size(), 1);
    if (runs.empty()) rows.push_back(row);
    for (const LegRuns& own : runs) {
      const double each = own.packings * rotations;
      const auto& history = own.first->history;
      row["engine"] = own.engine;
      row["packings"] = own.packings;
      row["wall"] = readableDuration(own.wall / each);
      row["cpu"] = readableDuration(own.cpu / each);
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

/// A row for each reading, with its change of each number.
void addReadings(Json& view, const ThesisResults& results) {
  view["readingNumbers"] = Json::array();
  for (const ProfileNumber& number : profileNumbers())
    view["readingNumbers"].push_back({{"name", mathHtml(number.label)}, {"unit", number.unit}});
  view["readings"] = Json::array();
  for (const ReadingRow& of : readingRows(results)) {
    Json cells = Json::array();
    for (const ReadingChange& change : of.changes)
      cells.push_back({{"change", readableDifference(change.change, change.error)},
                       {"from", readable(change.standard)},
                       {"there", change.change.has_value()}});
    std::vector<std::string> labels;
    for (const double label : of.labels) labels.push_back(fmt::format("{:.3f}", label));
    view["readings"].push_back({{"words", mathHtml(of.words)},
                                {"engine", of.engine},
                                {"labels", fmt::format("{}", fmt::join(labels, ", "))},
                                {"rotations", of.rotations},
                                {"pairs", of.pairs},
                                {"changes", cells}});
  }
  view["hasReadings"] = !view["readings"].empty();
}

/// "grain: 75 s of wall time and 74 s of CPU time a rotation at 0.1 /s (the median of 17 runs); …"
/// @param first  index of the engine among all
std::string speedOf(const ThesisResults& results, const std::string& engine) {
  std::vector<std::pair<double, double>> perRotation;  // wall, CPU, at the thesis' own rate
  constexpr double thesisRate = 0.1;
  for (const ThesisRun& run : results.runs) {
    const auto leg = std::ranges::find(results.legs, run.leg, &ThesisLeg::name);
    if (leg == results.legs.end() || run.engine != engine || !run.run.finished()) continue;
    if (!run.run.stats || leg->cell.omega <= 0.0) continue;
    // Steps of a rotation go as 1/Ω.
    const double scale =
        leg->cell.omega / thesisRate / (leg->settleRotations + leg->averagedRotations);
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

std::string sentenceOf(const ThesisCarrier& carrier) {
  return fmt::format(
      "{} is {}evaluated through its mirror {}: {}{}", carrier.engine,
      carrier.carries ? "" : "not ", carrier.mirror, carrier.why,
      carrier.carries ? " Its packing 0 was not compared with the mirror's: what begins later in a "
                        "run than these windows is not examined here, but by compare."
                      : "");
}

void addThesisSummary(Json& view, const ThesisResults& results) {
  const std::vector<std::string> counts = claimCounts(results);
  view["lead"] = counts.empty() ? "No claim was judged." : counts.front() + ".";
  view["sentences"] = Json::array();
  for (std::size_t k = 1; k < counts.size(); ++k) view["sentences"].push_back(counts[k] + ".");
  for (const EngineRow& engine : results.engines)
    if (const std::string speed = speedOf(results, engine.name); !speed.empty())
      view["sentences"].push_back(speed);
  for (const ThesisCarrier& carrier : results.carriers)
    view["sentences"].push_back(sentenceOf(carrier));
  for (const ThesisRun& run : results.runs)
    if (run.run.status == RunStatus::failed)
      view["sentences"].push_back("Failed: " + run.run.reason);
}

}  // namespace

std::string thesisPage(const ThesisResults& results, const Illustrations& shown) {
  Json view = commonView(results.head, results.elapsed, results.notes, shown);
  addThesisSummary(view, results);
  addOverview(view, thesisOverview(results), results.engines);
  view["claims"] = claimRows(results, shown);
  view["hasClaims"] = !results.claims.empty();
  view["legs"] = legRows(results);
  view["figures"] = figureViews(shown, "figure_");
  view["map"] = figureViews(shown, "map_");
  view["hasMap"] = !view["map"].empty();
  view["hasFigures"] = !view["figures"].empty();
  addReadings(view, results);
  view["rules"] = results.rules;
  view["ladder"] = results.head.setup.toml;
  view["toml"] = "";  // of a case: a ladder has many
  view["files"] =
      "Beside this page: results.json (everything), claims.csv (every figure of every claim), "
      "history.csv (every rotation of every run), regime_map.csv (states over ν̄ and rotations) and "
      "readings.csv (what "
      "each reading changes). "
      "Whole runs, with series and all fields, are in runs/ where they were made.";
  return render("report_thesis.html", view);
}

}  // namespace crossgrain::reports
