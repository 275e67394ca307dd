#pragma once

#include <vector>

#include "studies/collide/sweep.hpp"
#include "tests/studies/planted_engine.hpp"
#include "tests/support/pairs.hpp"

namespace crossgrain::test {

/// Two small disks that meet at 0.01 m/s with these Ψ_i, judged by Ψ_f within 0.01.
inline Case smallPairSweep(const std::vector<double>& psi) {
  Case setup = smallPairCase();
  collisionIn(setup).psi = psi;
  collisionIn(setup).vn = {0.01};
  collisionIn(setup).margins["psi_f"] = {0.01, false, "because", ""};
  return setup;
}

/// A case's sweep on an engine in steps of `dt` [s].
/// @param watch  keeps account of what its contacts do
inline CollisionCurve swept(const Case& setup, double dt, bool watch = false,
                            const EngineEntry& entry = inHouse) {
  const auto starts = collisionStarts(setup);
  return runSweep(*entry.make(), entry, setup, dt, starts, oracleCurve(setup, starts), watch);
}

}  // namespace crossgrain::test
