#include <fmt/format.h>

#include "cases/assembly_scene.hpp"
#include "cases/bad_input.hpp"
#include "cases/collision_scene.hpp"
#include "cases/couette.hpp"
#include "cases/loader.hpp"
#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "cli/one_case.hpp"
#include "cli/option_groups.hpp"
#include "runs/check_lines.hpp"
#include "runs/collision_sweep.hpp"
#include "runs/couette_run.hpp"
#include "runs/engine_access.hpp"
#include "runs/scratch_folder.hpp"

namespace crossgrain {

namespace fs = std::filesystem;

namespace {

/// The scene of a case as far as `check` needs it: all disks are there, but not yet where a packing
/// will have them.
Scene unplacedScene(const Case& setup) {
  if (setup.kind == CaseKind::collision)
    return collisionScene(setup, collisionStarts(setup), collisionTimeSteps(setup).front());
  if (setup.kind == CaseKind::assembly) return assemblyScene(setup);
  Packing unplaced;
  unplaced.disks = spreadDisks(setup);
  return couetteScene(setup, unplaced, timeStep(setup));
}

void printSuitability(const EngineEntry& entry, const Case& setup, const Scene& scene,
                      const fs::path& scratch) {
  const auto engine = startEngine(entry, scratch, setup.run.timeout);
  const std::vector<std::string> lines = checkLines(*engine, entry, setup, scene);
  fmt::print("  {:<16} {}\n", entry.name, lines.front());
  for (std::size_t k = 1; k < lines.size(); ++k) fmt::print("    {}\n", lines[k]);
}

int checkCase(const CommandLine& line) {
  const ScratchFolder scratch;
  bool allCan = true;
  for (const Case& setup : loadCase(line.inputs.front(), line.overrides)) {
    checkEngineSections(setup);
    const Scene scene = unplacedScene(setup);
    fmt::print("{}: {} disks, {} wall disks, dt {:.3g} s\n",
               setup.variant.empty() ? setup.name : setup.variant, scene.disks.size(),
               scene.wallDiskCount(), scene.dt);
    fmt::print("  {}\n", effectsInWords(effectsOf(scene)));
    if (setup.kind == CaseKind::couette) {
      const double end =
          (setup.averaging.settleRotations + setup.averaging.rotations) * rotationTime(setup);
      fmt::print("  per packing: {:.0f} steps of the case's dt\n", end / scene.dt);
    }
    for (const EngineEntry& entry : selectEngines(line.run.engines)) {
      try {
        printSuitability(entry, setup, scene, scratch.path);
      } catch (const UnsupportedScene& refusal) {
        allCan = false;
        fmt::print("  {:<16} cannot: {}\n", entry.name, refusal.what());
      }
    }
    for (const EngineEntry& entry : engineRegistry())
      if (entry.missing && !entry.missing().empty() && !isNamed(line.run.engines, entry))
        fmt::print("  {:<16} not available: {}\n", entry.name, entry.missing());
  }
  return allCan ? exitHeld : exitFellShort;
}

Action declare(CLI::App& app, CommandLine& line) {
  addCase(app, line);
  addEngines(app, line, "all");
  addOverrides(app, line);
  return [&line] { return checkCase(line); };
}

}  // namespace

extern const Command checkCommand = {
    "check", "who can run a case, and where engines differ from it",
    "crossgrain check cases/couette/quick.toml --engines all", declare};

}  // namespace crossgrain
