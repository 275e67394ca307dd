#include "runs/compare.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "cases/bad_input.hpp"
#include "cases/couette.hpp"
#include "cases/files.hpp"
#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "runs/agreement_table.hpp"
#include "runs/couette_run.hpp"
#include "runs/interrupt.hpp"
#include "runs/progress.hpp"
#include "runs/records.hpp"
#include "runs/run_store.hpp"
#include "runs/task_pool.hpp"
#include "runs/velocity_notes.hpp"
#include "runs/version.hpp"

namespace crossgrain {

using nlohmann::json;

namespace {

/// One `compare`: what it runs, and what has come of it so far.
class Comparison {
 public:
  Comparison(const Case& setup, const RunCommand& command);

  /// Asks every engine, before anything is computed, whether it can run the case.
  void askEngines();
  void preparePackings();
  /// Times some steps of every engine on the first packing, so that the longest runs start first.
  void timeEngines();
  void run();
  json results() const;

 private:
  /// A file is one packing, however many a case would prepare.
  int packingCount() const { return setup_.particles.file ? 1 : setup_.preparation.packings; }
  std::string runName(const EngineEntry& entry, int packing) const {
    return fmt::format("{}-p{}", entry.name, packing);
  }
  std::string runKey(const EngineEntry& entry, int packing) const;
  void runOne(std::size_t engine, int packing, std::size_t task);
  std::vector<ComparedPair> pairs() const;
  json cellJson() const;

