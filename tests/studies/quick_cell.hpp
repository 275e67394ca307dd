#pragma once

#include <string>
#include <vector>

#include "adapters/grain.hpp"
#include "cases/loader.hpp"
#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "studies/lockstep/starts.hpp"

namespace crossgrain::test {

/// cases/couette/quick.toml with changes, KEY=VALUE each.
inline Case quickCell(const std::vector<std::string>& changes = {}) {
  return loadCase(CROSSGRAIN_CASES "/couette/quick.toml", changes).front();
}

/// The small cell as `crossgrain cost` takes it, in short.
/// @param fragment  further lines of the case file
inline Case costCase(const std::string& fragment = {}) {
  return loadCase(CROSSGRAIN_CASES "/cost/quick.toml",
                  {"cost.collision_steps=[200, 100, 50, 1.2]", "cost.psi_count=9",
                   "cost.collision_reference=800", "cost.timed=1e-4", "cost.repeats=2"},
                  fragment)
      .front();
}

/// The quick cell's first packing and states along its flow, which fixtures make once for all of
/// their tests.
struct QuickFlow {
  /// @param changes  of the cell, KEY=VALUE each
  explicit QuickFlow(std::size_t starts, const std::vector<std::string>& changes = {})
      : setup(quickCell(changes)), dt(timeStep(setup)) {
    const auto engine = makeGrain();
    const auto nobody = [](double) {};
    packings = {packingOf(setup, 0, dt, *engine, nobody)};
    states = statesAlongTheFlow(setup, packings, dt, starts, nobody);
  }

  Case setup;
  double dt;  ///< [s]
  std::vector<Packing> packings;
  std::vector<FlowState> states;
};

}  // namespace crossgrain::test
