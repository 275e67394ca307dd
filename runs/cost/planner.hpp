#pragma once

#include "runs/cost/error_kind.hpp"
#include "runs/cost/plan.hpp"
#include "runs/cost/study.hpp"

namespace crossgrain::inline runs {

/// Every setting of every engine, for every kind of error, and what of it fits into the budget [s].
/// References that do not fit take their kind's points with them.
CostPlan planCost(const CostStudy& study, const ErrorKinds& kinds, double budget);

}  // namespace crossgrain::inline runs
