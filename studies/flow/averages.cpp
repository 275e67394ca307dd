#include "studies/flow/averages.hpp"

#include <array>
#include <span>

#include "averaging/global.hpp"
#include "averaging/grid.hpp"
#include "averaging/regime.hpp"
#include "averaging/rings.hpp"
#include "averaging/space_rings.hpp"
#include "cases/couette.hpp"
#include "cases/flow.hpp"
#include "studies/flow/run.hpp"
#include "studies/flow/summary.hpp"

namespace crossgrain::inline studies {

template <>
std::shared_ptr<const Coordinates> coordinatesOf<2>(const Case& setup,
                                                    const std::optional<BoxOf<2>>& box) {
  if (!setup.average) return std::make_shared<Rings>(ringsOf(setup));
  const Region& region = setup.average->region;
  if (region.hasRings())
    return std::make_shared<Rings>(region.innerRadius, region.outerRadius, region.count,
                                   region.height, flowDiameter(setup));
  return std::make_shared<Grid>(region.low.head<2>(), region.high.head<2>(), region.columnCount(),
                                region.rowCount(), region.height, box);
}

template <>
std::shared_ptr<const SpaceBins> coordinatesOf<3>(const Case& setup,
                                                  const std::optional<BoxOf<3>>& box) {
  const Region& region = setup.average.value().region;
  if (region.hasRings())
    return std::make_shared<SpaceRings>(region.innerRadius, region.outerRadius, region.count,
                                        region.low.z(), region.high.z(), region.layers, box);
  std::array<int, 3> count = {region.columns, region.rows, region.layers};
  const bool inLine = region.bins == BinKind::slabs;
  if (inLine) count[static_cast<std::size_t>(region.axis)] = region.count;
  return std::make_shared<Cells>(region.low, region.high, count, box,
                                 inLine ? std::optional(region.axis) : std::nullopt);
}

std::shared_ptr<const BinSet> binsOf(const Case& setup) {
  if (setup.dimension == 3) return coordinatesOf<3>(setup);
  return coordinatesOf<2>(setup);
}

template <>
std::unique_ptr<FlowAverages> flowAverages(const Case& setup, const Scene& scene) {
  if (setup.average) return std::make_unique<RegionAverages<2>>(setup, scene);
  return std::make_unique<CouetteAverages>(setup, scene);
}

template <>
std::unique_ptr<FlowAveragesOf<3>> flowAverages(const Case& setup, const SpaceScene& scene) {
  return std::make_unique<RegionAverages<3>>(setup, scene);
}

template <int D>
void addGlobalNumbers(RunSeries& rows, const SceneOf<D>& scene, const SnapshotOf<D>& now) {
  const GlobalNumbers numbers = globalNumbers(scene, now);
  rows["t_s"].push_back(now.positionTime);
  rows["kinetic_energy"].push_back(numbers.kineticEnergy);
  rows["coordination"].push_back(numbers.coordination);
  rows["max_overlap"].push_back(numbers.maxOverlap);
  rows["mean_overlap"].push_back(numbers.meanOverlap);
  rows["sliding_fraction"].push_back(numbers.slidingFraction);
  rows["pairs_listed"].push_back(numbers.listedPairs);
  if (!now.ledger) return;
  const bool more = scene.law.rolls() || scene.law.coheres();
  for (const LedgerTerm& term :
       std::span(ledgerTerms).first(more ? ledgerTerms.size() : commonLedgerTerms))
    rows["energy_" + std::string(term.name)].push_back(*now.ledger.*term.value);
  rows["energy_residual"].push_back(residual(*now.ledger));
}
template void addGlobalNumbers(RunSeries&, const Scene&, const Snapshot&);
template void addGlobalNumbers(RunSeries&, const SpaceScene&, const SpaceSnapshot&);

template <int D>
std::optional<FlowRun> ProfileAveragesOf<D>::without(std::size_t k, std::size_t n) const {
  const auto part = profiles_.part(k, n);
  if (!part) return std::nullopt;
  FlowRun run;
  run.profiles = profiles_.profilesWithout(k, n);
  run.series = series_;
  for (auto& [name, values] : *run.series)
    values.erase(values.begin() + static_cast<std::ptrdiff_t>(part->first),
                 values.begin() + static_cast<std::ptrdiff_t>(part->second));
  run.head = {{"coordination", "-", meanOf(valuesOf(*run.series, "coordination")), {}, {}}};
  return run;
}
template class ProfileAveragesOf<2>;
template class ProfileAveragesOf<3>;

CouetteAverages::CouetteAverages(const Case& setup, const Scene& scene)
    : ProfileAveragesOf({ringsOf(setup), weightsOf(setup, setup.averaging.methods), scene}),
      setup_(setup),
      scene_(scene),
      distributions_(ringsOf(setup), scene, distributionScales(setup)),
      spin_(ringsOf(setup), scene) {}

void CouetteAverages::addSeries(const Snapshot& now) {
  addGlobalNumbers(series_, scene_, now);
  series_["wheel_torque"].push_back(drivingTorque(scene_, now, wheelName));
  // Snapshots of another source may lack the walls: no disks of a ring, no pressure on it.
  const auto pressure =
      now.wallPosition.empty()
          ? std::nullopt
          : radialPressure(scene_, now, ringName, setup_.cell.outerRadius, setup_.cell.height);
  series_["outer_pressure"].push_back(pressure);
  series_["wheel_contacts"].push_back(contactsOf(scene_, now, wheelName));
  const auto motion = wheelMotion(scene_, now, ringsOf(setup_), setup_.cell.omega);
  series_["wheel_slip"].push_back(motion ? std::optional(motion->slip) : std::nullopt);
  series_["shear_share"].push_back(motion ? std::optional(motion->shear) : std::nullopt);
}

void CouetteAverages::add(const Snapshot& snapshot) {
  profiles_.add(snapshot);
  addSeries(snapshot);
  distributions_.add(snapshot);
  spin_.add(snapshot);
  // As the pressure on the ring: only of snapshots that hold the walls.
  if (snapshot.wallPosition.empty()) return;
  if (const auto wall = outerWallBalance(ringsOf(setup_), scene_, snapshot)) wall_.push_back(*wall);
}

void CouetteAverages::describe(const EffectiveParameters& effective, FlowRun& run) const {
  run.profiles = profiles_.profiles();
  run.series = series_;
  run.head = headNumbers(setup_, run.profiles, *run.series, effective);
  run.regime = couetteRegime(setup_, run.profiles, *run.series);
  run.steadiness = couetteSteadiness(setup_, *run.series);
  run.fits = couetteFits(setup_, run.profiles);
  for (FitRow& fit : spinFits(setup_, spin_)) run.fits.push_back(std::move(fit));
  run.checks = couetteChecks(setup_, run.profiles, *run.series, wall_);
  run.distributions = distributions_.distributions();
}

}  // namespace crossgrain::inline studies
