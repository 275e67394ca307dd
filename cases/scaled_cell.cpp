#include "cases/scaled_cell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <thread>

#include "adapters/grain.hpp"
#include "cases/couette.hpp"
#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "support/fingerprint.hpp"

namespace crossgrain::inline cases {
namespace {

/// Uniform in [0, 1), the same on every platform.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  double operator()() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }
  /// Uniform in 0 … count − 1.
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>((*this)() * static_cast<double>(count));
  }

 private:
  std::mt19937_64 bits_;
};

template <typename T>
void shuffle(std::vector<T>& values, Random& random) {
  for (std::size_t k = values.size(); k > 1; --k) std::swap(values[k - 1], values[random.below(k)]);
}

/// As many sites of a triangular lattice as there are disks, between the walls, line by line, each
/// off its place by up to a fifth of the lattice constant.
std::vector<Vec2> jitteredSites(const Case& setup, std::size_t disks, Random& random) {
  const double inner = couetteIn(setup).cell.innerRadius + couetteIn(setup).particles.largeRadius;
  const double outer = couetteIn(setup).cell.outerRadius - couetteIn(setup).particles.largeRadius;
  const double area = std::numbers::pi * (outer * outer - inner * inner);
  double constant = std::sqrt(area / static_cast<double>(disks) * 2.0 / std::sqrt(3.0));
  std::vector<Vec2> sites;
  for (; sites.size() < disks; constant *= 0.9995)  // whole cells never quite tile a ring
    sites = latticeSites(constant, inner, outer);
  // Spread what is too much over the cell.
  std::vector<Vec2> kept;
  for (std::size_t k = 0; k < disks; ++k) {
    const Vec2 jitter(random() - 0.5, random() - 0.5);
    kept.push_back(sites[k * sites.size() / disks] + 0.4 * constant * jitter);
  }
  return kept;
}

constexpr std::uint64_t relaxing = 3000, shearing = 2000;  // steps

/// Called with the steps done so far, of all that making a packing takes.
using StepsDone = std::function<void(std::uint64_t)>;

/// As many threads as there are cores: the packing is the same to the bit on any number.
Settings onAllCores() {
  return {
      {"threads", static_cast<double>(std::clamp(std::thread::hardware_concurrency(), 1u, 64u))}};
}

void advanceReporting(Engine& engine, double dt, std::uint64_t steps, const StepsDone& report) {
  constexpr std::uint64_t atOnce = 10;
  for (std::uint64_t done = 0; done < steps;) {
    report(done);
    done += std::min(atOnce, steps - done);
    engine.advance(static_cast<double>(done) * dt);
  }
}

/// Moves what overlaps apart: no friction, and a bath that takes the velocities.
void relax(Scene scene, Disks& disks, const StepsDone& report) {
  scene.law.tangential = TangentialLaw::none;
  scene.law.gn = 0.4;  // kg/s, nearly critical
  // k_b = 0 and a bound that is never reached: the plate's force is −γ v.
  scene.bottom = BottomPlate{1e9, 0.0, 0.05, 0.0, 9.81, false};
  Settings settings = onAllCores();
  settings["max_overlap"] = 0.0;  // sites next to a wall disk may begin deep in it
  const auto engine = makeGrain();
  const double dt = engine->load(scene, settings).dt;
  advanceReporting(*engine, dt, relaxing, report);
  disks.position = engine->snapshot(ContactReport::none).position;
  disks.velocity.assign(disks.size(), Vec2::Zero());
}

void shear(const Scene& scene, Packing& packing, const StepsDone& report) {
  const auto engine = makeGrain();
  const double dt = engine->load(scene, onAllCores()).dt;
  advanceReporting(*engine, dt, shearing, report);
  Snapshot end = engine->snapshot(ContactReport::none);
  packing.disks.position = std::move(end.position);
  packing.disks.velocity = std::move(end.velocity);
  packing.disks.spin = std::move(end.spin.value());
  packing.wheelAngle += end.bodies.front().angle;
}

