#include "studies/flow/averages.hpp"

#include "studies/flow/run.hpp"
#include "studies/flow/state.hpp"
#include "studies/flow/summary.hpp"

namespace crossgrain::inline studies {

CouetteAverages::CouetteAverages(const Case& setup, const Scene& scene)
    : setup_(setup),
      scene_(scene),
      profiles_(ringsOf(setup), weightsOf(setup, setup.averaging.methods), scene),
      series_(setup, scene),
      distributions_(ringsOf(setup), scene, distributionScales(setup)),
      spin_(ringsOf(setup), scene) {}

void CouetteAverages::add(const Snapshot& snapshot) {
  profiles_.add(snapshot);
  series_.add(snapshot);
  distributions_.add(snapshot);
  spin_.add(snapshot);
  // As the pressure on the ring: only of snapshots that hold the walls.
  if (snapshot.wallPosition.empty()) return;
  if (const auto wall = outerWallBalance(ringsOf(setup_), scene_, snapshot)) wall_.push_back(*wall);
}

void CouetteAverages::describe(const EffectiveParameters& effective, FlowRun& run) const {
  run.profiles = profiles_.profiles();
  run.series = series_.rows();
  run.head = headNumbers(setup_, run.profiles, *run.series, effective);
  run.regime = couetteRegime(setup_, run.profiles, *run.series);
  run.steadiness = couetteSteadiness(setup_, *run.series);
  run.fits = couetteFits(setup_, run.profiles);
  for (FitRow& fit : spinFits(setup_, spin_)) run.fits.push_back(std::move(fit));
  run.checks = couetteChecks(setup_, run.profiles, *run.series, wall_);
  run.distributions = distributions_.distributions();
}

}  // namespace crossgrain::inline studies
