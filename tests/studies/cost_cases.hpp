#pragma once

#include <string>
#include <vector>

#include "adapters/engine_entry.hpp"
#include "adapters/grain.hpp"
#include "cases/loader.hpp"

/// The small cell as `crossgrain cost` takes it.
namespace crossgrain::test {

/// In this process.
inline const EngineEntry inHouse{"grain", "", makeGrain, {}, {}, ""};

inline std::vector<std::string> costOverrides() {
  return {"cost.collision_steps=[200, 100, 50, 1.2]", "cost.psi_count=9",
          "cost.collision_reference=800", "cost.timed=1e-4", "cost.repeats=1"};
}

inline Case costCase(const std::string& fragment = {}) {
  return loadCase(CROSSGRAIN_CASES "/cost/quick.toml", costOverrides(), fragment).front();
}

}  // namespace crossgrain::test
