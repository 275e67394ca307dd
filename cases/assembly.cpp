#include "cases/assembly.hpp"

#include <cmath>

namespace crossgrain {

Vec2 Assembly::turned(const Vec2& direction) const {
  const double x = mirror ? -direction.x() : direction.x();
  const double c = std::cos(turn), s = std::sin(turn);
  return {c * x - s * direction.y(), s * x + c * direction.y()};
}

Vec2 Assembly::turnedBack(const Vec2& direction) const {
  const double c = std::cos(turn), s = std::sin(turn);
  const double x = c * direction.x() + s * direction.y();
  return {mirror ? -x : x, c * direction.y() - s * direction.x()};
}

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

}  // namespace crossgrain
