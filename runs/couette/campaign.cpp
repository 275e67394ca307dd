#include "runs/couette/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/couette.hpp"
#include "cases/preparation.hpp"
#include "cases/stable_step.hpp"
#include "cases/time_step.hpp"
#include "runs/common/records.hpp"
#include "runs/couette/run.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/interrupt.hpp"
#include "support/task_pool.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

namespace {

void requireStable(const Case& setup, double dt, std::optional<double> lightest = {}) {
  const char* const key = setup.run.dt ? "run.dt" : "run.steps_per_contact";
  if (const std::string why = whyUnstableStep(setup, dt, key, lightest); !why.empty())
    throw BadInput(fmt::format("{}: {}", setup.file.string(), why));
}

double stepOf(const Case& setup) {
  if (!setup.run.dt && setup.particles.file)
    throw BadInput(setup.file.string() + ": a packing file needs [run] dt, the time step in s");
  const double dt = timeStep(setup);
  requireStable(setup, dt);
  return dt;
}

}  // namespace

Campaign::Campaign(const Case& setup, const RunCommand& command, std::vector<EngineEntry> engines,
                   RunStore& store)
    : setup_(setup),
      command_(command),
      engines_(std::move(engines)),
      dt_(stepOf(setup)),
      store_(store),
      progress_(command.quiet),
      predicted_(engines_.size(), 1.0),
      versions_(engines_.size()),
      refusals_(engines_.size()),
      can_(engines_.size()),
      realised_(engines_.size()) {}

void Campaign::askEngines() {
  Packing unplaced;
  unplaced.disks = diskKinds(setup_.particles);
  const Scene scene = couetteScene(setup_, unplaced, dt_);
  for (std::size_t e = 0; e < engines_.size(); ++e) {
    throwIfInterrupted();
    const EngineEntry& entry = engines_[e];
    try {
      const auto engine =
          startEngine(entry, store_.scratch("ask-" + entry.name), setup_.run.timeout);
      const Capabilities can = engine->capabilities();
      versions_[e] = can.version;
      checkSuitable(can, entry, setup_, scene);
      if (command_.dryRun) can_[e] = can;
    } catch (const UnsupportedScene& refusal) {
      // Asked for by name, a refusal is for the user to resolve; "all" means all that can.
      if (isNamed(command_.engines, entry)) throw;
      refusals_[e] = refusal.what();
    } catch (const EngineFailure& failure) {
      progress_.say(failure.what());  // its runs will tell, one by one
    }
  }
}

void Campaign::preparePackings() {
  const int count = packingCount();
  packings_.resize(static_cast<std::size_t>(count));
  std::vector<std::string> failures(packings_.size());
  progress_.begin("preparing packings", std::vector<double>(packings_.size(), 1.0));
  std::vector<Task> tasks;
  for (int k = 0; k < count; ++k) {
    tasks.push_back({1.0, [this, k, &failures] {
                       const auto at = static_cast<std::size_t>(k);
                       const std::string label = fmt::format("packing {}", k);
                       try {
                         const auto engine = engineRegistry().front().make();
                         packings_[at] = packingOf(setup_, k, dt_, *engine, [&](double fraction) {
                           throwIfInterrupted();
                           progress_.update(at, label, fraction);
                         });
                         std::string line =
                             label + (packings_[at].fromCache ? ": from the cache" : ": prepared");
                         if (!packings_[at].notCached.empty())
                           line += ", not kept for next time: " + packings_[at].notCached;
                         progress_.finish(at, line);
                       } catch (const Interrupted&) {
                         throw;
                       } catch (const std::exception& error) {
                         failures[at] = error.what();
                       }
                     }});
  }
  runTasks(tasks, command_.jobs);
  for (const std::string& failure : failures)
    if (!failure.empty()) throw BadInput(failure);
  if (setup_.particles.file)  // whose disks may be lighter than the case says
    requireStable(setup_, dt_, std::ranges::min(packings_.front().disks.mass) / 2.0);
  store_.begin();
}

void Campaign::timeEngines() {
  constexpr int steps = 40;
  const double end =
      (setup_.averaging.settleRotations + setup_.averaging.rotations) * rotationTime(setup_);
  const Scene scene = couetteScene(setup_, packings_.front(), dt_);
  for (std::size_t e = 0; e < engines_.size(); ++e) {
    throwIfInterrupted();
    if (!refusals_[e].empty()) continue;
    try {
      const LoadedEngine loaded =
          loadEngine(engines_[e], setup_, scene, store_.scratch("time-" + engines_[e].name));
      const double dt = loaded.realised.dt;
      loaded.engine->advance(steps * dt);
      can_[e] = loaded.can;
      realised_[e] = loaded.realised;
      predicted_[e] = loaded.engine->stats().wallSeconds / steps * end / dt;
    } catch (const UnsupportedScene& refusal) {
      if (isNamed(command_.engines, engines_[e])) throw;
      refusals_[e] = refusal.what();
    } catch (const EngineFailure& failure) {
      progress_.say(failure.what());  // its runs will tell, one by one
    }
  }
}

