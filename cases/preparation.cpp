#include "cases/preparation.hpp"

#include <fmt/format.h>
#include <gsl/gsl_randist.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <mutex>
#include <numbers>

#include "adapters/registry.hpp"
#include "adapters/suitability.hpp"
#include "adapters/worker/json.hpp"
#include "adapters/worker/worker_engine.hpp"
#include "cases/couette.hpp"
#include "cases/scene_numbers.hpp"
#include "cases/time_step.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/random.hpp"
#include "support/scratch_folder.hpp"

namespace crossgrain::inline cases {

namespace {

/// The widest lattice that still has a site for every disk.
std::vector<Vec2> diluteLattice(std::size_t disks, double inner, double outer) {
  double wide = outer - inner, narrow = 0.0;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (wide + narrow);
    if (middle * middle * static_cast<double>(disks) < 1e-6 * (outer * outer)) break;
    (latticeSites(middle, inner, outer).size() >= disks ? narrow : wide) = middle;
  }
  if (narrow == 0.0) return {};
  return latticeSites(narrow, inner, outer);
}

void placeAtRandom(Disks& disks, const Case& setup, gsl_rng* random) {
  const auto& [cell, particles, filling, times] = couetteIn(setup);
  const double clearance = cell.wallRadius + particles.largeRadius;
  const double outer = filling.dilation * cell.outerRadius;
  std::vector<Vec2> sites =
      diluteLattice(disks.size(), cell.innerRadius + clearance, outer - clearance);
  if (sites.size() < disks.size())
    throw BadInput(
        fmt::format("{}: preparation.dilation = {:g} leaves no room for {} disks on a "
                    "lattice; a larger one does",
                    setup.file.string(), filling.dilation, disks.size()));
  gsl_ran_shuffle(random, sites.data(), sites.size(), sizeof(Vec2));
  std::copy_n(sites.begin(), disks.size(), disks.position.begin());
  for (Vec2& velocity : disks.velocity) {
    velocity.x() = gsl_ran_gaussian(random, filling.velocity);
    velocity.y() = gsl_ran_gaussian(random, filling.velocity);
  }
}

/// The cell with its ring at R_prepare, about to shrink.
Scene diluteScene(const Case& setup, const Disks& disks, double dt) {
  const auto& [cell, particles, filling, times] = couetteIn(setup);
  Packing packing;
  packing.disks = disks;
  Scene scene = couetteScene(setup, packing, dt);
  scene.precision = Precision::float64;  // a packing is the same for all that run it
  scene.energyLedger = false;
  const double start = filling.dilation * cell.outerRadius;
  WallBody& ring = scene.bodies.back();
  for (Vec2& position : ring.diskPosition) position *= filling.dilation;
  ring.motion.kind = Motion::Kind::radial;
  ring.motion.radialEnd = filling.shrinkTime;
  ring.motion.radialVelocity = (cell.outerRadius - start) / filling.shrinkTime;
  return scene;
}

/// Leniency of the case with the in-house engine: it ends a run or does not, and changes
/// nothing of a packing.
Settings guardOf(const Case& setup) {
  Settings guard;
  if (const auto own = setup.engines.find(engineRegistry().front().name);
      own != setup.engines.end())
    if (const auto limit = own->second.find("max_overlap"); limit != own->second.end())
      guard.insert(*limit);
  return guard;
}

/// The in-house engine can do every scene as it is; another one does it as the case lets it, with
/// its own settings.
void load(Engine& engine, const Case& setup, const Scene& scene) {
  const EngineEntry* const entry = ownPreparer(setup);
  if (!entry) {
    engine.load(scene, guardOf(setup));
    return;
  }
  const auto settings = setup.engines.find(entry->name);
  try {
    engine.load(adaptScene(engine.capabilities(), scene, setup.run.mayDiffer).scene,
                settings == setup.engines.end() ? Settings() : settings->second);
  } catch (const UnsupportedScene& refusal) {
    throw UnsupportedScene(fmt::format("{} cannot prepare packings of {}: {}", entry->name,
                                       setup.file.string(), refusal.what()));
  }
}

}  // namespace

std::vector<Vec2> latticeSites(double constant, double inner, double outer) {
  std::vector<Vec2> sites;
  const double line = constant * std::sqrt(3.0) / 2.0;
  const auto lines = static_cast<int>(outer / line) + 1;
  const auto columns = static_cast<int>(outer / constant) + 2;
  for (int l = -lines; l <= lines; ++l) {
    for (int c = -columns; c <= columns; ++c) {
      const Vec2 site((c + (l % 2 == 0 ? 0.0 : 0.5)) * constant, l * line);
      const double r = site.norm();
      if (r >= inner && r <= outer) sites.push_back(site);
    }
  }
  return sites;
}

