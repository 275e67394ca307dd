#include "runs/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/bad_input.hpp"
#include "cases/couette.hpp"
#include "cases/files.hpp"
#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "runs/couette_run.hpp"
#include "runs/interrupt.hpp"
#include "runs/records.hpp"
#include "runs/task_pool.hpp"
#include "runs/version.hpp"

namespace crossgrain {

using nlohmann::json;

namespace {

double stepOf(const Case& setup) {
  if (setup.run.dt || !setup.particles.file) return timeStep(setup);
  throw BadInput(setup.file.string() + ": a packing file needs [run] dt, the time step in s");
}

}  // namespace

Campaign::Campaign(const Case& setup, const RunCommand& command, std::vector<EngineEntry> engines)
    : setup_(setup),
      command_(command),
      engines_(std::move(engines)),
      dt_(stepOf(setup)),
      store_(command.out),
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
    } catch (const UnsupportedScene& refusal) {
      // Asked for by name, a refusal is for the user to resolve; "all" means all that can.
      if (isNamed(command_.engines, entry)) throw;
      refusals_[e] = refusal.what();
    } catch (const EngineFailure& failure) {
      progress_.say(failure.what());  // its runs will tell, one by one
    }
  }
  if (!command_.resume) store_.startAfresh();
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

std::string Campaign::keyOf(std::size_t engine, int packing, const std::string& without) const {
  return fmt::format("{} | {} | {} | {} | {} | {}", programBuild, engines_[engine].name,
                     versions_[engine], packings_[static_cast<std::size_t>(packing)].hash,
                     setup_.resolvedToml, without);
}

namespace {

/// "grain", "grain without friction"
std::string labelOf(const EngineEntry& entry, const Leg& leg) {
  return leg.without.empty() ? entry.name : fmt::format("{} without {}", entry.name, leg.without);
}

std::string runName(const EngineEntry& entry, const Leg& leg, int packing) {
  return fmt::format("{}{}-p{}", entry.name, leg.without.empty() ? "" : "-without-" + leg.without,
                     packing);
}

}  // namespace

void Campaign::runOne(const Leg& leg, int packing, std::size_t task) {
  const EngineEntry& entry = engines_[leg.engine];
  const std::string name = runName(entry, leg, packing);
  const std::string key = keyOf(leg.engine, packing, leg.without);
  const std::string label = fmt::format("{} packing {}", labelOf(entry, leg), packing);
  json& result = runs_[task];
  result = {{"engine", entry.name}, {"packing", packing}, {"status", "missing"}, {"reason", ""}};
  if (const auto before = store_.find(name, key)) {
    result = *before;
    progress_.finish(task, label + ": finished in an earlier run");
    return;
  }
  try {
    const CouetteRun run{leg.setup,
                         entry,
                         packing,
                         &packings_[static_cast<std::size_t>(packing)],
                         dt_,
                         store_.scratch(name),
                         store_.snapshots(name),
                         store_.unfinished(name),
                         key};
    json finished =
        runCouette(run, [&](double fraction) { progress_.update(task, label, fraction); });
    if (!leg.without.empty()) finished["without"] = leg.without;
    store_.keep(name, key, finished);
    result = std::move(finished);
    progress_.finish(task,
                     fmt::format("{}: {:.1f} s", label, result["stats"]["wall_s"].get<double>()));
  } catch (const Interrupted&) {
    throw;
  } catch (const OutputError&) {
    throw;  // nothing more can be kept
  } catch (const std::exception& error) {
    result["status"] = "failed";
    result["reason"] = fmt::format("packing {}: {}", packing, error.what());
    if (!leg.without.empty()) result["without"] = leg.without;
    progress_.finish(task, fmt::format("{}: failed: {}", label, error.what()));
  }
}

std::vector<Leg> Campaign::wholeCase() const {
  std::vector<Leg> legs;
  for (std::size_t e = 0; e < engines_.size(); ++e)
    if (refusals_[e].empty()) legs.push_back({e, "", &setup_});
  return legs;
}

void Campaign::run(const std::vector<Leg>& legs) {
  std::vector<Task> tasks;
  std::vector<double> weights;
  for (const Leg& leg : legs)
    for (int k = 0; k < packingCount(); ++k) {
      const std::size_t task = tasks.size();
      tasks.push_back({predicted_[leg.engine], [this, &leg, k, task] { runOne(leg, k, task); }});
      weights.push_back(predicted_[leg.engine]);
    }
  runs_.resize(tasks.size());
  progress_.begin("running engines", weights);
  runTasks(tasks, command_.jobs);
}

void resumably(const std::function<void()>& work) {
  try {
    work();
  } catch (const Interrupted&) {
    throw Interrupted("interrupted; the same command with --resume takes up what is finished");
  }
}

}  // namespace crossgrain
