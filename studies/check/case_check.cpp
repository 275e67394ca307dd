#include "studies/check/case_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "averaging/fields.hpp"
#include "cases/assembly_scene.hpp"
#include "cases/case_keys.hpp"
#include "cases/cautions.hpp"
#include "cases/collision_scene.hpp"
#include "cases/couette.hpp"
#include "cases/endpoints.hpp"
#include "cases/flow.hpp"
#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "studies/collide/sweep.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/engine_running.hpp"
#include "studies/flow/endpoint_table.hpp"
#include "studies/flow/run.hpp"
#include "support/bad_input.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline studies {

using nlohmann::json;

namespace {

/// The scene that engines are timed on, and asked about.
template <int D>
struct Probe {
  SceneOf<D> scene;
  std::string timedOn = {};  ///< where its bodies are; empty: nothing to be timed
  bool prepared = true;      ///< whether packings need no preparing any more
};

/// A Couette cell with the disks of its file, of its first packing if that is cached, or made up.
Probe<2> cellProbe(const Case& setup, double dt) {
  if (packingFile(setup)) {
    const auto none = engineRegistry().front().make();  // a file needs no preparing
    const Packing packing = packingOf(setup, 0, dt, *none, [](double) {});
    return {couetteScene(setup, packing, dt), "the packing of the file"};
  }
  const std::string hash = packingHash(setup, 0, dt);
  std::string unusable;  // those who need the packing prepare it anew
  if (const auto kept = keptPacking(packingCacheFile(hash), hash, setup, unusable))
    return {couetteScene(setup, *kept, dt), "packing 0, from the cache"};
  return {couetteScene(setup, madeUpPacking(setup), dt),
          "a made-up square lattice, four contacts a disk", false};
}

/// The scene with the case's disks, where those of the probe were made smaller to have room: what
/// engines say of a scene goes by sizes.
template <int D>
SceneOf<D> askedScene(const Case& setup, const Probe<D>& probe) {
  SceneOf<D> asked = probe.scene;
  if constexpr (D == 2)
    if (!probe.prepared) {
      const Disks kinds = diskKinds(couetteIn(setup).particles);
      asked.disks.radius = kinds.radius;
      asked.disks.inertia = kinds.inertia;
    }
  return asked;
}

/// A flow as the in-house engine has it halfway through, or after a second of its time: at its
/// start nothing may touch, and steps are cheaper there than they will be.
template <int D>
Probe<D> underWay(const Case& setup, double dt) {
  constexpr double enough = 1.0;  // [s]
  const auto engine = engineRegistry().front().make();
  const Packing start = flowPacking(setup, 0, dt, *engine, [](double) {});
  const SceneOf<D> scene = flowScene<D>(setup, start, dt);
  const double half = flowRestart(setup, 0.5 * flowDuration(setup));
  double reached = 0.0;
  try {
    loadOn(*engine, scene, {});
    for (int pieces = 64, k = 1; k <= pieces && engine->stats().cpuSeconds < enough; ++k) {
      throwIfInterrupted();
      reached = flowRestart(setup, half * k / pieces);
      engine->advance(reached);
    }
    const SnapshotOf<D> now = snapshotOf<D>(*engine, ContactReport::none);
    return {flowScene<D>(setup, packingAt(start, scene, now), dt),
            fmt::format("the flow at t = {:.3g} s", reached)};
  } catch (const UnsupportedScene&) {  // is said of the engine itself, as is what fails
  } catch (const EngineFailure&) {
  }
  return {scene, "the start of the flow"};
}

template <int D>
Probe<D> probeOf(const Case& setup, bool timed) {
  const double dt = timeStep(setup);
  if constexpr (D == 2)
    if (cellOf(setup)) return cellProbe(setup, dt);
  if (!isCollision(setup))
    return timed && hasFlow(setup) ? underWay<D>(setup, dt) : Probe<D>{assemblyScene<D>(setup)};
  if constexpr (D == 2)
    return {collisionScene(setup, collisionStarts(setup), dt)};
  else
    return {spaceCollisionScene(setup, collisionStarts(setup), dt)};
}

/// Beyond what a contact bears, as the commands refuse it; hard cases may go there.
/// @param lightest  pair of a cell; an assembly's disks are all in its case
void requireStableStep(const Case& setup, const std::optional<LightestPair>& lightest) {
  if (!hasFlow(setup)) return;
  const char* const key = setup.run.dt ? "run.dt" : "run.steps_per_contact";
  const std::string why = unstableStepFault(setup, timeStep(setup), key, lightest);
  if (!why.empty()) throw BadInput(fmt::format("{}: {}", whereSaid(setup, key), why));
}

double stepsOf(const Case& setup, double dt) {
  return flowDuration(setup) / dt;
}

/// Time of a step on a machine that does nothing else [s]: others lengthen the wall time, an
/// engine's own threads the processor time.
double alone(const StepCost& step) {
  return std::min(step.wall, step.processor);
}

template <int D>
json suitability(const EngineEntry& entry, const Case& setup, const SceneOf<D>& asked,
                 const SceneOf<D>& scene, bool timed, const std::filesystem::path& scratch) {
  json row = {
      {"name", entry.name}, {"mirrors", entry.mirrors},    {"can", true},
      {"reason", ""},       {"deviations", json::array()}, {"not_simulated", json::array()}};
  try {
    // Times and memory are those of a process that does nothing else.
    const auto engine = timed ? startNew(entry, scratch, setup.run.timeout)
                              : startEngine(entry, scratch, setup.run.timeout);
    checkSuitable(*engine, entry, setup, asked);
    const Suitability found = suitabilityOf(*engine, entry, setup, asked);
    row["deviations"] = found.deviations;
    row["not_simulated"] = found.notSimulated;
    if (found.dt) row["dt_s"] = *found.dt;
    if (!timed) return row;
    const EffectiveParameters effective = loadScene(*engine, entry, setup, scene);
    const StepCost step = briefSteps(*engine, effective.dt);
    const auto memory = mostMemoryOf(*engine);
    row["dt_s"] = effective.dt;
    row["step_s"] = alone(step);
    row["timed_steps"] = step.steps;
    row["memory_bytes"] = memory ? json(*memory) : json(nullptr);
    row["run_s"] = alone(step) * stepsOf(setup, effective.dt);
  } catch (const UnsupportedScene& refusal) {
    row["can"] = false;
    row["reason"] = refusal.what();
  } catch (const EngineFailure& failure) {
    row["can"] = false;
    row["failed"] = true;
    row["reason"] = failure.what();
  }
  return row;
}

json cellFigures(const Case& setup, const Scene& scene, double fraction) {
  const double bulk = bulkVolumeFraction(setup, fraction);
  const auto number = [](const std::optional<double>& x) { return x ? json(*x) : json(nullptr); };
  const auto disks = static_cast<double>(scene.disks.size());
  return {{"volume_fraction", fraction},
          {"bulk_volume_fraction", bulk},
          {"expected_pressure", number(expectedPressure(setup, bulk))},
          {"expected_inertial_number", number(expectedInertialNumber(setup, bulk))},
          // Rough disks in a flow have three to four contacts; a gas has fewer than one.
          {"expected_contacts",
           bulk < dilutedBelow ? json{0.0, disks} : json{1.5 * disks, 2.0 * disks}},
          {"wheel_disks", scene.bodies.front().diskRadius.size()},
          {"ring_disks", scene.bodies.back().diskRadius.size()},
          {"packings", flowPackings(setup)},
          {"looks", interimPlanOf(setup).packings},
          {"rotations", couetteIn(setup).times.settleRotations + couetteIn(setup).times.rotations},
          {"steps", stepsOf(setup, scene.dt)}};
}

/// Those of what is listed that has one, in that order; each named under `what`.
json marginsOf(const auto& list, const std::map<std::string, Margin>& margins, const char* what) {
  json rows = json::array();
  for (const auto& judged : list) {
    const auto found = margins.find(std::string(judged.name));
    if (found == margins.end()) continue;
    const Margin& margin = found->second;
    rows.push_back({{what, judged.name},
                    {"value", margin.value},
                    {"relative", margin.relative},
                    {"unit", margin.relative || judged.unit == "-" || judged.unit == "1"
                                 ? ""
                                 : std::string(judged.unit)},
                    {"of", margin.scale},
                    {"why", margin.why}});
  }
  return rows;
}

/// Preparing and running, engines one after the other [s].
template <int D>
json predictionOf(const Case& setup, const Probe<D>& probe, const json& engines,
                  const std::filesystem::path& scratch) {
  const double packings = flowPackings(setup);
  const EngineEntry& inHouse = engineRegistry().front();
  double runs = 0.0;
  std::optional<double> step;  // of the engine that prepares [s]
  for (const json& row : engines) {
    runs += packings * row.value("run_s", 0.0);
    if (row["name"] == inHouse.name && row["can"] == true) step = row["step_s"].get<double>();
  }
  double preparing = 0.0;
  if (!probe.prepared) {
    if (!step) {
      const auto engine = startNew(inHouse, scratch, setup.run.timeout);
      step = alone(briefSteps(*engine, loadScene(*engine, inHouse, setup, probe.scene).dt));
    }
    preparing = packings * *step * preparationSteps(setup);
  }
  return {{"timed_on", probe.timedOn},
          {"preparing_s", preparing},
          {"runs_s", runs},
          {"total_s", preparing + runs}};
}

double volumeFractionOf(const Case& setup, const Scene& scene, bool madeUp) {
  double area = 0.0;
  const Disks kinds = madeUp ? diskKinds(couetteIn(setup).particles) : scene.disks;
  for (const double a : kinds.radius) area += a * a;
  const Cell& cell = couetteIn(setup).cell;
  return area / (cell.outerRadius * cell.outerRadius - cell.innerRadius * cell.innerRadius);
}

/// Numbers of a flow's runs.
json flowFigures(const Case& setup, double dt) {
  return {{"packings", flowPackings(setup)},
          {"looks", interimPlanOf(setup).packings},
          {"duration_s", flowDuration(setup)},
          {"steps", stepsOf(setup, dt)}};
}

/// @param timed  engines take some steps of a flow, too
template <int D>
json checkedIn(const Case& setup, const std::vector<std::string>& names, bool timed,
               const std::filesystem::path& scratch, Progress& progress,
               const std::function<void(std::size_t)>& beforeTiming) {
  const bool couette = cellOf(setup) != nullptr, flows = hasFlow(setup);
  if (!couette) requireStableStep(setup, {});
  const Probe<D> probe = probeOf<D>(setup, timed);
  const SceneOf<D>& scene = probe.scene;
  const SceneOf<D> asked = askedScene(setup, probe);
  double fraction = 0.0;
  if constexpr (D == 2)
    if (couette) {
      requireStableStep(setup, lightestPair(scene.disks, true));
      fraction = volumeFractionOf(setup, scene, !packingFile(setup));
    }
  json result = {{"name", setup.name},
                 {"variant", setup.variant},
                 {"kind", kindOf(setup)},
                 {"disks", scene.disks.size()},
                 {"wall_disks", scene.wallDiskCount()},
                 {"dt_s", scene.dt},
                 {"steps_per_contact", nullptr},
                 {"effects", json::array()},
                 {"left_out", json::array()},
                 {"cautions", cautions(setup, fraction)}};
  if (D == 3) result["dimension"] = D;
  for (const ShapeOf<D>& shape : scene.shapes) result["shapes"].push_back(toString(shape.kind));
  if (const auto limit = pairStepLimit(setup)) {
    result["step_limit_s"] = limit->dt;
    if (const auto time = pairContactTime(setup)) result["steps_per_contact"] = *time / scene.dt;
  }
  const Effects called = effectsOf(scene);
  for (const Effect effect : allEffects)
    result[called.contains(effect) ? "effects" : "left_out"].push_back(toString(effect));
  result["engines"] = json::array();
  const std::vector<EngineEntry> entries = flows ? enginesFor(setup, names) : selectEngines(names);
  if (timed && flows)
    beforeTiming(static_cast<std::size_t>(std::ranges::count_if(
        entries, [](const EngineEntry& entry) { return entry.mirrors.empty(); })));
  progress.begin(timed && flows ? "timing engines" : "asking engines",
                 std::vector<double>(entries.size(), 1.0));
  for (std::size_t k = 0; k < entries.size(); ++k) {
    throwIfInterrupted();
    progress.update(k, entries[k].name, 0.0);
    result["engines"].push_back(
        suitability(entries[k], setup, asked, scene, timed && flows, scratch));
    progress.finish(k, entries[k].name);
  }
  if (setup.region) {
    result["endpoints"] = marginsOf(setup.endpoints, setup.averaging.endpoints, "endpoint");
    result["margins"] = marginsOf(fieldsIn(setup.dimension, setup.region->hasRings()),
                                  setup.averaging.margins, "field");
  }
  if (flows) result["flow"] = flowFigures(setup, scene.dt);
  if constexpr (D == 2)
    if (couette) result["cell"] = cellFigures(setup, scene, fraction);
  if (timed && flows) result["prediction"] = predictionOf(setup, probe, result["engines"], scratch);
  return result;
}

}  // namespace

json checkedCase(const Case& setup, const std::vector<std::string>& names, bool timed,
                 const std::filesystem::path& scratch, Progress& progress,
                 const std::function<void(std::size_t)>& beforeTiming) {
  checkEngineSections(setup);
  if (packingFile(setup) && !setup.run.dt)
    throw BadInput(setup.file.string() + ": a packing file needs [run] dt, the time step in s");
  // Refusals of --dry-run and of the command itself: the start of any packing.
  if (hasFlow(setup)) checkPackings(setup, flowPackings(setup), timeStep(setup));
  return inDimensionOf(setup, [&]<int D>() {
    return checkedIn<D>(setup, names, timed, scratch, progress, beforeTiming);
  });
}

}  // namespace crossgrain::inline studies
