#pragma once

#include "results/overview.hpp"
#include "results/scale.hpp"

namespace crossgrain::reports {

/// An engine per row: on the largest cell that it ran what a disk takes, what sharing is worth, and
/// how much memory it needs.
Overview scaleOverview(const ScaleResults& results);

/// "3 cells of 1 000 to 100 000 disks, 2 engines"
std::string scaleLead(const ScaleResults& results);

}  // namespace crossgrain::reports
