#include "runs/collide.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "adapters/law_options.hpp"
#include "cases/bad_input.hpp"
#include "cases/time_step.hpp"
#include "runs/collision_sweep.hpp"
#include "runs/interrupt.hpp"
#include "runs/progress.hpp"
#include "runs/records.hpp"
#include "runs/run_store.hpp"
#include "runs/task_pool.hpp"

namespace crossgrain {

using nlohmann::json;

namespace {

json lawJson(const ContactLaw& law) {
  json options;
  for (const LawOption& option : lawOptions())
    options[std::string(option.name)] = option.values[option.get(law)];
  options.update({{"kn", law.kn},
                  {"kn3", law.kn3},
                  {"gn", law.gn},
                  {"kt", law.kt},
                  {"gt", law.gt},
                  {"mu", law.mu}});
  if (law.normal == NormalLaw::rigid) options.update({{"e_n", law.en}, {"e_t0", law.et0}});
  return options;
}

/// The oracle on a grid fine enough for a smooth line, about 80 points, at the first v_n.
json fineOracle(const Case& setup) {
  const auto& psi = setup.collision.psi;
  const auto parts = std::max<std::size_t>(1, 80 / psi.size());
  std::vector<CollisionStart> starts;
  Case one = setup;
  for (std::size_t k = 0; k < psi.size(); ++k)
    for (std::size_t part = 0; part < (k + 1 < psi.size() ? parts : 1); ++part) {
      const double next = k + 1 < psi.size() ? psi[k + 1] : psi[k];
      const double share = static_cast<double>(part) / static_cast<double>(parts);
      one.collision.psi = {psi[k] + (next - psi[k]) * share};
      starts.push_back(collisionStarts(one).front());
    }
  return columnsOf(starts, outcomesOf(oracleCurve(setup, starts)));
}

struct Sweep {
  const Case* setup;
  std::vector<CollisionStart> starts;
  OracleCurve oracle;
  std::vector<double> steps;

