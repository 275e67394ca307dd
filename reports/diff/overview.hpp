#pragma once

#include "results/diff.hpp"
#include "results/overview.hpp"

namespace crossgrain::reports {

/// An engine per row: what it does otherwise over short windows, in collisions, in averages.
Overview diffOverview(const DiffResults& results);

}  // namespace crossgrain::reports
