#pragma once

#include <vector>

#include "reports/common/view.hpp"
#include "results/couette_frame.hpp"

namespace crossgrain::reports {

/// One row per packing: index, seed, hash, and where it came from.
Json packingRows(const std::vector<PackingRow>& packings);

/// Indices that rise, runs of three or more told by their ends: "0, 2 to 5, 7".
std::string indicesInWords(const std::vector<int>& indices);

}  // namespace crossgrain::reports
