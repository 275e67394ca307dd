#pragma once

#include <vector>

#include "runs/cost/error_kind.hpp"
#include "runs/cost/plan.hpp"
#include "runs/cost/study.hpp"

namespace crossgrain::inline runs {

/// Measures what is planned, one point at a time: kind by kind, engines in turn, so that a machine
/// that slows down does so for all. A point that fails ends by itself; those that have no number
/// say why.
/// @returns points by kind, engine and setting
std::vector<CostPoint> execute(const CostPlan& plan, CostStudy& study, const ErrorKinds& kinds);

}  // namespace crossgrain::inline runs
