#include "stability/placement.hpp"

#include <cmath>
#include <numbers>

namespace crossgrain::inline stability {

namespace {

/// Cosine and sine, quarter turns to the bit: a plane along an axis stays one.
struct Direction {
  explicit Direction(double turn) : c(std::cos(turn)), s(std::sin(turn)) {
    const double quarters = turn / (0.5 * std::numbers::pi);
    if (std::abs(quarters - std::round(quarters)) > 1e-15 * std::abs(quarters)) return;
    c = std::round(c);
    s = std::round(s);
  }
  double c, s;
};

}  // namespace

Vec2 Placement::turned(const Vec2& direction) const {
  const double x = mirror ? -direction.x() : direction.x();
  const auto [c, s] = Direction(turn);
  return {c * x - s * direction.y(), s * x + c * direction.y()};
}

Vec2 Placement::turnedBack(const Vec2& direction) const {
  const auto [c, s] = Direction(turn);
  const double x = c * direction.x() + s * direction.y();
  return {mirror ? -x : x, c * direction.y() - s * direction.x()};
}

Vec2 Placement::undoneAt(const Vec2& position, double t) const {
  return turnedBack(position - offset - t * boost);
}

}  // namespace crossgrain::inline stability
