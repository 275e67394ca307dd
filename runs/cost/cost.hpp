#pragma once

#include <functional>
#include <string>
#include <vector>

#include "results/cost.hpp"
#include "runs/common/options.hpp"
#include "runs/common/run_store.hpp"
#include "runs/cost/advice.hpp"
#include "runs/cost/settings.hpp"

namespace crossgrain::inline runs {

struct CostRequest {
  RunCommand run;
  double budget = 720.0;  ///< for all that is measured [s]
  /// Told the plan before anything of it runs.
  std::function<void(const std::string&)> tellPlan = {};
  std::vector<double> targets = usualTargets();  ///< accuracies to find settings for
};

/// Measures what accuracy costs: every setting of [cost] on every engine, one at a time, engines in
/// turn. Three kinds of error, never mixed (docs/methods.md). What is measured is kept in the store
/// at once. A setting that an engine fails at ends by itself.
/// @throws BadInput, UnsupportedScene, OutputError, Interrupted
CostResults measureCost(const Case& setup, const CostRequest& request, RunStore& store);

/// Which settings that would measure, for people. Engines are asked what they can do; nothing is
/// computed, so that neither the time nor what fits into a budget is known.
/// @throws BadInput, UnsupportedScene, Interrupted
std::string costPlan(const Case& setup, const CostRequest& request, RunStore& store);

}  // namespace crossgrain::inline runs