Scene preparationStart(const Case& setup, int index, double dt) {
  const auto& [cell, particles, filling, times] = couetteIn(setup);
  Disks disks = diskKinds(particles);
  const Random random = randomStream(setup.preparation.seed, static_cast<std::uint64_t>(index));
  placeAtRandom(disks, setup, random.get());
  Scene scene = diluteScene(setup, disks, filling.dt.value_or(dt));
  if (const std::string why = beyondNumbers(scene); !why.empty())
    throw BadInput(setup.file.string() + why);
  checkStart(scene, particles,
             setup.file.string() + ": preparation.dilation leaves too little room");
  return scene;
}

Packing preparePacking(const Case& setup, int index, double dt, Engine& engine,
                       const std::function<void(double)>& progress) {
  Packing packing;
  packing.hash = packingHash(setup, index, dt);
  const Scene scene = preparationStart(setup, index, dt);
  packing.disks = scene.disks;
  load(engine, setup, scene);
  const double end = preparationTime(setup);
  // Where the engine stops is part of what a packing is: other slices give other bits.
  constexpr int slices = 200;
  for (int slice = 1; slice <= slices; ++slice) {
    engine.advance(end * slice / slices);
    progress(static_cast<double>(slice) / slices);
  }

  const Snapshot last = engine.snapshot(ContactReport::none);
  packing.disks.position = last.position;
  packing.disks.velocity = last.velocity;
  if (last.spin) packing.disks.spin = *last.spin;
  packing.wheelAngle = std::remainder(last.bodies.front().angle, 2.0 * std::numbers::pi);
  return packing;
}

std::filesystem::path packingCache() {
  namespace fs = std::filesystem;
  const auto variable = [](const char* name) -> std::string {
    const char* value = std::getenv(name);
    return value ? value : "";
  };
  if (const std::string own = variable("CROSSGRAIN_CACHE"); !own.empty())
    return own;
  else if (const std::string cache = variable("XDG_CACHE_HOME"); !cache.empty())
    return fs::path(cache) / "crossgrain";
  else if (const std::string home = variable("HOME"); !home.empty())
    return fs::path(home) / ".cache" / "crossgrain";
  std::error_code none;  // of TMPDIR
  const fs::path scratch = fs::temp_directory_path(none);
  return (none ? "/tmp" : scratch) / "crossgrain-cache";
}

std::filesystem::path packingCacheFile(const std::string& hash) {
  return packingCache() / ("packing-" + hash + ".h5");
}

Packing packingOf(const Case& setup, int index, double dt, Engine& engine,
                  const std::function<void(double)>& progress) {
  if (packingFile(setup)) {
    Packing packing = readPacking(*packingFile(setup), setup);
    packing.hash = contentHash(packing);
    checkStart(couetteScene(setup, packing, dt), couetteIn(setup).particles,
               packingFile(setup)->string(), &couetteIn(setup).cell);
    return packing;
  }
  const std::string hash = packingHash(setup, index, dt);
  const std::filesystem::path file = packingCacheFile(hash);
  std::string why;
  if (auto kept = keptPacking(file, hash, setup, why)) return *std::move(kept);
  Packing packing;
  if (const EngineEntry* const other = ownPreparer(setup)) {
    const ScratchFolder scratch;
    packing =
        preparePacking(setup, index, dt, *startPreparer(*other, setup, scratch.path), progress);
  } else {
    packing = preparePacking(setup, index, dt, engine, progress);
  }
  packing.anew = why;
  try {
    writePacking(packing, file);
  } catch (const OutputError& error) {
    packing.notCached = error.what();  // costs time, not the run
  }
  return packing;
}

namespace {

const std::string& versionOf(const EngineEntry& entry, const Case& setup) {
  static std::mutex mutex;
  static std::map<std::string, std::string> known;
  const std::lock_guard lock(mutex);
  const auto found = known.find(entry.name);
  if (found != known.end()) return found->second;
  const ScratchFolder scratch;
  return known[entry.name] = startPreparer(entry, setup, scratch.path)->capabilities().version;
}

}  // namespace

const EngineEntry* ownPreparer(const Case& setup) {
  const std::string& name = couetteIn(setup).filling.engine;
  return name.empty() || name == engineRegistry().front().name ? nullptr : findEngine(name);
}

std::unique_ptr<Engine> startPreparer(const EngineEntry& entry, const Case& setup,
                                      const std::filesystem::path& scratch) {
  if (entry.missing)
    if (const std::string why = entry.missing(); !why.empty())
      throw BadInput(fmt::format("{}: preparation.engine = \"{}\": it is not available: {}",
                                 setup.file.string(), entry.name, why));
  if (!entry.command) return entry.make();
  return std::make_unique<WorkerEngine>(entry.name, entry.command(), scratch, setup.run.timeout);
}

std::string preparerKey(const Case& setup) {
  const EngineEntry* const entry = ownPreparer(setup);
  if (!entry) return {};
  const auto settings = setup.engines.find(entry->name);
  const nlohmann::json own =
      settings == setup.engines.end() ? nlohmann::json() : jsonOf(settings->second);
  return fmt::format("{} {} {}", entry->name, versionOf(*entry, setup), own.dump());
}

}  // namespace crossgrain::inline cases
