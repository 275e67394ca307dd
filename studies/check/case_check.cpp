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
#include "studies/flow/averages.hpp"
#include "studies/flow/endpoint_table.hpp"
#include "studies/flow/run.hpp"
#include "support/bad_input.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline studies {

using nlohmann::json;

namespace {

/// The scene that engines are asked about.
struct Probe {
  Scene scene;
  std::string packing = {};  ///< where the disks of a Couette case come from
  bool prepared = true;      ///< whether packings need no preparing any more
};

/// A Couette cell with the disks of its file, of its first packing if that is cached, or made up.
Probe probeOf(const Case& setup) {
  const double dt = timeStep(setup);
  if (isCollision(setup)) return {collisionScene(setup, collisionStarts(setup), dt)};
  if (isAssembly(setup)) return {assemblyScene(setup)};
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

/// Beyond what a contact bears, as the commands refuse it; hard cases may go there.
template <int D>
void requireStableStep(const Case& setup, const DisksOf<D>& disks) {
  if (!hasFlow(setup)) return;
  std::optional<LightestPair> lightest;  // the disks of an assembly are all in its case
  if constexpr (D == 2)
    if (cellOf(setup)) lightest = lightestPair(disks, true);
  const char* const key = setup.run.dt ? "run.dt" : "run.steps_per_contact";
  const std::string why = unstableStepFault(setup, timeStep(setup), key, lightest);
  if (!why.empty()) throw BadInput(fmt::format("{}: {}", whereSaid(setup, key), why));
}

double stepsOf(const Case& setup, double dt) {
  return flowDuration(setup) / dt;
}

int packingsOf(const Case& setup) {
  return packingFile(setup) ? 1 : setup.preparation.packings;
}

template <int D>
json suitability(const EngineEntry& entry, const Case& setup, const SceneOf<D>& scene, bool timed,
                 const std::filesystem::path& scratch) {
  json row = {
      {"name", entry.name}, {"mirrors", entry.mirrors},    {"can", true},
      {"reason", ""},       {"deviations", json::array()}, {"not_simulated", json::array()}};
  try {
    // Times and memory are those of a process that does nothing else.
    const auto engine = timed ? startNew(entry, scratch, setup.run.timeout)
                              : startEngine(entry, scratch, setup.run.timeout);
    checkSuitable(*engine, entry, setup, scene);
    const Suitability found = suitabilityOf(*engine, entry, setup, scene);
    row["deviations"] = found.deviations;
    row["not_simulated"] = found.notSimulated;
    if (found.dt) row["dt_s"] = *found.dt;
    if constexpr (D == 2) {
      if (!timed) return row;
      const BriefTiming timing = briefTiming(*engine, entry, setup, scene);
      row["dt_s"] = timing.effective.dt;
      row["step_s"] = timing.secondsPerStep;
      row["timed_steps"] = timing.steps;
      row["memory_bytes"] = timing.memory ? json(*timing.memory) : json(nullptr);
      row["run_s"] = timing.secondsPerStep * stepsOf(setup, timing.effective.dt);
    }
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
          {"packings", packingsOf(setup)},
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
json predictionOf(const Case& setup, const Probe& probe, const json& engines,
                  const std::filesystem::path& scratch) {
  const double packings = packingsOf(setup);
  const EngineEntry& inHouse = engineRegistry().front();
  double runs = 0.0;
  std::optional<double> step;  // of the engine that prepares [s]
  for (const json& row : engines) {
    runs += packings * row.value("run_s", 0.0);
    if (row["name"] == inHouse.name && row["can"] == true) step = row["step_s"].get<double>();
  }
  double preparing = 0.0;
  if (!probe.prepared) {
    if (!step)
      step =
          briefTiming(*startNew(inHouse, scratch, setup.run.timeout), inHouse, setup, probe.scene)
              .secondsPerStep;
    preparing = packings * *step * preparationSteps(setup);
  }
  return {{"timed_on", probe.packing},
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

/// Description of every kind of case.
/// @param timed  engines take some steps, too; not in space
template <int D>
json checkedScene(const Case& setup, const SceneOf<D>& scene, double volumeFraction,
                  const std::vector<std::string>& names, bool timed,
                  const std::filesystem::path& scratch, Progress& progress) {
  const bool couette = cellOf(setup) != nullptr;
  json result = {{"name", setup.name},
                 {"variant", setup.variant},
                 {"kind", kindOf(setup)},
                 {"disks", scene.disks.size()},
                 {"wall_disks", scene.wallDiskCount()},
                 {"dt_s", scene.dt},
                 {"steps_per_contact", nullptr},
                 {"effects", json::array()},
                 {"left_out", json::array()},
                 {"cautions", cautions(setup, volumeFraction)}};
  if (D == 3) result["dimension"] = D;
  if (const auto limit = pairStepLimit(setup)) {
    result["step_limit_s"] = limit->dt;
    if (const auto time = pairContactTime(setup)) result["steps_per_contact"] = *time / scene.dt;
  }
  const Effects called = effectsOf(scene);
  for (const Effect effect : allEffects)
    result[called.contains(effect) ? "effects" : "left_out"].push_back(toString(effect));
  result["engines"] = json::array();
  const std::vector<EngineEntry> entries =
      couette ? enginesFor(setup, names) : selectEngines(names);
  progress.begin("asking engines", std::vector<double>(entries.size(), 1.0));
  for (std::size_t k = 0; k < entries.size(); ++k) {
    throwIfInterrupted();
    progress.update(k, entries[k].name, 0.0);
    result["engines"].push_back(suitability(entries[k], setup, scene, timed, scratch));
    progress.finish(k, entries[k].name);
  }
  return result;
}

}  // namespace

json checkedCase(const Case& setup, const std::vector<std::string>& names, bool timed,
                 const std::filesystem::path& scratch, Progress& progress) {
  checkEngineSections(setup);
  if (packingFile(setup) && !setup.run.dt)
    throw BadInput(setup.file.string() + ": a packing file needs [run] dt, the time step in s");
  // Refusals of --dry-run and of the command itself: the start of any packing.
  if (hasFlow(setup)) checkPackings(setup, flowPackings(setup), timeStep(setup));
  const auto addMargins = [&](json& result) {
    result["endpoints"] = marginsOf(setup.endpoints, setup.averaging.endpoints, "endpoint");
    result["margins"] = marginsOf(fieldsIn(setup.dimension, setup.region->hasRings()),
                                  setup.averaging.margins, "field");
  };
  if (setup.dimension == 3) {
    const SpaceScene spheres =
        isCollision(setup) ? spaceCollisionScene(setup, collisionStarts(setup), timeStep(setup))
                           : assemblyScene<3>(setup);
    requireStableStep(setup, spheres.disks);
    json result = checkedScene(setup, spheres, 0.0, names, false, scratch, progress);
    if (setup.region) addMargins(result);
    return result;
  }
  const Probe probe = probeOf(setup);
  const Scene& scene = probe.scene;
  requireStableStep(setup, scene.disks);
  const bool couette = cellOf(setup) != nullptr;
  const double fraction = couette ? volumeFractionOf(setup, scene, !packingFile(setup)) : 0.0;

  json result = checkedScene(setup, scene, fraction, names, timed && couette, scratch, progress);
  if (setup.region) addMargins(result);
  if (!couette) return result;
  result["cell"] = cellFigures(setup, scene, fraction);
  if (timed) result["prediction"] = predictionOf(setup, probe, result["engines"], scratch);
  return result;
}

}  // namespace crossgrain::inline studies
