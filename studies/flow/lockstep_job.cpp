#include "studies/flow/lockstep_job.hpp"

#include <fmt/format.h>

#include "adapters/suitability.hpp"
#include "cases/flow.hpp"
#include "cases/time_step.hpp"
#include "results/endpoints.hpp"
#include "results/lockstep_text.hpp"
#include "results/schema.hpp"
#include "studies/core/executor.hpp"
#include "studies/core/study.hpp"
#include "studies/lockstep/late_windows.hpp"
#include "studies/lockstep/lockstep.hpp"
#include "studies/lockstep/rules.hpp"
#include "studies/lockstep/starts.hpp"
#include "support/interrupt.hpp"
#include "support/scratch_folder.hpp"

namespace crossgrain::inline studies {

LockstepFindings lockstepOf(Campaign& campaign, const Case& setup, const RunCommand& command,
                            std::size_t starts,
                            const std::function<bool(const EngineEntry&)>& takesPart,
                            double budget) {
  std::vector<LockstepEngine> engines;
  for (std::size_t e = 0; e < campaign.engines().size(); ++e)
    if (campaign.refusal(e).empty() && takesPart(campaign.engines()[e]))
      engines.push_back({campaign.engines()[e], campaign.version(e)});
  if (engines.empty()) return {};
  const auto outOfTime = [&] {
    return campaign.elapsed() > budget
               ? fmt::format("not run: the budget of {:g} s was spent", budget)
               : std::string();
  };
  return holdAgainstMirrors(engines, setup,
                            {campaign.packings(), campaign.dt(), starts, command.jobs, outOfTime},
                            campaign.store(), campaign.progress());
}

std::vector<LateWindows> lateWindowsOf(Campaign& campaign, const Case& setup,
                                       const RunCommand& command,
                                       const std::vector<std::size_t>& engines) {
  const int packing = campaign.packings().size() > 1 ? 1 : 0;
  std::vector<CachedTask<LateWindows>> tasks;
  for (const std::size_t e : engines) {
    const EngineEntry& entry = campaign.engines()[e];
    CachedTask<LateWindows> task;
    task.name = "late-" + entry.name;
    task.label = entry.name;
    task.key = campaign.keyOf(e, packing, "late windows");
    task.work = [&campaign, &setup, &entry, packing](const std::function<void(double)>& progress) {
      LateWindows found;
      bool finished = true;
      try {
        const auto worker =
            startAudited(entry, campaign.store().scratch("late-" + entry.name), setup.run.timeout);
        found = followLate(*worker, entry, setup,
                           campaign.packings()[static_cast<std::size_t>(packing)], packing,
                           campaign.dt(), lateWindowsMeasured, progress);
      } catch (const EngineFailure& failure) {
        found.failure = failure.what();
        found.packing = packing;
        finished = false;
      }
      const std::string line =
          found.failure.empty() ? fmt::format("{} windows", found.times.size()) : found.failure;
      return CachedTask<LateWindows>::Outcome{std::move(found), finished, line};
    };
    tasks.push_back(std::move(task));
  }
  return runOrLoad(tasks, campaign.store(), campaign.progress(), "windows late in own runs",
                   command.jobs);
}

Identification runIdentify(const Case& setup, const RunCommand& command) {
  checkEngineSections(setup);
  const EngineEntry entry = selectEngines(command.engines).front();
  const ScratchFolder scratch;
  const auto engine = startEngine(entry, scratch.path, setup.run.timeout);
  if (!hasNormalLaw(engine->capabilities(), setup.law))
    throw UnsupportedScene(
        fmt::format("{} {}", entry.name, noMirrorReason(entry, engine->capabilities(), setup)));
  const double dt = timeStep(setup);
  Progress progress(command.quiet);
  progress.begin("identifying " + entry.name, {1.0});
  const auto inHouse = engineRegistry().front().make();
  const auto packing = flowPacking(setup, 0, dt, *inHouse, [&](double fraction) {
    throwIfInterrupted();
    progress.update(0, "preparing a packing", fraction);
  });
  const auto states = statesAlongTheFlow(setup, {packing}, dt, identifyStarts, [](double) {});
  return identify(*engine, entry, setup, states, dt,
                  [&](double fraction) { progress.update(0, entry.name, fraction); });
}

namespace {

std::size_t startsOf(const CommandLine& line, const LockstepOptions& own) {
  if (!own.starts) return line.quick ? quickLockstepStarts : lockstepStarts;
  return static_cast<std::size_t>(wholeNumberOf("--starts", *own.starts, 1.0, 10000.0));
}

std::vector<Case> caseForLockstep(const CommandLine& line, LockstepOptions& own) {
  startsOf(line, own);  // throws for what is none
  return {onlyFlow(line, {"lockstep"})};
}

std::string lockstepPlan(const StudyWork& work, const LockstepOptions& own) {
  const Case& setup = work.setup();
  checkEngineSections(setup);
  Campaign campaign(setup, work.line.run, selectEngines(work.line.run.engines), work.store);
  campaign.askEngines();
  campaign.lookForPackings();
  std::vector<PlannedWork> works;
  for (std::size_t e = 0; e < campaign.engines().size(); ++e) {
    PlannedWork planned{campaign.engines()[e].name, "windows", campaign.refusal(e)};
    const auto& can = campaign.capabilities(e);
    if (can && planned.refusal.empty())
      planned.refusal = noMirrorReason(campaign.engines()[e], *can, setup);
    if (planned.refusal.empty()) planned.total = startsOf(work.line, own);
    works.push_back(planned);
  }
  return describeDryRun(campaign.planHead(), works, work.store, work.line.run);
}

LockstepResults lockstep(const StudyWork& work, const LockstepOptions& own) {
  const Case& setup = work.setup();
  checkEngineSections(setup);
  Campaign campaign(setup, work.line.run, selectEngines(work.line.run.engines), work.store);
  campaign.askEngines();
  campaign.preparePackings();
  LockstepFindings findings = lockstepOf(campaign, setup, work.line.run, startsOf(work.line, own),
                                         [](const EngineEntry&) { return true; });
  LockstepResults results{campaign.study(kindLockstep), std::move(findings)};
  for (EngineRow& engine : results.engines)
    for (const LockstepRow& row : results.lockstep.rows)
      if (row.engine == engine.name && !row.failure.empty()) {
        engine.status = Status::failed;
        engine.reason = row.failure;
      }
  return results;
}

Outcome outcomeOfLockstep(const LockstepResults& results, const CommandLine& line,
                          const LockstepOptions& own) {
  bool judged = false, failed = false;
  Outcome outcome{exitPassed, refusals(results.engines, line.run.engines)};
  for (const LockstepRow& row : results.lockstep.rows) {
    judged |= row.verdict != Equivalence::notMeasured;
    const bool open = !openInLaw(row, results.lockstep.rules).empty();
    if (row.verdict == Equivalence::differs && !open)
      outcome.fails.push_back(row.engine + " differs from the law that it declares");
    if (own.strict && open) outcome.fails.push_back("--strict: " + row.engine + " is borderline");
    if (own.strict && row.verdict == Equivalence::undecided)
      outcome.fails.push_back("--strict: " + row.engine + " is undecided");
    if (row.failure.empty()) continue;
    outcome.failures.push_back(row.failure);
    failed = true;
  }
  if (failed)
    outcome.status = exitEngineFailed;
  else if (!judged) {
    outcome.status = exitFailed;
    outcome.nothingJudged = "no engine here has a mirror in this scene";
  } else if (!outcome.fails.empty())
    outcome.status = exitFailed;
  return outcome;
}

}  // namespace

const Study<LockstepOptions, LockstepResults> lockstepStudy = {
    "lockstep",
    {.packings = true},
    Keeps::oneCase,
    [](LockstepOptions& own, CommandLine&) {
      return std::vector<StudyOption>{
          {"--starts", "states of the flow to start from; 16 unless given, 4 with --quick",
           &own.starts},
          {"--strict", "status 1 also for an engine that is undecided or borderline", &own.strict}};
    },
    caseForLockstep,
    lockstepPlan,
    lockstep,
    outcomeOfLockstep};

}  // namespace crossgrain::inline studies
