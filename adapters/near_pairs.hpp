#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "adapters/vec2.hpp"

namespace crossgrain {

/// Calls visit(i, j), i < j, for every two discs that may touch, at least one of them among the
/// first `moving`: those of walls may overlap each other. Discs are sorted into squares of the
/// largest diameter, so that only neighbouring squares are looked at.
/// @pre positions are finite, radii > 0
template <class Visit>
void nearPairs(const std::vector<Vec2>& position, const std::vector<double>& radius,
               std::size_t moving, Visit&& visit) {
  if (position.empty()) return;
  Vec2 low = position.front(), high = position.front();
  for (const Vec2& place : position) {
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  // Discs that are far apart get larger squares: no more of them than there are discs, by and
  // large.
  const double area = (high - low).x() * (high - low).y();
  const double side = std::max({2.0 * *std::max_element(radius.begin(), radius.end()),
                                std::sqrt(area / static_cast<double>(position.size())),
                                (high - low).maxCoeff() / static_cast<double>(position.size())});
  // Places below and their extent here go through the same arithmetic: none rounds to a square
  // more.
  const double inverse = 1.0 / side;
  const auto columns = static_cast<std::size_t>(inverse * (high - low).x()) + 1;
  const auto rows = static_cast<std::size_t>(inverse * (high - low).y()) + 1;
  std::vector<std::size_t> square(position.size()), begin(columns * rows + 1);
  for (std::size_t k = 0; k < position.size(); ++k) {
    const Vec2 from = inverse * (position[k] - low);
    square[k] = static_cast<std::size_t>(from.y()) * columns + static_cast<std::size_t>(from.x());
    ++begin[square[k] + 1];
  }
  for (std::size_t s = 0; s < columns * rows; ++s) begin[s + 1] += begin[s];
  std::vector<std::size_t> order(position.size()), next(begin.begin(), begin.end() - 1);
  for (std::size_t k = 0; k < position.size(); ++k) order[next[square[k]]++] = k;

  const auto both = [&](std::size_t a, std::size_t b) {
    if (const auto [i, j] = std::minmax(order[a], order[b]); i < moving) visit(i, j);
  };
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column) {
      const std::size_t own = row * columns + column;
      // To the right, and the three below: each pair of squares once.
      const std::size_t right = begin[column + 1 < columns ? own + 2 : own + 1];
      std::size_t below = 0, belowEnd = 0;
      if (row + 1 < rows) {
        below = begin[own + columns - (column > 0 ? 1 : 0)];
        belowEnd = begin[own + columns + (column + 1 < columns ? 2 : 1)];
      }
      for (std::size_t a = begin[own]; a < begin[own + 1]; ++a) {
        for (std::size_t b = a + 1; b < right; ++b) both(a, b);
        for (std::size_t b = below; b < belowEnd; ++b) both(a, b);
      }
    }
}

}  // namespace crossgrain
