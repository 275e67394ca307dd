#pragma once

#include <string>
#include <vector>

#include "adapters/engine.hpp"
#include "adapters/scene.hpp"
#include "law/contact_law.hpp"

namespace crossgrain::conformance {

/// Two spheres in contact, so heavy that no force changes how they move: with constant velocities
/// and spins all that a tangential spring sees is prescribed.
struct MovedPair {
  const char* name;
  double radii[2];
  Vec3 position[2], velocity[2];  ///< [m, m/s]
  Vec3 spin[2];                   ///< [rad/s]

  Vec3 apart(double t) const { return position[0] - position[1] + t * (velocity[0] - velocity[1]); }
  double reach() const { return radii[0] + radii[1]; }
};

/// One passes the other: n turns by 0.76 rad, and the spring is stretched in the plane of that turn
/// and, by unequal arms of opposite spins, out of it; the mean spin has no part along n.
MovedPair passingPair();
/// At rest, the pair turns by 1 rad about its n, while equal spins stretch the spring evenly.
MovedPair twistingPair();

inline constexpr double movedTime = 1e-3;  ///< that a pair is moved for [s]
inline constexpr int movedSteps = 100;

/// The same pair, whose spins roll it besides, evenly.
MovedPair rollingPair();

/// The linear law with a spring, undamped, that nothing lets slip.
ContactLaw movedLaw();
/// That law with a rolling spring as stiff, k_r = k_t, which nothing lets slip either.
/// @param law  with the conventions that the engine has
ContactLaw rollingLaw(ContactLaw law);
/// movedLaw() with a rolling spring where the engine has one, and its conventions.
ContactLaw rollingLawOf(const Capabilities& can, int dimension);
SpaceScene movedScene(const MovedPair& pair, const ContactLaw& law);

/// Rule by which a spring follows its pair's motion from step to step.
struct SpringMotion {
  ContactLaw law;               ///< its conventions; k_t
  bool staysInSpace = false;    ///< ξ does not follow n at all
  double twistBy = 1.0;         ///< part of ½(ω_i + ω_j)·n that it turns by, where it twists
  double spinsOfSlip = 1.0;     ///< factor of the spins in v_t
  bool asDisplacement = false;  ///< a rolling spring is θ × n and not θ, and turns as that

  /// Difference from the declared rule; empty: none.
  std::string differenceFrom(const ContactLaw& declared) const;
};

/// F_t on the first at each step from 0 on, its part normal to n: the equations of
/// docs/dimensions.md, section 4, step by step [N].
std::vector<Vec3> springForces(const MovedPair& pair, const SpringMotion& motion, double dt,
                               int steps);

/// M on the first at each step from 0 on, its part normal to n, of a rolling spring that nothing
/// lets slip [N m].
std::vector<Vec3> rollingTorques(const MovedPair& pair, const SpringMotion& motion, double dt,
                                 int steps);

/// All rules that are tried, those with the fewest differences from the declared one first.
std::vector<SpringMotion> springMotions(const ContactLaw& declared);

/// Errors of a law with these conventions for a pair that turns rigidly, whose forces should only
/// turn with it: one sentence for each such convention.
std::vector<std::string> frameDependence(const ContactLaw& law);

}  // namespace crossgrain::conformance
