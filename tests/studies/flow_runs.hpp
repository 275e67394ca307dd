#pragma once

#include <string>
#include <vector>

#include "results/run.hpp"

/// Runs of engines with numbers made by hand.
namespace crossgrain::test {

/// A field's means over rings, by slicing.
inline Profile sliced(const std::string& field, const Numbers& mean, const Numbers& error = {}) {
  return {"slicing", field, "", mean, error, {}, {}};
}

inline FlowRun flowRun(const std::string& engine, int packing,
                       const std::vector<Profile>& profiles = {}) {
  FlowRun run{.engine = engine, .packing = packing, .profiles = profiles};
  run.stats.emplace();
  return run;
}

}  // namespace crossgrain::test
