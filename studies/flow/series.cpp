#include "studies/flow/series.hpp"

#include "averaging/global.hpp"
#include "averaging/regime.hpp"
#include "cases/couette.hpp"
#include "studies/flow/run.hpp"

namespace crossgrain::inline studies {

void addGlobalNumbers(RunSeries& rows, const Scene& scene, const Snapshot& now) {
  const GlobalNumbers numbers = globalNumbers(scene, now);
  rows["t_s"].push_back(now.positionTime);
  rows["kinetic_energy"].push_back(numbers.kineticEnergy);
  rows["coordination"].push_back(numbers.coordination);
  rows["max_overlap"].push_back(numbers.maxOverlap);
  rows["mean_overlap"].push_back(numbers.meanOverlap);
  rows["sliding_fraction"].push_back(numbers.slidingFraction);
  rows["pairs_listed"].push_back(numbers.listedPairs);
  if (!now.ledger) return;
  for (const LedgerTerm& term : ledgerTerms)
    rows["energy_" + std::string(term.name)].push_back(*now.ledger.*term.value);
  rows["energy_residual"].push_back(residual(*now.ledger));
}

void CouetteSeries::add(const Snapshot& now) {
  addGlobalNumbers(rows_, scene_, now);
  rows_["wheel_torque"].push_back(drivingTorque(scene_, now, wheelName));
  // Snapshots of another source may lack the walls: no disks of a ring, no pressure on it.
  const auto pressure =
      now.wallPosition.empty()
          ? std::nullopt
          : radialPressure(scene_, now, ringName, setup_.cell.outerRadius, setup_.cell.height);
  rows_["outer_pressure"].push_back(pressure);
  rows_["wheel_contacts"].push_back(contactsOf(scene_, now, wheelName));
  const auto motion = wheelMotion(scene_, now, ringsOf(setup_), setup_.cell.omega);
  rows_["wheel_slip"].push_back(motion ? std::optional(motion->slip) : std::nullopt);
  rows_["shear_share"].push_back(motion ? std::optional(motion->shear) : std::nullopt);
}

}  // namespace crossgrain::inline studies
