#pragma once

#include "adapters/vec2.hpp"

namespace crossgrain::inline stability {

/// Where a scene stands and how it drifts: mirrored at the y axis, then turned about the origin,
/// shifted, and set moving. Physics is the same in every placement.
struct Placement {
  bool mirror = false;         ///< x → −x
  double turn = 0.0;           ///< counter-clockwise [rad]
  Vec2 offset = Vec2::Zero();  ///< [m]
  Vec2 boost = Vec2::Zero();   ///< added to every velocity, walls' too (Galileo) [m/s]

  /// A direction of the scene before, as it is placed, and back.
  Vec2 turned(const Vec2& direction) const;
  Vec2 turnedBack(const Vec2& direction) const;

  /// Where a point would be at time t, were it not mirrored, turned, shifted and boosted [m].
  Vec2 undoneAt(const Vec2& position, double t) const;
};

}  // namespace crossgrain::inline stability
