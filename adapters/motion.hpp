#pragma once

#include <array>
#include <string>
#include <string_view>

#include "adapters/vec2.hpp"

namespace crossgrain {

/// Prescribed motion of a rigid body, a closed form in time.
struct Motion {
  enum class Kind { fixed, rotating, translating, oscillating, radial };

  Kind kind = Kind::fixed;
  double angularVelocity = 0.0;   ///< rotating: Ω about the centre, counter-clockwise [rad/s]
  Vec2 velocity = Vec2::Zero();   ///< translating [m/s]
  Vec2 amplitude = Vec2::Zero();  ///< oscillating: x(t) = x_0 + amplitude sin(frequency t) [m]
  double frequency = 0.0;         ///< oscillating: angular frequency [rad/s]
  double radialVelocity = 0.0;    ///< radial: dR/dt of the ring's radius, < 0 shrinks [m/s]
  double radialEnd = 0.0;         ///< radial: time at which the ring stops [s]
};

/// As in the worker protocol and in messages, in enum order.
inline constexpr std::array<std::string_view, 5> motionNames = {"fixed", "rotating", "translating",
                                                                "oscillating", "radial"};
std::string toString(Motion::Kind kind);

/// Where a body is and how fast, at one instant.
/// A member at reference offset d from the centre (|d| = R) is at
/// centre + turn(angle) d (1 + radialShift/R).
struct BodyState {
  Vec2 centre = Vec2::Zero();    ///< [m]
  double angle = 0.0;            ///< since t = 0 [rad]
  double radialShift = 0.0;      ///< added to each member's distance from the centre [m]
  Vec2 velocity = Vec2::Zero();  ///< of the centre [m/s]
  double angularVelocity = 0.0;  ///< also the spin of every member [rad/s]
  double radialVelocity = 0.0;   ///< [m/s]
};

/// The state at time t [s] of a body whose centre is at `centre` at t = 0.
BodyState stateAt(const Motion& motion, const Vec2& centre, double t);

/// Position of a member whose reference position (t = 0) is `reference`.
Vec2 memberPosition(const BodyState& now, const Vec2& referenceCentre, const Vec2& reference);

/// Velocity of the body's material point at `position`.
Vec2 memberVelocity(const BodyState& now, const Vec2& position);

}  // namespace crossgrain