CaseKeys Campaign::keyOf(std::size_t engine, int packing, const std::string& part) const {
  CaseKeys key = runKey(setup_, engines_[engine].name, versions_[engine]);
  key["packing"] = packings_[static_cast<std::size_t>(packing)].hash;
  if (!part.empty()) key["part"] = part;
  return key;
}

namespace {

/// "grain packing 0", "grain without friction packing 0"
std::string labelOf(const EngineEntry& entry, const Leg& leg, int packing) {
  return fmt::format("{}{} packing {}", entry.name,
                     leg.without.empty() ? "" : " without " + leg.without, packing);
}

std::string runName(const EngineEntry& entry, const Leg& leg, int packing) {
  return fmt::format("{}{}-p{}", entry.name, leg.without.empty() ? "" : "-without-" + leg.without,
                     packing);
}

}  // namespace

KeptTask::Outcome Campaign::runOne(const Leg& leg, int packing,
                                   const std::function<void(double)>& progress) const {
  const EngineEntry& entry = engines_[leg.engine];
  const std::string name = runName(entry, leg, packing);
  json result = {{"engine", entry.name}, {"packing", packing}};
  try {
    const CouetteRun run{leg.setup,
                         entry,
                         packing,
                         &packings_[static_cast<std::size_t>(packing)],
                         dt_,
                         store_.scratch(name),
                         store_.snapshots(name),
                         store_.unfinished(name),
                         json(keyOf(leg.engine, packing, leg.without)).dump()};
    result = runCouette(run, progress);
    if (!leg.without.empty()) result["without"] = leg.without;
    return {result, true, fmt::format("{:.1f} s", result["stats"]["wall_s"].get<double>())};
  } catch (const Interrupted&) {
    throw;
  } catch (const OutputError&) {
    throw;  // nothing more can be kept
  } catch (const std::exception& error) {
    result["status"] = "failed";
    result["reason"] = fmt::format("packing {}: {}", packing, error.what());
    if (!leg.without.empty()) result["without"] = leg.without;
    return {result, false, fmt::format("failed: {}", error.what())};
  }
}

std::vector<Leg> Campaign::wholeCase() const {
  std::vector<Leg> legs;
  for (std::size_t e = 0; e < engines_.size(); ++e)
    if (refusals_[e].empty()) legs.push_back({e, "", &setup_});
  return legs;
}

void Campaign::run(const std::vector<Leg>& legs) {
  runs_ = doOrTakeUp(tasksOf(legs), store_, progress_, "running engines", command_.jobs);
}

std::vector<KeptTask> Campaign::tasksOf(const std::vector<Leg>& legs) const {
  std::vector<KeptTask> tasks;
  for (const Leg& leg : legs)
    for (int k = 0; k < packingCount(); ++k)
      tasks.push_back({runName(engines_[leg.engine], leg, k), labelOf(engines_[leg.engine], leg, k),
                       keyOf(leg.engine, k, leg.without), predicted_[leg.engine],
                       [this, &leg, k](const std::function<void(double)>& progress) {
                         return runOne(leg, k, progress);
                       }});
  return tasks;
}

void Campaign::lookForPackings() {
  packings_.resize(static_cast<std::size_t>(packingCount()));
  for (std::size_t k = 0; k < packings_.size(); ++k) {
    Packing& packing = packings_[k];
    if (setup_.particles.file) {
      packing.hash = contentHash(readPacking(*setup_.particles.file, setup_));
      packing.fromCache = true;
    } else {
      packing.hash = packingHash(setup_, static_cast<int>(k), dt_);
      packing.fromCache = std::filesystem::exists(packingCacheFile(packing.hash));
    }
  }
}

std::string Campaign::planHead() const {
  return fmt::format("{}: {} packings, {} of them prepared already\n", setup_.name,
                     packings_.size(), std::ranges::count_if(packings_, &Packing::fromCache));
}

std::vector<PlannedWork> Campaign::plan(const std::vector<Leg>& legs) const {
  std::vector<PlannedWork> works;
  for (const Leg& leg : legs) {
    const EngineEntry& entry = engines_[leg.engine];
    PlannedWork work{entry.name + (leg.without.empty() ? "" : " without " + leg.without), "runs"};
    for (const KeptTask& task : tasksOf({leg})) count(work, store_.find(task.name, task.key));
    works.push_back(work);
  }
  for (std::size_t e = 0; e < engines_.size(); ++e)
    if (!refusals_[e].empty()) works.push_back({engines_[e].name, "runs", refusals_[e]});
  return works;
}

}  // namespace crossgrain::inline runs
