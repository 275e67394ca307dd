#include <fmt/format.h>

#include <fmt/ranges.h>
#include <algorithm>
#include <map>
#include <memory>

#include "cases/engine_file.hpp"
#include "cli/option_groups.hpp"
#include "cli/outcome.hpp"
#include "cli/study_text.hpp"
#include "reports/common/text.hpp"
#include "reports/conformance/report.hpp"
#include "reports/cost/report.hpp"
#include "reports/flow/report.hpp"
#include "reports/report.hpp"
#include "results/collision.hpp"
#include "studies/collide/collide.hpp"
#include "studies/conformance/conformance.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/mirrors.hpp"
#include "studies/core/study.hpp"
#include "studies/cost/cost.hpp"
#include "studies/effects/effects.hpp"
#include "studies/flow/average.hpp"
#include "studies/flow/compare.hpp"
#include "studies/flow/lockstep_job.hpp"
#include "studies/lockstep/identify.hpp"
#include "studies/stability/stability.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/terminal.hpp"

namespace crossgrain::inline cli {

namespace {

/// How results stand on a terminal, above the matrix that their report opens with.
template <typename Results>
struct Terminal {
  std::string (*text)(const Results&, bool verbose);
  bool timeSpent = false;
  /// Text that is printed in place of all that, to be pasted; empty: nothing is.
  std::string (*paste)(const Results&) = nullptr;
  /// Conclusion in place of the report's, unless somebody wants all.
  std::vector<std::string> (*conclusion)(const Results&) = nullptr;
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
  reports::Overview overview = writeReport(results, line.run.out).overview;
  if constexpr (requires { results.engines; })  // a mirror has a line where somebody wants all
    if (!line.verbose)
      std::erase_if(overview.rows, [&](const reports::OverviewRow& row) {
        return std::ranges::any_of(results.engines, [&](const EngineRow& engine) {
          return engine.name == row.name && !engine.mirrors.empty();
        });
      });
  if (terminal.conclusion && !line.verbose) overview.conclusion = terminal.conclusion(results);
  const std::string paste = terminal.paste && !line.json ? terminal.paste(results) : "";
  if (!paste.empty())
    printLines(stdout, paste);
  else
    printResults(line, line.json ? "" : terminal.text(results, line.verbose), overview,
                 terminal.timeSpent);
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

int conformanceOf(const CommandLine& line, const ConformanceOptions& options) {
  const EngineEntry entry = entryOf(options.engine);
  if (line.run.dryRun) {
    const std::vector<std::string> checks = conformanceChecks(line.only);
    printText(fmt::format("{} of {}: {}; nothing was run\n",
                          reports::counted(checks.size(), "check"), entry.name,
                          fmt::join(checks, ", ")));
    return exitPassed;
  }
  ConformanceTask task{entry, line.only, line.run.quiet, line.run.commandLine};
  if (options.budget) task.budget = secondsOf(*options.budget);
  if (options.out) makeDirectory(*options.out);  // before minutes of work that it is to hold
  const ConformanceResults results = runConformance(task);
  if (options.out) writeReport(results, *options.out);
  if (line.json)
    fmt::print("{}\n", toJson(results).dump());
  else
    printText(conformanceText(results, line.verbose));
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
  addFlag(app, "--dry-run", line.run.dryRun, "print which checks would run; run none");
  addQuiet(app, line);
  addVerbose(app, line);
  return [&line, options] { return conformanceOf(line, *options); };
}

int identifyEngine(const CommandLine& line) {
  if (line.run.engines.size() != 1 || line.run.engines.front() == "all")
    throw BadInput("identify takes one engine: --engines NAME");
  const Case setup = onlyFlow(line, {.command = "identify", .beginsFromGrain = true});
  if (line.run.dryRun)
    return printPlanned(line,
                        fmt::format("would identify the law of {} on {}",
                                    selectEngines(line.run.engines).front().name, setup.name));
  const Identification found = runIdentify(setup, line.run);
  printNotes();
  if (line.json)
    fmt::print("{}\n", jsonOf(found).dump(2));
  else
    printText(identifyText(line.run.engines.front(), found));
  return printOutcome(line, outcomeOf(found));
}

Action declareIdentify(CLI::App& app, CommandLine& line) {
  addCase(app, line);
  addEngines(app, line);
  addOverrides(app, line);
  addQuiet(app, line);
  addJson(app, line);
  addDryRun(app, line);
  return [&line] { return identifyEngine(line); };
}

}  // namespace

extern const Command compareCommand = {
    "compare", "run a case on several engines, average the results and compare them",
    "crossgrain compare cases/couette/quick.toml --engines grain,yade --out out/compare",
    [](CLI::App& app, CommandLine& line) {
      return declareStudy(app, line, compareStudy,
                          {.text = compareText, .conclusion = [](const CompareResults& results) {
                             return reports::compareConclusion(results, true);
                           }});
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
      return declareStudy(
          app, line, costStudy,
          {[](const CostResults& results, bool) { return reports::costText(results); }, true,
           reports::costToml});
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
        return own->rev ? runStudy(revStudy, line, *own, {revText})
                        : runStudy(averageStudy, line, *own, {averageText});
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