  /// Whether an engine takes part: mirrors only where the case wants them.
  bool wants(const EngineEntry& entry, const std::vector<std::string>& named) const {
    if (entry.mirrors.empty() || isNamed(named, entry)) return true;
    return setup->run.mirrors && standsForItsPeer(entry, setup->law);
  }
};

/// The engines of any of the cases, those named first. @throws BadInput
std::vector<EngineEntry> enginesForAny(const std::vector<Case>& variants,
                                       const std::vector<std::string>& names) {
  std::vector<EngineEntry> engines = selectEngines(names);
  for (const Case& setup : variants) checkEngineSections(setup);
  if (std::ranges::any_of(variants, [](const Case& setup) { return setup.run.mirrors; }))
    for (const EngineEntry& mirror : mirrorsOf(engines)) engines.push_back(mirror);
  return engines;
}

/// All sweeps of one engine in one worker. Failures end up in the curve that failed; the worker is
/// started again for the next one. @throws BadInput, Interrupted
void runEngine(const EngineEntry& entry, const std::vector<Sweep>& sweeps,
               const std::vector<std::string>& named, const RunStore& store,
               const std::function<void(double)>& progress, std::vector<json>& curves) {
  std::unique_ptr<Engine> engine;
  std::size_t total = 0, done = 0, planned = 0;
  for (const Sweep& sweep : sweeps)
    if (sweep.wants(entry, named)) total += sweep.steps.size();
  for (const Sweep& sweep : sweeps) {
    json list = json::array();
    const std::vector<double> steps =
        sweep.wants(entry, named) ? sweep.steps : std::vector<double>();
    planned += steps.size();
    for (const double dt : steps) {
      throwIfInterrupted();
      try {
        if (!engine)
          engine = startEngine(entry, store.scratch(entry.name), sweep.setup->run.timeout);
        json curve = runSweep(*engine, entry, *sweep.setup, dt, sweep.starts, sweep.oracle,
                              dt == std::ranges::max(steps));
        // An engine that keeps its own step has nothing new to say at another of the case's.
        const bool known = std::ranges::any_of(
            list, [&](const json& earlier) { return earlier["dt"] == curve["dt"]; });
        if (!known) list.push_back(std::move(curve));
      } catch (const Interrupted&) {
        throw;
      } catch (const BadInput&) {
        throw;
      } catch (const std::exception& error) {
        const bool refused = dynamic_cast<const UnsupportedScene*>(&error) != nullptr;
        list.push_back({{"engine", entry.name},
                        {"dt", dt},
                        {"steps_per_contact", nullptr},
                        {"status", refused ? "refused" : "failed"},
                        {"reason", error.what()},
                        {"realised", nullptr},
                        {"points", json::object()},
                        {"score", noScore()}});
        if (!refused) engine.reset();
        // What a law lacks, it lacks at every time step.
        if (refused) break;
      }
      progress(static_cast<double>(++done) / static_cast<double>(total));
    }
    done = planned;
    curves.push_back(std::move(list));
  }
}

/// An engine that can run no variant at all was asked for in vain.
void throwIfAllRefused(const std::vector<json>& curves) {
  std::string reason;
  for (const json& list : curves)
    for (const json& curve : list) {
      if (curve["status"] != "refused") return;
      reason = curve["reason"];
    }
  throw UnsupportedScene(reason);
}

json variantJson(const Sweep& sweep) {
  const Case& setup = *sweep.setup;
  const CollidingPair pair = collidingPair(setup);
  return {{"case", setup.name},
          {"variant", setup.variant.empty() ? setup.name : setup.variant},
          {"law", lawJson(setup.law)},
          {"e_n_closed", toJson(closedRestitution(setup.law, pair.reducedMass()))},
          {"sticking", {{"e_t0", setup.law.soft() ? json(nullptr) : json(setup.law.et0)}}},
          {"sliding_constant", toJson(slidingConstant(setup.law, pair))},
          {"oracle", fineOracle(setup)},
          {"oracle_reason", sweep.oracle.reason},
          {"reference", columnsOf(sweep.starts, outcomesOf(sweep.oracle))},
          {"curves", json::array()}};
}

}  // namespace

json collideEngines(const std::vector<Case>& variants, const RunCommand& command) {
  const auto started = std::chrono::steady_clock::now();
  const std::vector<EngineEntry> engines = enginesForAny(variants, command.engines);
  for (const EngineEntry& entry : engines)
    if (entry.missing && !entry.missing().empty())
      startEngine(entry, {}, 1.0);  // throws, saying why
  const RunStore store(command.out);
  Progress progress(command.quiet);

  std::vector<Sweep> sweeps;
  for (const Case& setup : variants) {
    throwIfInterrupted();
    Sweep sweep{&setup, collisionStarts(setup), {}, collisionTimeSteps(setup)};
    sweep.oracle = oracleCurve(setup, sweep.starts);
    sweeps.push_back(std::move(sweep));
  }

  std::vector<std::vector<json>> curves(engines.size());
  std::vector<Task> tasks;
  progress.begin("collisions", std::vector<double>(engines.size(), 1.0));
  for (std::size_t e = 0; e < engines.size(); ++e) {
    // Workers in another language start slowly, so they go first.
    tasks.push_back({engines[e].command ? 2.0 : 1.0, [&, e] {
                       runEngine(
                           engines[e], sweeps, command.engines, store,
                           [&](double f) { progress.update(e, engines[e].name, f); }, curves[e]);
                       progress.finish(e, engines[e].name + ": done");
                     }});
  }
  runTasks(tasks, command.jobs);
  for (std::size_t e = 0; e < engines.size(); ++e)
    if (isNamed(command.engines, engines[e])) throwIfAllRefused(curves[e]);

  json results = resultsHead("collide", variants.front(), command.commandLine);
  results["case"]["variant"] = "";
  results["variants"] = json::array();
  results["orders"] = json::array();
  for (std::size_t s = 0; s < sweeps.size(); ++s) {
    json variant = variantJson(sweeps[s]);
    for (std::size_t e = 0; e < engines.size(); ++e) {
      std::vector<const json*> list;
      for (const json& curve : curves[e][s]) list.push_back(&curve);
      if (auto order = convergenceOrder(list)) {
        (*order)["case"] = variant["case"];
        (*order)["variant"] = variant["variant"];
        results["orders"].push_back(*order);
      }
      for (const json& curve : curves[e][s]) variant["curves"].push_back(curve);
    }
    results["variants"].push_back(std::move(variant));
  }
  results["engines"] = json::array();
  for (std::size_t e = 0; e < engines.size(); ++e) {
    // Refusing some variants is no failure; the curves say which.
    std::string status = "ran", reason, version;
    for (const json& list : curves[e])
      for (const json& curve : list) {
        if (curve["status"] == "failed") {
          status = "failed";
          reason = curve["reason"];
        }
        if (curve["realised"].is_object()) version = curve["realised"]["version"];
      }
    results["engines"].push_back({{"name", engines[e].name},
                                  {"summary", engines[e].summary},
                                  {"version", version},
                                  {"mirrors", engines[e].mirrors},
                                  {"status", status},
                                  {"reason", reason}});
  }
  results["elapsed_s"] =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return results;
}

}  // namespace crossgrain
