#pragma once

#include <vector>

#include "adapters/grain.hpp"
#include "cases/loader.hpp"
#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "studies/lockstep/starts.hpp"

namespace crossgrain::test {

/// The quick cell's first packing and states along its flow, which fixtures make once for all of
/// their tests.
struct QuickFlow {
  explicit QuickFlow(std::size_t starts)
      : setup(loadCase(CROSSGRAIN_CASES "/couette/quick.toml", {}).front()), dt(timeStep(setup)) {
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
