#include <fmt/format.h>

#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <set>

#include "cases/effect_switch.hpp"
#include "cases/engine_file.hpp"
#include "cli/option_groups.hpp"
#include "cli/outcome.hpp"
#include "reports/common/text.hpp"
#include "reports/conformance/report.hpp"
#include "reports/cost/report.hpp"
#include "reports/flow/endpoint_text.hpp"
#include "reports/lockstep/report.hpp"
#include "reports/report.hpp"
#include "results/collision.hpp"
#include "studies/collide/collide.hpp"
#include "studies/conformance/conformance.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/mirrors.hpp"
#include "studies/core/study_cases.hpp"
#include "studies/cost/cost.hpp"
#include "studies/effects/effects.hpp"
#include "studies/flow/average.hpp"
#include "studies/flow/compare.hpp"
#include "studies/flow/lockstep_job.hpp"
#include "studies/lockstep/identify.hpp"
#include "studies/stability/stability.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"

namespace crossgrain::inline cli {

namespace {

/// How results stand on a terminal, before the matrix that their report opens with.
template <typename Results>
struct Terminal {
  std::string (*text)(const Results&);
  bool timeSpent = false;
  /// Text that is printed in place of all that, to be pasted; empty: nothing is.
  std::string (*paste)(const Results&) = nullptr;
};

/// From the folder to the exit status, the same for all studies.
template <typename Options, typename Results>
int runStudy(const Study<Options, Results>& study, const CommandLine& line, Options own,
             const Terminal<Results>& terminal) {
  const std::vector<Case> cases = study.cases(line, own);
  RunStore store(line.run, study.name,
                 study.keeps == Keeps::eachCase  ? keysOfEach(cases)
                 : study.keeps == Keeps::oneCase ? soleCase(cases.front())
                                                 : std::map<std::string, CaseKeys>());
  const StudyWork work{line, cases, store};
  if (line.run.dryRun) {
    const std::string plan = study.plan(work, own);
    printNotes();
    fmt::print("{}", plan);
    return exitPassed;
  }
  const Results results = study.run(work, own);
  store.begin();
  if (line.run.shard && !line.run.shard->writes()) {
    fmt::print("shard {} of {}: all runs are finished; shard 1 writes the results into {}\n",
               line.run.shard->number, line.run.shard->of, line.run.out.string());
    return exitPassed;
  }
  const reports::Overview overview = writeReport(results, line.run.out).overview;
  const std::string paste = terminal.paste && !line.json ? terminal.paste(results) : "";
  if (!paste.empty())
    fmt::print("{}", paste);
  else
    printResults(line, line.json ? "" : terminal.text(results), overview, terminal.timeSpent);
  return printOutcome(line, study.outcome(results, line, own));
}

template <typename Options, typename Results>
Action declareStudy(CLI::App& app, CommandLine& line, const Study<Options, Results>& study,
                    const Terminal<Results>& terminal) {
  const auto own = std::make_shared<Options>();
  addStudy(app, line, study.takes, study.options(*own, line), study.exclusions);
  return [&study, &line, own, terminal] {
    if (!study.takes.jobs) line.run.jobs = 1;
    if (study.keeps == Keeps::nothing) return runStudy(study, line, *own, terminal);
    return resumably(line.run, [&] { return runStudy(study, line, *own, terminal); });
  };
}

std::string orNone(const std::vector<std::string>& names, const char* none) {
  return names.empty() ? none : fmt::format("{}", fmt::join(names, ", "));
}

/// @param called  effects that the case calls for, by name
std::string describeEffects(const std::vector<std::string>& called) {
  std::vector<std::string> leftOut;
  for (const Effect effect : allEffects)
    if (std::ranges::find(called, toString(effect)) == called.end())
      leftOut.push_back(toString(effect));
  return fmt::format("effects called for: {}; left out: {}\n", orNone(called, "none"),
                     orNone(leftOut, "none"));
}

std::string compareText(const CompareResults& results) {
  std::string text = describeEffects(results.effects);
  const auto add = [&](const std::string& line) { text += line + "\n"; };
  if (results.lockstep)
    for (const LockstepRow& row : results.lockstep->rows)
      add(reports::describe(row, results.lockstep->rules));
  for (const SurrogateEngine& own : results.endpoints.surrogates) add(reports::describe(own));
  std::map<Verdict, int> answers;
  for (const EndpointRow& row : results.endpoints.rows) {
    if (row.kind != PairKind::peer && row.kind != PairKind::closedForm) continue;
    if (row.kind != PairKind::closedForm &&
        (row.a != referenceOf(results) || results.nothingJudged))
      continue;  // pairs of others are in the report
    ++answers[row.verdict];
    add(fmt::format("{:<16} {:<26} {}", row.b, row.endpoint, reports::describeAnswer(row)));
  }
  std::set<std::string> said;
  for (const FlowRun& run : results.runs)
    for (const std::string& remark : run.remarks)
      if (const std::string note = fmt::format("note: {}: {}", run.engine, remark);
          said.insert(note).second)
        add(note);
  for (const AlarmRow& alarm : results.endpoints.alarms) add("ALARM: " + reports::describe(alarm));
  if (const InterimFindings& looks = results.endpoints.looks; looks.taken > 0)
    add(reports::describe(looks));
  if (!results.nothingJudged)
    text += fmt::format("{} agree, {} borderline, {} disagree, {} undecided{}; ",
                        answers[Verdict::pass], answers[Verdict::borderline],
                        answers[Verdict::fail], answers[Verdict::undecided],
                        answers[Verdict::notMeasured] == 0
                            ? std::string()
                            : fmt::format(", {} absent", answers[Verdict::notMeasured]));
  add(fmt::format("{} of {} runs failed",
                  std::ranges::count(results.runs, Status::failed, &FlowRun::status),
                  results.runs.size()));
  return text;
}

std::string collideText(const CollideResults& results) {
  std::map<std::string, int> refused;
  for (const CollisionVariant& variant : results.variants)
    for (const CollisionCurve& curve : variant.curves)
      refused[curve.engine] += curve.status == Status::refused;
  std::string text;
  for (const auto& [engine, count] : refused)
    if (count > 0)
      text += fmt::format("{} does not have the law of {}; the report says why\n", engine,
                          reports::counted(static_cast<std::size_t>(count), "sweep"));
  const SweepCount count = countOf(results);
  return text + fmt::format("{} passed, {} differ by their model, {} failed, {} not judged\n",
                            reports::counted(static_cast<std::size_t>(count.held), "curve"),
                            count.modelDifference, count.beyondLimits, count.notJudged);
}

/// "grain  without friction  0.583 of the time per step, 21 of 42 rings changed"
/// @param places  that a profile is divided into
std::string effectText(const EffectVariant& variant, const char* places) {
  const std::string head = fmt::format("{:<16} without {:<22} ", variant.engine, variant.effect);
  if (variant.status != Status::finished)
    return head +
           fmt::format("{}: {}\n", nameOf(variant.status, engineStatusNames), variant.reason);
  int judged = 0, changed = 0;
  for (const ChangedField& field : variant.changes.fields)
    for (const RingChange& ring : field.rings) {
      judged += ring.resolved.has_value();
      changed += ring.resolved == true;
    }
  return head + fmt::format("{:.3f} of the time per step, {}\n", variant.timeRatio.value_or(NAN),
                            judged == 0
                                ? "too few packings to know what changed"
                                : fmt::format("{} of {} {} changed", changed, judged, places));
}

std::string effectsText(const EffectsResults& results) {
  std::string text = describeEffects(results.effects);
  for (const EffectVariant& variant : results.variants)
    if (variant.isSwitched()) text += effectText(variant, results.region ? "bins" : "rings");
  return text;
}

std::string verdictText(const StabilityRun& run) {
  std::string figure;
  if (run.value)
    figure =
        fmt::format("{} {:.3g} {}, limit {:.3g}", run.measure, *run.value, run.unit, run.limit);
  if (run.step) figure += fmt::format("{}step {}", figure.empty() ? "" : ", ", *run.step);
  return fmt::format("{:<9} {:<16} {}{}{}: {}{}{}\n", nameOf(run.verdict, stabilityNames),
                     run.engine, run.name, run.variant.empty() ? "" : " ", run.variant, figure,
                     figure.empty() || run.reason.empty() ? "" : "; ", run.reason);
}

/// One line for each engine and reason of runs that were not judged, as there may be many.
std::string unjudgedText(const std::vector<StabilityRun>& runs, Verdict verdict, const char* word) {
  std::map<std::pair<std::string, std::string>, int> count;
  for (const StabilityRun& run : runs)
    if (run.verdict == verdict) ++count[{run.engine, run.reason}];
  std::string text;
  for (const auto& [what, times] : count)
    text += fmt::format("{:<9} {:<16} {} run{}: {}\n", word, what.first, times,
                        times == 1 ? "" : "s", what.second);
  return text;
}

std::string stabilityText(const StabilityResults& results) {
  const std::vector<StabilityRun>& runs = results.runs;
  const auto count = [&](Verdict verdict) {
    return std::ranges::count(runs, verdict, &StabilityRun::verdict);
  };
  std::string text;
  for (const StabilityRun& run : runs)
    if (run.verdict > Verdict::pass) text += verdictText(run);
  text += unjudgedText(runs, Verdict::notApplicable, "refused");
  text += unjudgedText(runs, Verdict::notMeasured, "not run");
  const auto notRun = count(Verdict::notMeasured);
  return text + fmt::format("{} stable, {} degraded, {} unstable, {} refused{}\n",
                            count(Verdict::pass), count(Verdict::borderline), count(Verdict::fail),
                            count(Verdict::notApplicable),
                            notRun == 0 ? "" : fmt::format(", {} not run", notRun));
}

std::string lockstepText(const LockstepResults& results) {
  std::string text;
  for (const LockstepRow& row : results.lockstep.rows)
    text += reports::describe(row, results.lockstep.rules) + "\n";
  return text;
}

/// Says what the files lack and what that costs, too; the first note says which files they are.
template <typename Results>
std::string averagedText(const Results& results) {
  std::string text = fmt::format("{} snapshots averaged\n", results.averaging.snapshots);
  for (std::size_t k = 1; k < results.notes.size(); ++k)
    text += fmt::format("note: {}\n", results.notes[k]);
  return text;
}

struct ConformanceOptions {
  std::string engine;
  bool allowUnexamined = false;
  std::optional<std::string> out, budget;
};

EngineEntry entryOf(const std::string& engine) {
  if (namesEngineFile(engine)) return *findEngine(addExternalEngine(loadEngineFile(engine)));
  if (engine == "all") throw BadInput("conformance takes one engine: a name or an engine file");
  return selectEngines({engine}).front();
}

void print(const ConformanceResults& results) {
  fmt::print("{}\n", reports::conformanceLead(results));
  for (const auto outcome : {checkBrokeDown, checkFailed, checkUntried, checkSkipped})
    for (const ConformanceRow& row : results.rows)
      if (row.outcome == outcome) fmt::print("  {}\n", reports::conformanceSentence(row));
  for (const ConformanceRow& row : results.rows)
    if (row.outcome == checkPassed && !row.detail.empty()) fmt::print("  {}\n", row.detail);
  for (const std::string& line :
       {reports::conformanceNotExamined(results), reports::conformanceCause(results)})
    if (!line.empty()) fmt::print("{}\n", line);
}

int conformanceOf(const CommandLine& line, const ConformanceOptions& options) {
  const EngineEntry entry = entryOf(options.engine);
  ConformanceTask task{entry, line.only, line.run.quiet, line.run.commandLine};
  if (options.budget) task.budget = secondsOf(*options.budget);
  if (options.out) makeDirectory(*options.out);  // before minutes of work that it is to hold
  const ConformanceResults results = runConformance(task);
  if (options.out) writeReport(results, *options.out);
  if (line.json)
    fmt::print("{}\n", toJson(results).dump());
  else
    print(results);
  if (options.out && !line.json) fmt::print("report: {}/report.html\n", *options.out);
  return printOutcome(line, outcomeOf(results, options.allowUnexamined));
}

Action declareConformance(CLI::App& app, CommandLine& line) {
  const auto options = std::make_shared<ConformanceOptions>();
  addArgument(app, "engine", options->engine, "engine file of your own, or the name of an engine",
              "ENGINE.toml|NAME");
  addText(app, "--out", options->out,
          "folder for results.json, junit.xml and report.html; what is there is written anew",
          "FOLDER");
  addText(app, "-k", line.only,
          "only checks whose name contains this, or matches it where it has * or ?; several are "
          "separated by commas");
  addText(
      app, "--budget", options->budget,
      "start no further check after this time, e.g. 90s or 10m; checks not started give status 1",
      "TIME");
  addFlag(app, "--allow-unexamined", options->allowUnexamined,
          "status 0 even if less than 80 % of what the engine declares was examined");
  addFlag(app, "--json", line.json, "print results.json instead of text");
  addQuiet(app, line);
  return [&line, options] { return conformanceOf(line, *options); };
}

void printOption(const FoundOption& option) {
  const std::string found = fmt::format("{}", fmt::join(option.values, " | "));
  const std::string declared = option.declared.empty()
                                   ? "does not declare this option"
                                   : fmt::format("declares {}", fmt::join(option.declared, " | "));
  fmt::print("{:<19} {:<34} {}{}\n", option.name, found, declared,
             option.contradicts() ? "   <- not what was found" : "");
}

/// A plain sentence in place of tables where there is no mirror.
void print(const std::string& engine, const Identification& found) {
  fmt::print("{}: from {} starts, followed for {:.3g} ms\n", engine, found.starts,
             1e3 * found.time);
  if (found.closeEnough()) {
    for (const FoundOption& option : found.options) printOption(option);
    for (const FoundConstant& constant : found.constants)
      fmt::print("{:<19} {:+.4g} % of the case's   <- not the case's\n", constant.name,
                 100.0 * constant.change);
    if (!found.missing.empty() || !found.declaredMissing.empty())
      fmt::print("{:<19} {:<34} {}{}\n", "does not simulate",
                 orNone(found.missing, "(simulates all)"),
                 found.declaredMissing.empty()
                     ? "declares that it simulates all"
                     : fmt::format("declares {}", fmt::join(found.declaredMissing, ", ")),
                 found.missing == found.declaredMissing ? "" : "   <- not what was found");
  }
  fmt::print("largest separation: {:.2e} d from the case's own law, {:.2e} d from the {}\n",
             found.before, found.left,
             found.closeEnough() ? "closest mirror" : "nearest mirror tried, which is none");
}

int identifyEngine(const CommandLine& line) {
  if (line.run.engines.size() != 1 || line.run.engines.front() == "all")
    throw BadInput("identify takes one engine: --engines NAME");
  const Case setup = onlyFlow(line, "identify");
  const Identification found = runIdentify(setup, line.run);
  printNotes();
  print(line.run.engines.front(), found);
  return printOutcome(line, outcomeOf(found));
}

Action declareIdentify(CLI::App& app, CommandLine& line) {
  addCase(app, line);
  addEngines(app, line);
  addOverrides(app, line);
  addQuiet(app, line);
  return [&line] { return identifyEngine(line); };
}

}  // namespace

extern const Command compareCommand = {
    "compare", "run a case on several engines, average the results and compare them",
    "crossgrain compare cases/couette/quick.toml --engines grain,yade --out out/compare",
    [](CLI::App& app, CommandLine& line) {
      return declareStudy(app, line, compareStudy, {compareText});
    }};

extern const Command collideCommand = {
    "collide", "compare two-particle collisions with a high-precision solution",
    "crossgrain collide cases/collision/figure-4-3.toml --engines grain,yade --out out/collide\n"
    "crossgrain collide cases/collision -k glass --engines grain --out out/glass",
    [](CLI::App& app, CommandLine& line) {
      return declareStudy(app, line, collideStudy, {collideText});
    }};

extern const Command effectsCommand = {
    "effects", "measure what each effect of a case costs and what it changes",
    "crossgrain effects cases/couette/quick.toml --engines grain --out out/effects",
    [](CLI::App& app, CommandLine& line) {
      return declareStudy(app, line, effectsStudy, {effectsText, true});
    }};

extern const Command stabilityCommand = {
    "stability", "run hard cases: which engines stay stable, and which do not",
    "crossgrain stability --engines all --out out/stability    # all of cases/hard\n"
    "crossgrain stability -k pile --engines grain --out out/pile\n"
    "crossgrain stability cases/hard/pile.toml --engines grain,yade --out out/piles\n"
    "crossgrain stability --transforms cases/couette/quick.toml --engines grain,yade --out "
    "out/transforms\n"
    "crossgrain stability --transforms --budget 10m cases/couette/quick.toml --engines all --out "
    "out/brief",
    [](CLI::App& app, CommandLine& line) {
      return declareStudy(app, line, stabilityStudy, {stabilityText, true});
    }};

extern const Command lockstepCommand = {
    "lockstep",
    "check step by step, from equal states, that engines follow the laws that they declare",
    "crossgrain lockstep cases/couette/quick.toml --engines yade,box2d-penalty --out out/lockstep",
    [](CLI::App& app, CommandLine& line) {
      return declareStudy(app, line, lockstepStudy, {lockstepText});
    }};

extern const Command costCommand = {
    "cost",
    "measure error against time: settings of each engine, sizes of the scene, threads and ranks",
    "crossgrain cost cases/assembly/hopper.toml --engines grain,yade,lammps --out out/cost\n"
    "crossgrain cost cases/assembly/hopper.toml --engines all --out out/cost --want 1%\n"
    "crossgrain cost cases/space/shear-3d.toml --engines grain,lammps --disks 560,4480 --threads "
    "1,2 "
    "--out out/sizes",
    [](CLI::App& app, CommandLine& line) {
      return declareStudy(app, line, costStudy, {reports::costText, true, reports::costToml});
    }};

extern const Command averageCommand = {
    "average", "average snapshots, or result files of other programs, of one run or several",
    "crossgrain average out/compare/snapshots/grain-p0.h5 cases/couette/quick.toml --out "
    "out/averaged\n"
    "crossgrain average atoms-1.dump pairs-1.dump examples/import/box.toml --name my-lammps --out "
    "out/averaged\n"
    "crossgrain average out/compare/snapshots/grain-p0.h5 cases/couette/quick.toml --rev --out "
    "out/rev",
    [](CLI::App& app, CommandLine& line) -> Action {
      const auto own = std::make_shared<AverageOptions>();
      addStudy(app, line, averageStudy.takes, averageStudy.options(*own, line), {});
      return [&line, own] {
        return own->rev ? runStudy(revStudy, line, *own, {averagedText<RevResults>})
                        : runStudy(averageStudy, line, *own, {averagedText<CompareResults>});
      };
    }};

extern const Command conformanceCommand = {
    "conformance", "check that one engine does what it declares: properties, lockstep, collisions",
    "crossgrain conformance examples/python/engine.toml --out out/conformance\n"
    "crossgrain conformance yade -k Contacts\n"
    "crossgrain conformance yade --budget 10m --out out/law     # on a build server",
    declareConformance};

extern const Command identifyCommand = {
    "identify", "find which conventions and constants an engine uses, without its declaration",
    "crossgrain identify cases/couette/quick.toml --engines yade", declareIdentify};

}  // namespace crossgrain::inline cli