  const Case& setup_;
  const RunCommand& command_;
  std::vector<EngineEntry> engines_;  ///< those named, then their mirrors
  double dt_;
  RunStore store_;
  Progress progress_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
  std::vector<double> predicted_;  ///< seconds of one run, per engine
  std::vector<std::string> versions_, refusals_;
  std::vector<Packing> packings_;
  std::vector<json> runs_;  ///< engine by engine, packing by packing
};

double stepOf(const Case& setup) {
  if (setup.run.dt || !setup.particles.file) return timeStep(setup);
  throw BadInput(setup.file.string() + ": a packing file needs [run] dt, the time step in s");
}

Comparison::Comparison(const Case& setup, const RunCommand& command)
    : setup_(setup),
      command_(command),
      engines_(enginesFor(setup, command.engines)),
      dt_(stepOf(setup)),
      store_(command.out),
      progress_(command.quiet),
      predicted_(engines_.size(), 1.0),
      versions_(engines_.size()),
      refusals_(engines_.size()) {}

void Comparison::askEngines() {
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

void Comparison::preparePackings() {
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

void Comparison::timeEngines() {
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
      predicted_[e] = loaded.engine->stats().wallSeconds / steps * end / dt;
    } catch (const UnsupportedScene& refusal) {
      if (isNamed(command_.engines, engines_[e])) throw;
      refusals_[e] = refusal.what();
    } catch (const EngineFailure& failure) {
      progress_.say(failure.what());  // its runs will tell, one by one
    }
  }
}

std::string Comparison::runKey(const EngineEntry& entry, int packing) const {
  return fmt::format("{} | {} | {} | {} | {}", programBuild, entry.name,
                     versions_[static_cast<std::size_t>(&entry - engines_.data())],
                     packings_[static_cast<std::size_t>(packing)].hash, setup_.resolvedToml);
}

void Comparison::runOne(std::size_t engine, int packing, std::size_t task) {
  const EngineEntry& entry = engines_[engine];
  const std::string name = runName(entry, packing);
  const std::string label = fmt::format("{} packing {}", entry.name, packing);
  json& result = runs_[task];
  result = {{"engine", entry.name}, {"packing", packing}, {"status", "missing"}, {"reason", ""}};
  if (const auto before = store_.find(name, runKey(entry, packing))) {
    result = *before;
    progress_.finish(task, label + ": finished in an earlier run");
    return;
  }
  try {
    const CouetteRun run{&setup_,
                         entry,
                         packing,
                         &packings_[static_cast<std::size_t>(packing)],
                         dt_,
                         store_.scratch(name),
                         store_.snapshots(name),
                         store_.unfinished(name),
                         runKey(entry, packing)};
    json finished =
        runCouette(run, [&](double fraction) { progress_.update(task, label, fraction); });
    store_.keep(name, runKey(entry, packing), finished);
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
    progress_.finish(task, fmt::format("{}: failed: {}", label, error.what()));
  }
}

void Comparison::run() {
  std::vector<Task> tasks;
  std::vector<double> weights;
  for (std::size_t e = 0; e < engines_.size(); ++e) {
    if (!refusals_[e].empty()) continue;
    for (int k = 0; k < packingCount(); ++k) {
      const std::size_t task = tasks.size();
      tasks.push_back({predicted_[e], [this, e, k, task] { runOne(e, k, task); }});
      weights.push_back(predicted_[e]);
    }
  }
  runs_.resize(tasks.size());
  progress_.begin("running engines", weights);
  runTasks(tasks, command_.jobs);
}

/// All pairs of the engines named, in the order in which they were named. A mirror that came along
/// stands between the in-house engine, which it is but for its conventions, and its peer.
std::vector<ComparedPair> Comparison::pairs() const {
  const auto named = [&](const EngineEntry& entry) {
    return entry.mirrors.empty() || isNamed(command_.engines, entry);
  };
  std::vector<ComparedPair> pairs;
  for (std::size_t a = 0; a < engines_.size(); ++a)
    for (std::size_t b = a + 1; b < engines_.size(); ++b)
      if (named(engines_[a]) && named(engines_[b]))
        pairs.push_back({engines_[a].name, engines_[b].name, "peer"});
  for (const EngineEntry& mirror : engines_) {
    if (named(mirror)) continue;
    pairs.push_back({engineRegistry().front().name, mirror.name, "mirror_model"});
    pairs.push_back({mirror.name, mirror.mirrors, "mirror_implementation"});
  }
  return pairs;
}

json Comparison::cellJson() const {
  const Cell& cell = setup_.cell;
  const Disks& disks = packings_.front().disks;
  const auto small = std::ranges::count(disks.radius, setup_.particles.smallRadius);
  double diskArea = 0.0;
  for (const double a : disks.radius) diskArea += a * a;
  const double cellArea = cell.outerRadius * cell.outerRadius - cell.innerRadius * cell.innerRadius;
  return {{"inner_radius", cell.innerRadius},
          {"outer_radius", cell.outerRadius},
          {"wall_radius", cell.wallRadius},
          {"wall_spacing", cell.wallSpacing},
          {"height", cell.height},
          {"omega", cell.omega},
          {"small", small},
          {"large", static_cast<std::ptrdiff_t>(disks.size()) - small},
          {"small_radius", setup_.particles.smallRadius},
          {"large_radius", setup_.particles.largeRadius},
          {"volume_fraction", diskArea / cellArea},
          {"diameter", 2.0 * setup_.particles.smallRadius}};
}

json Comparison::results() const {
  json results = resultsHead("compare", setup_, command_.commandLine);
  results["cell"] = cellJson();
  const Averaging& averaging = setup_.averaging;
  results["averaging"] = {
      {"method", averaging.methods.front()},
      {"settle_rotations", averaging.settleRotations},
      {"rotations", averaging.rotations},
      {"snapshots", std::lround(averaging.snapshotsPerRotation * averaging.rotations)},
      {"confidence", averaging.confidence}};
  const Scene scene = couetteScene(setup_, packings_.front(), dt_);
  for (const Effect effect : effectsOf(scene)) results["effects"].push_back(toString(effect));

  std::vector<std::string> names;
  results["engines"] = json::array();
  for (std::size_t e = 0; e < engines_.size(); ++e) {
    names.push_back(engines_[e].name);
    std::string status = refusals_[e].empty() ? "ran" : "refused", reason = refusals_[e];
    for (const json& run : runs_)
      if (run["engine"] == engines_[e].name && run["status"] == "failed" && reason.empty()) {
        status = "failed";
        reason = run["reason"];
      }
    results["engines"].push_back({{"name", engines_[e].name},
                                  {"summary", engines_[e].summary},
                                  {"version", versions_[e]},
                                  {"mirrors", engines_[e].mirrors},
                                  {"status", status},
                                  {"reason", reason}});
  }

  const Rings rings = ringsOf(setup_);
  for (int ring = 0; ring < rings.count(); ++ring) {
    results["rings"]["r"].push_back(rings.centre(ring));
    results["rings"]["r_tilde"].push_back(rings.rTilde(ring));
  }
  results["rings"]["width"] = rings.edge(1) - rings.edge(0);
  for (std::size_t k = 0; k < packings_.size(); ++k)
    results["packings"].push_back({{"index", k},
                                   {"seed", packingSeed(setup_, static_cast<int>(k))},
                                   {"hash", packings_[k].hash},
                                   {"from_cache", packings_[k].fromCache}});
  results["runs"] = runs_;
  results["ensemble"] = ensembleOf(results["runs"], names);
  results["agreement"] = agreementOf(setup_, results["runs"], pairs());
  results["notes"] = velocityNotes(results);
  const bool all = std::ranges::find(command_.engines, "all") != command_.engines.end();
  for (const EngineEntry& entry : engineRegistry())
    if (all && entry.missing && !entry.missing().empty())
      results["notes"].push_back(
          fmt::format("{} was left out: it is not installed ({}).", entry.name, entry.missing()));
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - started_;
  results["elapsed_s"] = elapsed.count();
  return results;
}

}  // namespace

json compareEngines(const Case& setup, const RunCommand& command) {
  Comparison comparison(setup, command);
  try {
    comparison.askEngines();
    comparison.preparePackings();
    comparison.timeEngines();
    comparison.run();
  } catch (const Interrupted&) {
    throw Interrupted("interrupted; the same command with --resume takes up what is finished");
  }
  return comparison.results();
}

}  // namespace crossgrain
