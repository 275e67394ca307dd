#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "adapters/vec2.hpp"

namespace crossgrain {

/// Calls visit(i, j), i < j, for every two discs whose extents in x overlap, at least one of them
/// among the first `moving`: those of walls may overlap each other.
template <class Visit>
void sweepPairs(const std::vector<Vec2>& position, const std::vector<double>& radius,
                std::size_t moving, Visit&& visit) {
  const auto left = [&](std::size_t i) { return position[i].x() - radius[i]; };
  std::vector<std::size_t> order(position.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, left);
  for (std::size_t a = 0; a < order.size(); ++a) {
    const double right = position[order[a]].x() + radius[order[a]];
    for (std::size_t b = a + 1; b < order.size() && left(order[b]) <= right; ++b)
      if (const auto [i, j] = std::minmax(order[a], order[b]); i < moving) visit(i, j);
  }
}

}  // namespace crossgrain
