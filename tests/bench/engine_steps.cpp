// engine_steps CASE
//   the scene of the case's first packing as JSON, for lammps_input.py
// engine_steps CASE ENGINE CHECK STEPS
//   runs CHECK steps of the case's dt, says where the engine then is, and times the next STEPS,
//   each of the engine's own dt
// One line of JSON on stdout. peers.py calls both.
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "adapters/worker/worker_engine.hpp"
#include "averaging/global.hpp"
#include "cases/couette.hpp"
#include "cases/loader.hpp"
#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "studies/core/engine_access.hpp"

using namespace crossgrain;
using nlohmann::json;

namespace {

Scene sceneOf(const Case& setup) {
  const double dt = timeStep(setup);
  const auto grain = findEngine("grain")->make();
  const Packing packing = packingOf(setup, 0, dt, *grain, [](double) {});
  return couetteScene(setup, packing, dt);
}

json asJson(const Scene& scene) {
  json disks = json::array(), walls = json::array();
  for (std::size_t i = 0; i < scene.disks.size(); ++i)
    disks.push_back({{"radius", scene.disks.radius[i]},
                     {"mass", scene.disks.mass[i]},
                     {"position", {scene.disks.position[i].x(), scene.disks.position[i].y()}},
                     {"velocity", {scene.disks.velocity[i].x(), scene.disks.velocity[i].y()}},
                     {"spin", scene.disks.spin[i]}});
  for (const WallBody& body : scene.bodies) {
    json wall = {{"radius", body.diskRadius.front()},
                 {"omega", body.motion.angularVelocity},
                 {"position", json::array()}};
    for (const Vec2& p : body.diskPosition) wall["position"].push_back({p.x(), p.y()});
    walls.push_back(wall);
  }
  const ContactLaw& law = scene.law;
  return {
      {"disks", disks},
      {"walls", walls},
      {"dt", scene.dt},
      {"law", {{"kn", law.kn}, {"gn", law.gn}, {"kt", law.kt}, {"gt", law.gt}, {"mu", law.mu}}}};
}

json timed(const Case& setup, const Scene& scene, const EngineEntry& entry, int check, int steps) {
  const auto scratch = std::filesystem::temp_directory_path() / "crossgrain-engine-steps";
  const auto engine = entry.make ? entry.make()
                                 : std::make_unique<WorkerEngine>(entry.name, entry.command(),
                                                                  scratch, setup.run.timeout);
  const EffectiveParameters effective = loadScene(*engine, entry, setup, scene);
  const double checkTime = engine->advance(check * scene.dt);
  const Snapshot at = engine->snapshot(ContactReport::instant);
  const Stats before = engine->stats();
  engine->advance(checkTime + steps * effective.dt);
  const Stats after = engine->stats();
  json differs = json::array();
  for (const Deviation& deviation : effective.deviations) differs.push_back(deviation.name);
  return {{"dt", effective.dt},
          {"precision", effective.precision},
          {"contacts", at.contacts ? at.contacts->size() : 0},
          {"kinetic_energy", globalNumbers(scene, at).kineticEnergy},
          {"us_per_step", 1e6 * (after.wallSeconds - before.wallSeconds) /
                              static_cast<double>(after.steps - before.steps)},
          {"differs", differs}};
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 2 && argc != 5) throw BadInput("usage: engine_steps CASE [ENGINE CHECK STEPS]");
    const Case setup = loadCase(argv[1]).front();
    const Scene scene = sceneOf(setup);
    if (argc == 2) {
      std::cout << asJson(scene) << '\n';
      return 0;
    }
    const EngineEntry* entry = findEngine(argv[2]);
    if (!entry) throw BadInput(fmt::format("there is no engine '{}'", argv[2]));
    std::cout << timed(setup, scene, *entry, std::stoi(argv[3]), std::stoi(argv[4])) << '\n';
  } catch (const std::exception& error) {
    std::cerr << "engine_steps: " << error.what() << '\n';
    return 2;
  }
}
