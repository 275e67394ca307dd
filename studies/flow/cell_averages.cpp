#include "studies/flow/cell_averages.hpp"

#include "averaging/global.hpp"
#include "cases/couette.hpp"
#include "studies/flow/run.hpp"
#include "studies/flow/summary.hpp"

namespace crossgrain::inline studies {

CellAverages::CellAverages(const Case& setup, const Scene& scene)
    : setup_(setup),
      scene_(scene),
      distributions_(ringsOf(setup), scene, distributionScales(setup)),
      spin_(ringsOf(setup), scene) {}

void CellAverages::add(const Snapshot& now, RunSeries& series) {
  const Cell& cell = couetteIn(setup_).cell;
  distributions_.add(now);
  spin_.add(now);
  series["wheel_torque"].push_back(drivingTorque(scene_, now, wheelName));
  // Snapshots of another source may lack the walls: no disks of a ring, no pressure on it.
  const bool hasWalls = !now.wallPosition.empty();
  const auto pressure = hasWalls
                            ? radialPressure(scene_, now, ringName, cell.outerRadius, cell.height)
                            : std::nullopt;
  series["outer_pressure"].push_back(pressure);
  series["wheel_contacts"].push_back(contactsOf(scene_, now, wheelName));
  const auto motion = wheelMotion(scene_, now, ringsOf(setup_), cell.omega);
  series["wheel_slip"].push_back(motion ? std::optional(motion->slip) : std::nullopt);
  series["shear_share"].push_back(motion ? std::optional(motion->shear) : std::nullopt);
  if (!hasWalls) return;
  if (const auto wall = outerWallBalance(ringsOf(setup_), scene_, now)) wall_.push_back(*wall);
}

void CellAverages::describe(const EffectiveParameters& effective, FlowRun& run) const {
  run.head = headNumbers(setup_, run.profiles, *run.series, effective);
  run.regime = couetteRegime(setup_, run.profiles, *run.series);
  run.steadiness = couetteSteadiness(setup_, *run.series);
  run.fits = couetteFits(setup_, run.profiles);
  for (FitRow& fit : spinFits(setup_, spin_)) run.fits.push_back(std::move(fit));
  run.checks = couetteChecks(setup_, run.profiles, *run.series, wall_);
  run.distributions = distributions_.distributions();
}

}  // namespace crossgrain::inline studies
