#include "runs/couette/series.hpp"

#include "averaging/global.hpp"
#include "averaging/regime.hpp"
#include "cases/couette.hpp"
#include "runs/common/records.hpp"
#include "runs/couette/run.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

void CouetteSeries::add(const Snapshot& now) {
  const GlobalNumbers numbers = globalNumbers(scene_, now);
  rows_["t_s"].push_back(now.positionTime);
  rows_["wheel_torque"].push_back(toJson(drivingTorque(scene_, now, wheelName)));
  // Snapshots of another source may lack the walls: no disks of a ring, no pressure on it.
  const auto pressure =
      now.wallPosition.empty()
          ? std::nullopt
          : radialPressure(scene_, now, ringName, setup_.cell.outerRadius, setup_.cell.height);
  rows_["outer_pressure"].push_back(toJson(pressure));
  rows_["kinetic_energy"].push_back(numbers.kineticEnergy);
  rows_["coordination"].push_back(toJson(numbers.coordination));
  rows_["max_overlap"].push_back(toJson(numbers.maxOverlap));
  rows_["mean_overlap"].push_back(toJson(numbers.meanOverlap));
  rows_["sliding_fraction"].push_back(toJson(numbers.slidingFraction));
  rows_["pairs_listed"].push_back(toJson(numbers.listedPairs));
  rows_["wheel_contacts"].push_back(toJson(contactsOf(scene_, now, wheelName)));
  const auto motion = wheelMotion(scene_, now, ringsOf(setup_), setup_.cell.omega);
  rows_["wheel_slip"].push_back(motion ? json(motion->slip) : json(nullptr));
  rows_["shear_share"].push_back(motion ? json(motion->shear) : json(nullptr));
  if (!now.ledger) return;
  for (const LedgerTerm& term : ledgerTerms)
    rows_["energy_" + std::string(term.name)].push_back(*now.ledger.*term.value);
  rows_["energy_residual"].push_back(residual(*now.ledger));
}

}  // namespace crossgrain::inline runs
