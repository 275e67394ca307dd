#include "reports/stability/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "reports/common/blocks.hpp"
#include "results/schema.hpp"

namespace crossgrain::reports {

namespace {

/// By verdict, then by value/limit.
bool isWorse(const StabilityRun& run, const StabilityRun& than) {
  const auto badness = [](const StabilityRun& one) {
    const double value = one.value.value_or(0.0);
    return std::pair(one.verdict, one.limit > 0.0 ? value / one.limit : value);
  };
  return badness(run) > badness(than);
}

/// Hard cases that ask one question.
struct Family {
  std::string name, asks;
  Names measures = {};
  bool transform = false;  ///< of transformed cases
};
/// In the order of the columns.
const Family families[] = {
    {"energy",
     "Is energy conserved, or lost as the law says?",
     {"energy_gain", "energy_drift", "ledger_residual"}},
    {"momentum",
     "Are momentum and angular momentum kept?",
     {"momentum_drift", "angular_momentum_drift"}},
    {"bounce", "Do bodies rebound as theory says?", {"restitution_error"}},
    {"passing through",
     "Do bodies go through each other or through walls?",
     {"max_overlap", "tunnelled", "escaped"}},
    {"rest",
     "Do bodies at rest stay at rest?",
     {"kinetic_at_rest", "creep", "lean", "fallen", "pile_angle_change", "time_to_rest"}},
    {"cycles", "Do repeated loads come back to where they were?", {"ratchet"}},
    {"time step", "How near to theory is the largest stable time step?", {"step_limit"}},
    {"copies", "Do turned, shifted and scaled copies behave alike?", {"copies_differ"}},
    {"restart", "Does a run go on from a checkpoint as if uninterrupted?", {"restart_differs"}},
    {"bad starts", "Are starts refused that nothing can run?", {"accepted"}},
    {"turned", "Does a turned scene do the same, turned?", {"turned"}, true},
    {"mirrored", "Does a mirrored scene do the same, mirrored?", {"mirrored"}, true},
    {"other units", "Does a scene in other units do the same?", {"rescaled"}, true},
    {"renumbered", "Do bodies do the same under other numbers?", {"renumbered"}, true},
    {"restarted", "Does a run restarted from a checkpoint go on the same?", {"restarted"}, true},
    {"in one go", "Does a run without snapshots do the same?", {"split"}, true}};

const Family* known(const std::string& measure) {
  for (const Family& family : families)
    if (std::ranges::find(family.measures, measure) != family.measures.end()) return &family;
  return nullptr;
}

/// The family of hard cases that a measure belongs to; of one that is not known here its own name.
std::string familyOf(const std::string& measure) {
  const Family* family = known(measure);
  return family ? family->name : spaced(measure);
}

/// Those that occur: known ones in their order, then the others.
std::vector<Family> familiesOf(const StabilityResults& results) {
  std::vector<Family> found;
  for (const Family& family : families)
    if (std::ranges::any_of(results.cases, [&](const HardCase& hard) {
          return familyOf(hard.measure) == family.name;
        }))
      found.push_back(family);
  for (const HardCase& hard : results.cases)
    if (!findBy(found, familyOf(hard.measure), &Family::name))
      found.push_back({familyOf(hard.measure), hard.what});
  return found;
}

/// How an engine came through the cases of one family.
struct FamilyTally {
  std::size_t stable = 0, judged = 0, refused = 0, notRun = 0;
  const StabilityRun* worst = nullptr;
  std::string anchor;
};

FamilyTally familyTally(const StabilityResults& results, const std::string& engine,
                        const std::string& family) {
  FamilyTally tally;
  const std::vector<HardGroup> groups = hardGroups(results);
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const HardCase* variant : groups[g].variants) {
      if (familyOf(variant->measure) != family) continue;
      const StabilityRun* run = runOf(results, engine, *variant);
      if (!run) continue;
      tally.refused += run->verdict == Verdict::notApplicable;
      tally.notRun += run->verdict == Verdict::notMeasured;
      if (!isJudged(run->verdict)) continue;
      ++tally.judged;
      tally.stable += run->verdict == Verdict::pass;
      if (!tally.worst || isWorse(*run, *tally.worst)) {
        tally.worst = run;
        tally.anchor = fmt::format("case_{}", g + 1);
      }
    }
  return tally;
}

OverviewCell familyCell(const FamilyTally& tally) {
  OverviewCell cell{Verdict::notMeasured, {}, "stable runs", {}, {}, tally.anchor};
  if (!tally.worst) {
    if (tally.refused > 0 && tally.notRun == 0) cell.verdict = Verdict::notApplicable;
    return cell;
  }
  cell.value = static_cast<double>(tally.stable);
  cell.shown = fmt::format("{} of {}", tally.stable, tally.judged);
  if (tally.notRun > 0) cell.words = fmt::format("{} not run", tally.notRun);
  cell.verdict = tally.worst->verdict;
  if (cell.verdict != Verdict::pass) cell.words = spaced(tally.worst->name);
  return cell;
}

/// Whether these are transformed cases (studies/stability/transforms.hpp), not hard ones.
bool areTransforms(const StabilityResults& results) {
  return !results.cases.empty() && std::ranges::all_of(results.cases, [](const HardCase& one) {
    const Family* family = known(one.measure);
    return family && family->transform;
  });
}

std::string stableEngines(const StabilityResults& results) {
  const char* const same = areTransforms(results) ? "the same" : "stable";
  SaidOf said;
  for (const EngineRow& engine : results.engines) {
    std::size_t stable = 0, degraded = 0, unstable = 0, notRun = 0;
    for (const StabilityRun& run : results.runs) {
      if (run.engine != engine.name) continue;
      stable += run.verdict == Verdict::pass;
      degraded += run.verdict == Verdict::borderline;
      unstable += run.verdict == Verdict::fail;
      notRun += run.verdict == Verdict::notMeasured;
    }
    const std::size_t judged = stable + degraded + unstable;
    const std::size_t all = judged + notRun;
    said.add(engine.name,
             judged == 0     ? "nothing could be judged"
             : stable == all ? fmt::format("{} {}", allOf(judged, "run"), same)
                             : fmt::format("{} of {} runs {}{}", stable, all, same,
                                           notRun == 0 ? "" : fmt::format(", {} not run", notRun)));
  }
  return said.joined("{}: {}") + ".";
}

/// Transformed cases that run differently, engine by engine.
std::string differentTransforms(const StabilityResults& results) {
  SaidOf said;
  for (const EngineRow& engine : results.engines) {
    Names broken;
    for (const StabilityRun& run : results.runs)
      if (run.engine == engine.name && run.verdict == Verdict::fail)
        broken.push_back(fmt::format("{} {}", spaced(run.name), run.variant));
    if (!broken.empty()) said.add(engine.name, listedShortly(broken, 3));
  }
  const std::string sentence = said.joined("{} with {}");
  return sentence.empty() ? sentence
                          : fmt::format("Different after a transformation: {}.", sentence);
}

/// "Unstable: a in pile; b in column.": cases whose worst run has that verdict, engine by engine.
std::string casesAt(const StabilityResults& results, Verdict verdict, std::string_view label) {
  SaidOf said;
  for (const EngineRow& engine : results.engines) {
    Names cases;
    for (const HardGroup& group : hardGroups(results))
      if (const StabilityRun* run = worstRun(results, engine.name, group);
          run && run->verdict == verdict)
        cases.push_back(spaced(group.name));
    if (!cases.empty()) said.add(engine.name, listedShortly(cases, 3));
  }
  const std::string sentence = said.joined("{} in {}");
  return sentence.empty() ? sentence : fmt::format("{}: {}.", label, sentence);
}

/// Cases in which engines are unstable, then those in which they are degraded.
std::string worstCases(const StabilityResults& results) {
  if (areTransforms(results)) return differentTransforms(results);
  return fmt::format("{}", fmt::join(nonEmpty({casesAt(results, Verdict::fail, "Unstable"),
                                               casesAt(results, Verdict::borderline, "Degraded")}),
                                     " "));
}

std::string stabilityNextStep(const StabilityResults& results) {
  const auto has = [&](Verdict verdict) {
    return std::ranges::find(results.runs, verdict, &StabilityRun::verdict) != results.runs.end();
  };
  if (areTransforms(results)) {
    if (has(Verdict::fail))
      return "Next: see after which step and by how much; what depends on how a scene is expressed "
             "comes from the engine.";
    if (has(Verdict::notMeasured))
      return "Next: the same command with a larger --budget, for what was not run.";
    if (has(Verdict::pass)) return "All transformations change no more than rounding does.";
  }
  if (has(Verdict::fail))
    return "Next: avoid scenes like these with those engines, or see from which step on the limit "
           "is passed.";
  if (has(Verdict::borderline))
    return "Next: see whether what is degraded is more than your scene can bear.";
  if (has(Verdict::pass)) return "Nothing here speaks against any of these engines.";
  return "Nothing was judged: every run was refused.";
}

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
  Names notes = {valueOf(*run)};
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
  Table table{engineColumns({"case"}, results.engines)};
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
      "which the limit was passed first.";
  return table;
}

