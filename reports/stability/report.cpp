#include "reports/stability/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/common/csv_row.hpp"
#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/sections.hpp"
#include "reports/common/sentences.hpp"
#include "results/json_fields.hpp"

namespace crossgrain::reports {

namespace {

using Kind = Column::Kind;

/// The clause that names what is missing, of "X cannot run FILE: CLAUSE; HINT".
std::string shortReason(const StabilityRun& run) {
  const auto clause = run.reason.find(".toml: ");
  if (run.verdict != Verdict::notApplicable || clause == std::string::npos) return run.reason;
  const std::string rest = run.reason.substr(clause + 7);
  return rest.substr(0, rest.find("; list "));
}

std::string valueOf(const StabilityRun& run) {
  if (!run.value) return {};
  return *run.value > 1e300 ? "beyond numbers" : readable(run.value);
}

std::string runWord(const StabilityRun& run) {
  return spaced(std::string(nameOf(run.verdict, stabilityNames)));
}

/// The verdict, the measure's value, and the step from which on it was beyond its limit.
Cell runCell(const StabilityRun* run) {
  if (!run) return absentText;
  std::vector<std::string> notes = {valueOf(*run)};
  // Of a transformed case the limit is not the case's.
  if (std::isfinite(run->limit) && !std::isfinite(run->degradedLimit))
    notes.push_back("rounding may do " + readable(run->limit));
  if (run->step && run->verdict != Verdict::pass)
    notes.push_back("from step " + readableCount(stepOf(*run)));
  if (!run->value) notes.push_back(shortReason(*run));
  return {runWord(*run), std::move(notes), run->verdict, true};
}

/// Every verdict of an engine in a case at a glance: "3 of 4 stable".
std::string stableTally(const StabilityResults& results, const std::string& engine,
                        const HardGroup& group) {
  int stable = 0, judged = 0;
  for (const HardCase* variant : group.variants)
    if (const StabilityRun* run = runOf(results, engine, *variant)) {
      stable += run->verdict == Verdict::pass;
      judged += isJudged(run->verdict);
    }
  return judged > 1 ? fmt::format("{} of {} stable", stable, judged) : std::string();
}

Table stabilityMatrix(const StabilityResults& results, const std::vector<HardGroup>& groups) {
  Table table{engineColumns({"case"}, results.engines), {}};
  for (std::size_t g = 0; g < groups.size(); ++g) {
    TableRow row{{{spaced(groups[g].name), {spaced(groups[g].variants.front()->measure)}}}};
    row.cells.front().link = fmt::format("#case_{}", g + 1);
    for (const EngineRow& engine : results.engines) {
      Cell cell = runCell(worstRun(results, engine.name, groups[g]));
      if (std::string tally = stableTally(results, engine.name, groups[g]); !tally.empty())
        cell.notes.insert(cell.notes.begin(), std::move(tally));
      row.cells.push_back(std::move(cell));
    }
    table.rows.push_back(std::move(row));
  }
  table.note =
      "The worst of an engine's runs in each case. Stable: the measure stayed within its limit; "
      "degraded: it passed the limit, but not the second, milder one; unstable: it passed both, or "
      "the engine died, hung or returned no number; refused: the engine lacks what the case needs, "
      "or does not report what the measure takes. Below: the measure's value, and the step at "
      "which "
      "the limit was passed first.";
  return table;
}

std::string shownUnit(const std::string& unit) {
  return unit == "-" ? "" : unit;
}

std::string limitsOf(const HardCase& variant) {
  if (!std::isfinite(variant.limit)) return "of each run";
  const std::string unit = shownUnit(variant.unit);
  return fmt::format("{}{}{}, degraded up to {}", readableSetting(finite(variant.limit)),
                     unit.empty() ? "" : " ", unit, readableSetting(finite(variant.degradedLimit)));
}

/// "energy drift: … [J]. Limit 0.1 J, degraded up to 0.2 J: why."
std::string measureOf(const HardCase& hard) {
  const std::string unit = shownUnit(hard.unit);
  return fmt::format("{}: {}{}. Limit {}: {}.", capitalised(spaced(hard.measure)), hard.what,
                     unit.empty() ? "" : " [" + unit + "]", limitsOf(hard), hard.why);
}

Table variantTable(const StabilityResults& results, const HardGroup& group) {
  Table table{engineColumns({"variant", {"limit", Kind::number}, {"degraded", Kind::number}},
                            results.engines),
              {}};
  for (const HardCase* variant : group.variants) {
    const bool other = variant->measure != group.variants.front()->measure;
    TableRow row{{{variant->variant, {other ? spaced(variant->measure) : ""}},
                  readableSetting(finite(variant->limit)),
                  readableSetting(finite(variant->degradedLimit))}};
    for (const EngineRow& engine : results.engines)
      row.cells.push_back(runCell(runOf(results, engine.name, *variant)));
    table.rows.push_back(std::move(row));
  }
  return table;
}

bool allStable(const StabilityResults& results, const HardGroup& group) {
  return std::ranges::all_of(results.engines, [&](const EngineRow& engine) {
    const StabilityRun* run = worstRun(results, engine.name, group);
    return run && run->verdict == Verdict::pass;
  });
}

/// Folded where every engine is stable in it.
void addHardCase(Report& report, const StabilityResults& results, const HardGroup& group,
                 std::size_t number) {
  const HardCase& first = *group.variants.front();
  Blocks blocks = {
      Paragraph{areTransforms(results) ? "The same has to happen after every transformation."
                                       : first.tests},
      Paragraph{measureOf(first), Paragraph::Style::small}, variantTable(results, group)};
  Drawings curves;
  for (const Figure& figure : report.figures)
    if (figure.name == fmt::format("stability_{}", number)) curves.names.push_back(figure.name);
  blocks.push_back(std::move(curves));
  Drawings worst;
  for (const Picture& picture : report.pictures)  // titles are "ENGINE: CASE" or "ENGINE: CASE, …"
    if ((picture.title + ",").find(": " + group.name + ",") != std::string::npos)
      worst.names.push_back(picture.name);
  if (!worst.names.empty())
    blocks.push_back(Details{"Worst moments of unstable runs", {std::move(worst)}});
  blocks.push_back(Details{
      "The case as it was run",
      {Paragraph{first.file + ", all its extends merged; the first variant."}, Code{first.toml}}});
  Section& section = report.section(fmt::format("case_{}", number), spaced(group.name));
  if (allStable(results, group))
    section.blocks.push_back(Details{"✓ stable on every engine", std::move(blocks)});
  else
    section.blocks = std::move(blocks);
}

Table scoreTable(const StabilityResults& results) {
  Table table{{{"engine", Kind::engines},
               "case",
               "variant",
               "verdict",
               "measure",
               {"value", Kind::number},
               {"limit", Kind::number},
               {"degraded", Kind::number},
               "unit",
               {"from step", Kind::number},
               {"reason", Kind::remark}},
              {}};
  table.dense = true;
  for (const StabilityRun& run : results.runs)
    table.rows.push_back({{run.engine,
                           spaced(run.name),
                           run.variant,
                           {runWord(run), {}, run.verdict, true},
                           spaced(run.measure),
                           valueOf(run),
                           readableSetting(finite(run.limit)),
                           readableSetting(finite(run.degradedLimit)),
                           shownUnit(run.unit),
                           run.step ? readableCount(stepOf(run)) : "",
                           shortReason(run)}});
  return table;
}

std::string stabilityCsv(const StabilityResults& results) {
  std::string table =
      "engine,case,verdict,measure,value,limit,unit,step,reason,degraded_limit,variant,time_s\n";
  for (const StabilityRun& run : results.runs)
    table += row(run.engine, run.name, std::string(nameOf(run.verdict, stabilityNames)),
                 run.measure, run.value, finite(run.limit), run.unit, stepOf(run), run.reason,
                 finite(run.degradedLimit), run.variant, run.time);
  return table;
}

/// "0.31 J against a limit of 0.1 J (why); reason"
std::string limitInWords(const StabilityRun& run, const std::string& why) {
  std::string figure;
  if (run.value)
    figure = fmt::format("{:.4g}{}{} against a limit of {:.4g}", *run.value,
                         run.unit.empty() ? "" : " ", run.unit, run.limit);
  if (!figure.empty() && !why.empty()) figure += fmt::format(" ({})", why);
  return figure + (figure.empty() || run.reason.empty() ? "" : "; ") + run.reason;
}

std::vector<JUnitCase> stabilityChecks(const StabilityResults& results) {
  std::vector<JUnitCase> cases;
  for (const StabilityRun& run : results.runs) {
    JUnitCase one{
        junitGroup(run.name, run.variant), run.engine + ": " + run.measure, run.verdict, "",
        junitSeconds(run.stats),           run.status == Status::failed};
    // A degraded run passes, and its message says so.
    if (run.verdict == Verdict::borderline) one.passes = true;
    if (one.broke || !isJudged(run.verdict)) {
      one.message = run.reason;
    } else if (run.verdict != Verdict::pass) {
      std::string why;
      for (const HardCase& setup : results.cases)
        if (setup.name == run.name && setup.variant == run.variant) why = setup.why;
      one.message =
          std::string(nameOf(run.verdict, stabilityNames)) + ": " + limitInWords(run, why);
    }
    cases.push_back(std::move(one));
  }
  return cases;
}

}  // namespace

Report reportOf(const StabilityResults& results) {
  const std::vector<HardGroup> groups = hardGroups(results);
  Report report{{results.head, results.engines, stabilityOverview(results)}};
  report.elapsed = results.elapsed;
  report.figures = stabilityFigures(results);
  report.pictures = stabilityPictures(results);
  report.section("matrix", "Hard cases by engine", "Summary")
      .blocks.push_back(stabilityMatrix(results, groups));
  for (std::size_t g = 0; g < groups.size(); ++g) addHardCase(report, results, groups[g], g + 1);
  report.section("scores", "All numbers").blocks = {
      Details{"Engine × case × variant", {scoreTable(results)}}};
  report.section("map", "As a picture").blocks = {drawingsOf(report.figures, "stability_map")};
  addEngines(report);
  report.tables = {{"stability.csv", stabilityCsv(results)}};
  report.checks = stabilityChecks(results);
  return report;
}

}  // namespace crossgrain::reports
