#pragma once

#include <array>
#include <string>
#include <string_view>
#include <type_traits>

#include "adapters/vec2.hpp"

namespace crossgrain {

enum class MotionKind { fixed, rotating, translating, oscillating, radial };

/// Prescribed motion of a rigid body, a closed form in time.
template <int D>
struct MotionOf {
  using Kind = MotionKind;

  Kind kind = Kind::fixed;
  SpinOf<D> angularVelocity = noSpin<D>();  ///< rotating: Ω about the centre [rad/s]
  VecOf<D> velocity = VecOf<D>::Zero();     ///< translating [m/s]
  /// oscillating: x(t) = x_0 + amplitude sin(frequency t) [m]
  VecOf<D> amplitude = VecOf<D>::Zero();
  double frequency = 0.0;       ///< oscillating: angular frequency [rad/s]
  double radialVelocity = 0.0;  ///< radial: dR/dt of the ring's radius, < 0 shrinks [m/s]
  double radialEnd = 0.0;       ///< radial: time at which the ring stops [s]
};
using Motion = MotionOf<2>;

/// As in the worker protocol and in messages, in enum order.
inline constexpr std::array<std::string_view, 5> motionNames = {"fixed", "rotating", "translating",
                                                                "oscillating", "radial"};
std::string toString(Motion::Kind kind);

/// Where a body is and how fast, at one instant.
/// A member at reference offset d from the centre (|d| = R) is at
/// centre + turn(angle) d (1 + radialShift/R).
template <int D>
struct BodyStateOf {
  VecOf<D> centre = VecOf<D>::Zero();       ///< [m]
  SpinOf<D> angle = noSpin<D>();            ///< since t = 0; in space about one axis [rad]
  double radialShift = 0.0;                 ///< added to each member's distance from the centre [m]
  VecOf<D> velocity = VecOf<D>::Zero();     ///< of the centre [m/s]
  SpinOf<D> angularVelocity = noSpin<D>();  ///< also the spin of every member [rad/s]
  double radialVelocity = 0.0;              ///< [m/s]
};
using BodyState = BodyStateOf<2>;

/// The state at time t [s] of a body whose centre is at `centre` at t = 0.
template <int D>
BodyStateOf<D> stateAt(const MotionOf<D>& motion, const std::type_identity_t<VecOf<D>>& centre,
                       double t);

/// Position of a member whose reference position (t = 0) is `reference`.
template <int D = 2>
VecOf<D> memberPosition(const BodyStateOf<D>& now,
                        const std::type_identity_t<VecOf<D>>& referenceCentre,
                        const std::type_identity_t<VecOf<D>>& reference);

/// Velocity of the body's material point at `position`.
template <int D = 2>
VecOf<D> memberVelocity(const BodyStateOf<D>& now, const std::type_identity_t<VecOf<D>>& position);

/// v turned by the angle; in space about its direction.
template <int D = 2>
VecOf<D> turnedBy(const SpinOf<D>& angle, const VecOf<D>& v);

}  // namespace crossgrain
