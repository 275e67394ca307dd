#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "adapters/scene.hpp"

namespace crossgrain {

/// Calls visit(i, j), i < j, for every two discs, or spheres, that may touch, at least one of them
/// among the first `moving`: those of walls may overlap each other. They are sorted into cells of
/// the largest diameter, so that only neighbouring cells are looked at.
/// @pre positions are finite, radii > 0
template <int D, class Visit>
void nearPairs(const std::vector<VecOf<D>>& position, const std::vector<double>& radius,
               std::size_t moving, Visit&& visit) {
  if (position.empty()) return;
  VecOf<D> low = position.front(), high = position.front();
  for (const VecOf<D>& place : position) {
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  // Discs that are far apart get larger cells: no more of them than there are discs, by and large.
  const VecOf<D> extent = high - low;
  const auto number = static_cast<double>(position.size());
  double side =
      std::max(2.0 * *std::max_element(radius.begin(), radius.end()), extent.maxCoeff() / number);
  for (int k = 0; k < (D == 2 ? 1 : D); ++k)
    side = std::max(side, std::sqrt(extent[k] * extent[(k + 1) % D] / number));
  if (D == 3) side = std::max(side, std::cbrt(extent.prod() / number));
  // Places below and their extent here go through the same arithmetic: none rounds to a cell more.
  const double inverse = 1.0 / side;
  std::array<std::size_t, D> count;
  std::size_t cells = 1;
  // An extent that is no number any more has an inverse of 0: one cell holds all.
  const auto cellAt = [inverse](double from) {
    const double at = inverse * from;
    return at > 0.0 ? static_cast<std::size_t>(at) : 0;
  };
  for (std::size_t k = 0; k < D; ++k) {
    count[k] = cellAt(extent[static_cast<int>(k)]) + 1;
    cells *= count[k];
  }
  const std::size_t columns = count[0];
  std::vector<std::size_t> cell(position.size()), begin(cells + 1);
  for (std::size_t k = 0; k < position.size(); ++k) {
    const VecOf<D> from = position[k] - low;
    std::size_t row = 0;
    for (int axis = D - 1; axis > 0; --axis)
      row = row * count[static_cast<std::size_t>(axis)] + cellAt(from[axis]);
    cell[k] = row * columns + cellAt(from.x());
    ++begin[cell[k] + 1];
  }
  for (std::size_t c = 0; c < cells; ++c) begin[c + 1] += begin[c];
  std::vector<std::size_t> order(position.size()), next(begin.begin(), begin.end() - 1);
  for (std::size_t k = 0; k < position.size(); ++k) order[next[cell[k]]++] = k;

  const auto both = [&](std::size_t a, std::size_t b) {
    if (const auto [i, j] = std::minmax(order[a], order[b]); i < moving) visit(i, j);
  };
  // Of the neighbouring rows those that come later: each pair of cells once.
  struct Later {
    int y, z;
  };
  constexpr std::array<Later, 4> later = {{{1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
  const auto rows = static_cast<int>(count[1]);
  const int layers = D == 2 ? 1 : static_cast<int>(count[D - 1]);
  for (int layer = 0; layer < layers; ++layer)
    for (int row = 0; row < rows; ++row)
      for (std::size_t column = 0; column < columns; ++column) {
        const auto rowCell = [&](int y, int z) {
          return (static_cast<std::size_t>(z) * count[1] + static_cast<std::size_t>(y)) * columns +
                 column;
        };
        const std::size_t own = rowCell(row, layer);
        const std::size_t right = begin[column + 1 < columns ? own + 2 : own + 1];
        std::array<std::pair<std::size_t, std::size_t>, later.size()> parts{};
        std::size_t used = 0;
        for (std::size_t n = 0; n < (D == 2 ? 1 : later.size()); ++n) {
          const int y = row + later[n].y, z = layer + later[n].z;
          if (y < 0 || y >= rows || z >= layers) continue;
          const std::size_t other = rowCell(y, z);
          parts[used++] = {begin[other - (column > 0 ? 1 : 0)],
                           begin[other + (column + 1 < columns ? 2 : 1)]};
        }
        for (std::size_t a = begin[own]; a < begin[own + 1]; ++a) {
          for (std::size_t b = a + 1; b < right; ++b) both(a, b);
          for (std::size_t n = 0; n < used; ++n)
            for (std::size_t b = parts[n].first; b < parts[n].second; ++b) both(a, b);
        }
      }
}

/// The same where a box has periodic directions: pairs may also touch across its borders. A pair
/// is visited once for each image of it that may touch.
/// @pre the box is wider than the largest diameter along each
template <int D, class Visit>
void nearPairs(const std::vector<VecOf<D>>& position, const std::vector<double>& radius,
               std::size_t moving, const std::optional<BoxOf<D>>& box, Visit&& visit) {
  if (!box || position.empty()) return nearPairs<D>(position, radius, moving, visit);
  const double reach = 2.0 * *std::max_element(radius.begin(), radius.end());
  std::vector<VecOf<D>> all;
  for (const VecOf<D>& place : position) all.push_back(box->wrapped(place));
  std::vector<double> radii = radius;
  std::vector<std::size_t> owner(position.size());
  std::iota(owner.begin(), owner.end(), 0);
  // Images up to a reach outside of the box, one direction after the other: corners come by two.
  for (int k = 0; k < D; ++k) {
    if (!box->periodic[static_cast<std::size_t>(k)]) continue;
    const double length = box->high[k] - box->low[k];
    for (std::size_t n = 0, end = all.size(); n < end; ++n)
      for (const double side : {1.0, -1.0}) {
        const double shifted = all[n][k] + side * length;
        if (shifted < box->low[k] - reach || shifted > box->high[k] + reach) continue;
        all.push_back(all[n]);
        all.back()[k] = shifted;
        radii.push_back(radii[n]);
        owner.push_back(owner[n]);
      }
  }
  // With one of the two in the box, and of (i, image of j), (j, image of i) the first.
  const std::size_t real = position.size();
  nearPairs<D>(all, radii, real, [&](std::size_t i, std::size_t j) {
    if (i < owner[j] && i < moving) visit(i, owner[j]);
  });
}

}  // namespace crossgrain
