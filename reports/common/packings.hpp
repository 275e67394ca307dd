#pragma once

#include <vector>

#include "reports/common/view.hpp"
#include "results/couette_frame.hpp"

namespace crossgrain::reports {

/// One row per packing: index, seed, hash, and where it came from.
Json packingRows(const std::vector<PackingRow>& packings);

}  // namespace crossgrain::reports
