#pragma once

#include "results/cost.hpp"
#include "results/overview.hpp"

namespace crossgrain::reports {

/// An engine per row, a kind of error and a wanted accuracy per column: the setting that reaches it
/// against the case's law for the least time, and that time.
Overview costOverview(const CostResults& results);

}  // namespace crossgrain::reports