std::string shownUnit(const std::string& unit) {
  return unit == "-" ? "" : unit;
}

/// Empty where the limits are one: nothing is degraded.
template <typename Limits>
std::string milderLimit(const Limits& limits) {
  return limits.degradedLimit > limits.limit ? readableSetting(finite(limits.degradedLimit)) : "";
}

std::string limitsOf(const HardCase& variant) {
  if (!std::isfinite(variant.limit)) return "of each run";
  const std::string unit = shownUnit(variant.unit);
  const std::string limit = readableSetting(finite(variant.limit)), milder = milderLimit(variant);
  return fmt::format("{}{}{}{}", limit, unit.empty() ? "" : " ", unit,
                     milder.empty() ? "" : ", degraded up to " + milder);
}

/// "energy drift: … [J]. Limit 0.1 J, degraded up to 0.2 J: why."
std::string measureOf(const HardCase& hard) {
  const std::string unit = shownUnit(hard.unit);
  return fmt::format("{}: {}{}. Limit {}: {}.", capitalised(spaced(hard.measure)), hard.what,
                     unit.empty() ? "" : " [" + unit + "]", limitsOf(hard), hard.why);
}

Table variantTable(const StabilityResults& results, const HardGroup& group) {
  Table table{engineColumns({"variant", numbers("limit"), numbers("degraded")}, results.engines)};
  for (const HardCase* variant : group.variants) {
    const bool other = variant->measure != group.variants.front()->measure;
    TableRow row{{{variant->variant, {other ? spaced(variant->measure) : ""}},
                  readableSetting(finite(variant->limit)),
                  milderLimit(*variant)}};
    for (const EngineRow& engine : results.engines)
      row.cells.push_back(runCell(runOf(results, engine.name, *variant)));
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// "unstable: odd-one; degraded: grain": engines by what their worst run is; empty where every
/// engine is stable.
std::string worstEngines(const StabilityResults& results, const HardGroup& group) {
  Names parts;
  for (const auto& [verdict, word] : stabilityNames) {
    Names who;
    for (const EngineRow& engine : results.engines)
      if (const StabilityRun* run = worstRun(results, engine.name, group);
          run && run->verdict == verdict)
        who.push_back(engine.name);
    if (!who.empty() && verdict != Verdict::pass)
      parts.insert(parts.begin(),
                   fmt::format("{}: {}", spaced(std::string(word)), listedShortly(who, 3)));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

bool allStable(const StabilityResults& results, const HardGroup& group) {
  return std::ranges::all_of(results.engines, [&](const EngineRow& engine) {
    const StabilityRun* run = worstRun(results, engine.name, group);
    return run && run->verdict == Verdict::pass;
  });
}

Blocks hardCaseBlocks(const Report& report, const StabilityResults& results, const HardGroup& group,
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
  return blocks;
}

/// A folded section for each case in which an engine is unstable, degraded or was not run, the
/// worst first; one for those that some did not run and the others pass, one for those that all
/// pass, and one for those that all refused.
void addHardCases(Report& report, const StabilityResults& results,
                  const std::vector<HardGroup>& groups) {
  const auto worstOfAll = [&](const HardGroup& group) {
    Verdict worst = Verdict::notApplicable;
    for (const EngineRow& engine : results.engines)
      if (const StabilityRun* run = worstRun(results, engine.name, group))
        worst = moreSevere(worst, run->verdict);
    return worst;
  };
  const auto nameOfCase = [&](std::size_t g) { return spaced(groups[g].name); };
  const auto idOf = [](std::size_t g) { return fmt::format("case_{}", g + 1); };
  std::vector<std::size_t> stable, refused, byAll;
  for (const Verdict verdict : {Verdict::fail, Verdict::borderline, Verdict::notMeasured})
    for (std::size_t g = 0; g < groups.size(); ++g)
      if (worstOfAll(groups[g]) == verdict)
        report
            .section(idOf(g),
                     fmt::format("{}: {}", nameOfCase(g), worstEngines(results, groups[g])),
                     nameOfCase(g))
            .blocks = hardCaseBlocks(report, results, groups[g], g + 1);
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (const Verdict worst = worstOfAll(groups[g]);
        worst == Verdict::pass || worst == Verdict::notApplicable)
      (allStable(results, groups[g]) ? stable
       : worst == Verdict::pass      ? refused
                                     : byAll)
          .push_back(g);
  const auto addTogether = [&](const char* id, const std::string& title,
                               const std::vector<std::size_t>& cases) {
    if (cases.empty()) return;
    Blocks blocks;
    for (const std::size_t g : cases) {
      blocks.push_back(Heading{nameOfCase(g), idOf(g)});
      std::ranges::move(hardCaseBlocks(report, results, groups[g], g + 1),
                        std::back_inserter(blocks));
    }
    report.section(id, title + ": " + counted(cases.size(), "case"), capitalised(id)).blocks =
        std::move(blocks);
  };
  const std::string same = areTransforms(results) ? "the same" : "stable";
  addTogether("refused", capitalised(same) + " where it was run", refused);
  addTogether("stable", "✓ " + same + " on every engine", stable);
  addTogether("unexamined", "Refused by every engine", byAll);
}

/// The map, the worst moments of the first runs that are unstable, and the numbers.
void addMatrix(Report& report, const StabilityResults& results,
               const std::vector<HardGroup>& groups) {
  constexpr std::size_t inSight = 4;
  Blocks& blocks = report.section("matrix", "Cases by engine", "Summary").blocks;
  blocks.push_back(drawingsOf(report.figures, "stability_map"));
  Drawings worst = drawingsOf(report.pictures, Picture::Shows::worst);
  worst.names.resize(std::min(worst.names.size(), inSight));
  if (!worst.names.empty()) {
    blocks.push_back(Heading{"Worst moments of unstable runs"});
    blocks.push_back(std::move(worst));
  }
  blocks.push_back(
      Details{"Values of the measures, case by case", {stabilityMatrix(results, groups)}});
}

Table scoreTable(const StabilityResults& results) {
  Table table{{engineNames("engine"), "case", "variant", "verdict", "measure", numbers("value"),
               numbers("limit"), numbers("degraded"), "unit", numbers("from step"),
               remarks("reason")}};
  table.dense = true;
  for (const StabilityRun& run : results.runs)
    table.rows.push_back({{run.engine,
                           spaced(run.name),
                           run.variant,
                           {runWord(run), {}, run.verdict, true},
                           spaced(run.measure),
                           valueOf(run),
                           readableSetting(finite(run.limit)),
                           milderLimit(run),
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

/// An engine per row, a family of hard cases per column: runs that stayed stable, of those judged.
Overview stabilityOverview(const StabilityResults& results) {
  Overview overview;
  if (areTransforms(results))
    overview.states = {{Verdict::pass, "the same, but for rounding"},
                       {Verdict::fail, "different"},
                       {Verdict::notApplicable, "cannot be done"}};
  else
    overview.states = {{Verdict::pass, "all stable"},
                       {Verdict::borderline, "some degraded"},
                       {Verdict::fail, "some unstable"},
                       {Verdict::notApplicable, "refused"}};
  const std::vector<Family> all = familiesOf(results);
  for (const Family& family : all) overview.columns.push_back({family.name, family.asks, "matrix"});
  for (const EngineRow& engine : results.engines) {
    OverviewRow row{engine.name, true, {}};
    for (const Family& family : all)
      row.cells.push_back(familyCell(familyTally(results, engine.name, family.name)));
    overview.rows.push_back(std::move(row));
  }
  overview.conclusion =
      nonEmpty({stableEngines(results), worstCases(results), stabilityNextStep(results)});
  return overview;
}

}  // namespace

std::vector<HardGroup> hardGroups(const StabilityResults& results) {
  std::vector<HardGroup> groups;
  for (const HardCase& variant : results.cases) {
    auto group = std::ranges::find(groups, variant.name, &HardGroup::name);
    if (group == groups.end()) group = groups.insert(groups.end(), {variant.name, {}});
    group->variants.push_back(&variant);
  }
  return groups;
}

const StabilityRun* runOf(const StabilityResults& results, const std::string& engine,
                          const HardCase& variant) {
  return findIf(results.runs, [&](const StabilityRun& run) {
    return run.engine == engine && run.name == variant.name && run.variant == variant.variant;
  });
}

const StabilityRun* worstRun(const StabilityResults& results, const std::string& engine,
                             const HardGroup& group) {
  const StabilityRun* worst = nullptr;
  for (const HardCase* variant : group.variants) {
    const StabilityRun* run = runOf(results, engine, *variant);
    if (run && (!worst || isWorse(*run, *worst))) worst = run;
  }
  return worst;
}

Report reportOf(const StabilityResults& results) {
  const std::vector<HardGroup> groups = hardGroups(results);
  Report report{{results.head, results.engines, stabilityOverview(results)}, results.elapsed};
  report.figures = stabilityFigures(results);
  report.pictures = stabilityPictures(results);
  addMatrix(report, results, groups);
  addHardCases(report, results, groups);
  report.section("scores", "All numbers: engine, case and variant", "All numbers").blocks = {
      scoreTable(results)};
  addEngines(report);
  report.foldAllBut({"matrix"});
  report.tables = {{"stability.csv", stabilityCsv(results)}};
  report.checks = stabilityChecks(results);
  return report;
}

}  // namespace crossgrain::reports
