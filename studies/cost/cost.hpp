#pragma once

#include <optional>
#include <string>

#include "results/cost.hpp"
#include "studies/core/study.hpp"

namespace crossgrain::inline studies {

struct CostOptions {
  std::optional<std::string> budget, target;  ///< as they are given: "10m", "1%"
  std::optional<std::string> disks, threads;  ///< "1000,4000": [cost] disks, threads
};

/// Measures what accuracy costs: every setting of [cost] on every engine, one at a time, engines in
/// turn. Three kinds of error, never mixed (docs/methods.md). What is measured is kept in the store
/// at once. A setting that an engine fails at ends by itself.
/// @throws BadInput, UnsupportedScene, OutputError, Interrupted
extern const Study<CostOptions, CostResults> costStudy;

}  // namespace crossgrain::inline studies