/// The same disks in another order: disk k becomes disk `to[k]`.
Disks reordered(const Disks& disks, const std::vector<std::size_t>& to) {
  Disks result = disks;
  for (std::size_t k = 0; k < to.size(); ++k) {
    result.radius[to[k]] = disks.radius[k];
    result.mass[to[k]] = disks.mass[k];
    result.inertia[to[k]] = disks.inertia[k];
    result.position[to[k]] = disks.position[k];
    result.velocity[to[k]] = disks.velocity[k];
    result.spin[to[k]] = disks.spin[k];
  }
  return result;
}

Packing makePacking(const Case& setup, const std::function<void(double)>& progress) {
  Random random(1);
  const Disks kinds = diskKinds(couetteIn(setup).particles);
  const std::size_t disks = kinds.size();
  std::vector<std::size_t> idAtSite(disks);
  for (std::size_t k = 0; k < disks; ++k) idAtSite[k] = k;
  shuffle(idAtSite, random);

  // Worked on in the order of the lattice, which is kinder to caches than the order of the ids.
  Packing packing;
  packing.disks = kinds;
  for (std::size_t k = 0; k < disks; ++k) {
    packing.disks.radius[k] = kinds.radius[idAtSite[k]];
    packing.disks.mass[k] = kinds.mass[idAtSite[k]];
    packing.disks.inertia[k] = kinds.inertia[idAtSite[k]];
  }
  packing.disks.position = jitteredSites(setup, disks, random);
  const auto report = [&](std::uint64_t done) {
    progress(static_cast<double>(done) / static_cast<double>(relaxing + shearing));
  };
  const auto scene = [&] {
    Scene made = couetteScene(setup, packing, timeStep(setup));
    made.materials.reset();  // they go by the order of the ids
    return made;
  };
  relax(scene(), packing.disks, report);
  shear(scene(), packing, [&](std::uint64_t done) { report(relaxing + done); });
  packing.disks = reordered(packing.disks, idAtSite);
  return packing;
}

/// The factor g on both radii at which the room for disks grows by `room`: that between the walls'
/// surfaces less half a small disk, since disks pack badly against a wall. A real cell has a band
/// of loose disks at its wheel and is denser elsewhere: the factor 0.988, calibrated so
/// that there are about as many contacts per disk as in the real cell, see README.md.
double growthOf(const Case& setup, double room) {
  const double width = couetteIn(setup).cell.outerRadius - couetteIn(setup).cell.innerRadius;
  const double lost =
      couetteIn(setup).cell.wallRadius + 0.5 * couetteIn(setup).particles.smallRadius;
  return (lost + std::sqrt(lost * lost + 0.988 * room * width * (width - 2.0 * lost))) / width;
}

}  // namespace

bool canBeScaled(const Case& setup) {
  return cellOf(setup) && !packingFile(setup);
}

Case scaledCase(Case setup, std::size_t disks) {
  auto& [cell, particles, filling, times] = couetteIn(setup);
  const double all = particles.small + particles.large;
  const double growth = growthOf(setup, static_cast<double>(disks) / all);
  particles.small =
      static_cast<int>(std::lround(static_cast<double>(disks) * particles.small / all));
  particles.large = static_cast<int>(disks) - particles.small;
  cell.innerRadius *= growth;
  cell.outerRadius *= growth;
  cell.omega /= growth;
  setFlowOfCell(setup);
  return setup;
}

Packing scaledPacking(const Case& scaled, const std::filesystem::path& folder,
                      const std::function<void(double)>& progress) {
  // The tag changes whenever the making itself does.
  const std::string hash =
      fmt::format("{:016x}", fnv1a("scaled cell 1; " + packingHash(scaled, 0, timeStep(scaled))));
  const auto disks = static_cast<std::size_t>(couetteIn(scaled).particles.small +
                                              couetteIn(scaled).particles.large);
  const std::filesystem::path file = folder / fmt::format("scaled-{}-{}.h5", disks, hash);
  std::string why;
  if (auto kept = keptPacking(file, hash, scaled, why, mostScaled)) return *std::move(kept);
  Packing packing = makePacking(scaled, progress);
  packing.hash = hash;
  packing.anew = why;
  try {
    writePacking(packing, file);
  } catch (const std::exception& error) {
    packing.notCached = error.what();
  }
  return packing;
}

}  // namespace crossgrain::inline cases
