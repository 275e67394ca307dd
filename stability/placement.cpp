#include "stability/placement.hpp"

#include <cmath>

namespace crossgrain::inline stability {

Vec2 Placement::turned(const Vec2& direction) const {
  const double x = mirror ? -direction.x() : direction.x();
  const double c = std::cos(turn), s = std::sin(turn);
  return {c * x - s * direction.y(), s * x + c * direction.y()};
}

Vec2 Placement::turnedBack(const Vec2& direction) const {
  const double c = std::cos(turn), s = std::sin(turn);
  const double x = c * direction.x() + s * direction.y();
  return {mirror ? -x : x, c * direction.y() - s * direction.x()};
}

Vec2 Placement::undoneAt(const Vec2& position, double t) const {
  return turnedBack(position - offset - t * boost);
}

}  // namespace crossgrain::inline stability
