// long_run CASE [STEPS]
//   the case's first packing on the in-house engine with its energy ledger, for STEPS or 10⁷
//   steps. Prints ten lines on the way: steps, the ledger's residual relative to the energy that
//   has gone through it, the speed of the centre of mass relative to the rim's, overlap. Exit
//   status 1 where one of them is out of bounds.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "adapters/energy_ledger.hpp"
#include "averaging/global.hpp"
#include "cases/couette.hpp"
#include "cases/loader.hpp"
#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "studies/core/engine_access.hpp"

using namespace crossgrain;

namespace {

/// The residual is an error of second order in dt on what springs take and give back; a hundredth
/// of the energy that went through is ten times what the first 10⁵ steps of the thesis' cell leave,
/// and drift would pass it.
constexpr double residualBound = 0.01;
/// All disks going one way as fast as the rim: more than walls that turn about one axis can bring
/// about. Small cells come to a sixth of it, as what is in the band swings together.
constexpr double momentumBound = 1.0;

struct Health {
  double residual = 0.0;  ///< |residual| / (work of the walls + what was lost)
  double momentum = 0.0;  ///< |Σ m v| / (M Ω R_i)
  double overlap = 0.0;   ///< largest, in units of the smallest radius
};

double throughput(const EnergyLedger& ledger) {
  return std::abs(ledger.workOfWalls) + ledger.lostNormalDamping + ledger.lostTangentialDamping +
         ledger.lostSliding + ledger.lostBottom + ledger.lostRelease;
}

Health healthOf(const Case& setup, const Scene& scene, const Snapshot& now) {
  Vec2 momentum = Vec2::Zero();
  double mass = 0.0;
  for (std::size_t i = 0; i < scene.disks.size(); ++i) {
    momentum += scene.disks.mass[i] * now.velocity[i];
    mass += scene.disks.mass[i];
  }
  const double rim = couetteIn(setup).cell.rimSpeed();
  const double smallest = *std::ranges::min_element(scene.disks.radius);
  const EnergyLedger& ledger = now.ledger.value();
  return {std::abs(residual(ledger)) / throughput(ledger), momentum.norm() / (mass * rim),
          globalNumbers(scene, now).maxOverlap.value_or(0.0) / smallest};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "long_run CASE [STEPS]\n");
    return 2;
  }
  const Case setup = loadCase(argv[1], {}).at(0);
  const double steps = argc > 2 ? std::atof(argv[2]) : 1e7;
  const double dt = timeStep(setup);
  const EngineEntry& entry = *findEngine("grain");
  const auto preparing = entry.make();
  Scene scene = couetteScene(setup, packingOf(setup, 0, dt, *preparing, [](double) {}), dt);
  scene.energyLedger = true;
  const auto engine = entry.make();
  const EffectiveParameters effective = loadScene(*engine, entry, setup, scene);
  bool sound = true;
  for (int tenth = 1; tenth <= 10; ++tenth) {
    const double done = std::round(0.1 * tenth * steps);
    engine->advance(done * effective.dt);
    const Health health = healthOf(setup, scene, engine->snapshot(ContactReport::instant));
    const bool within = health.residual <= residualBound && health.momentum <= momentumBound;
    fmt::print(
        "{:.0f} steps, {:.3g} rotations: residual {:.2e}, momentum {:.2e}, overlap {:.2e}{}\n",
        done, done * effective.dt * couetteIn(setup).cell.omega / (2.0 * std::numbers::pi),
        health.residual, health.momentum, health.overlap, within ? "" : "  OUT OF BOUNDS");
    std::fflush(stdout);
    sound = sound && within;
  }
  return sound ? 0 : 1;
}
