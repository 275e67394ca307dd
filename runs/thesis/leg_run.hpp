#pragma once

#include <functional>

#include "results/thesis.hpp"
#include "runs/couette/run.hpp"

namespace crossgrain::inline runs {

/// What is looked at beside the case's own averages.
struct LegLooks {
  std::vector<int> finerRings;  ///< averaged over as well, each with all methods of the case
  int settlingSnapshots = 50;   ///< per rotation that is not averaged
};

/// One engine on one packing of a leg, from the closing of the ring on: leg, engine's and packing's
/// names are the caller's to add. No picture is kept.
/// @param progress  told the fraction done, 0 … 1
/// @throws as runCouette()
ThesisRun runLeg(const CouetteTask& task, const LegLooks& looks,
                 const std::function<void(double)>& progress);

}  // namespace crossgrain::inline runs
