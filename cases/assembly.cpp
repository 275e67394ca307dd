#include "cases/assembly.hpp"

#include <cmath>

namespace crossgrain::inline cases {

std::vector<Vec2> gridPlaces(int columns, int rows, const Vec2& spacing, bool triangular) {
  std::vector<Vec2> places;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double shift = triangular && row % 2 == 1 ? 0.5 : 0.0;
      places.emplace_back((column + shift) * spacing.x(), row * spacing.y());
    }
  return places;
}

std::vector<Vec2> heapPlaces(int base, double spacing) {
  std::vector<Vec2> places;
  for (int row = 0; row < base; ++row)
    for (int column = 0; column < base - row; ++column)
      places.emplace_back((column + 0.5 * row) * spacing, row * spacing * std::sqrt(0.75));
  return places;
}

}  // namespace crossgrain::inline cases
