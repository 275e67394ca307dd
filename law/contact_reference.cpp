#include "law/contact_reference.hpp"

#include <limits>

namespace crossgrain::inline contact_law {

double CollidingPair::reducedMass() const {
  return 1.0 / (1.0 / mass[0] + 1.0 / mass[1]);
}

double CollidingPair::reducedRadius() const {
  return plane ? radius[0] : radius[0] * radius[1] / (radius[0] + radius[1]);
}

double CollidingPair::tangentialCompliance() const {
  return 1.0 / mass[0] + 1.0 / mass[1] + radius[0] * radius[0] / inertia[0] +
         radius[1] * radius[1] / inertia[1];
}

CollidingPair diskOnWall(double radius, double mass, double inertia) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  return {{radius, 0.0}, {mass, inf}, {inertia, inf}, true};
}

double leverFraction(LeverArm arm, PlaneArm plane, const CollidingPair& pair, int side) {
  if (arm == LeverArm::radius) return 0.0;
  if (pair.plane) {
    if (side == 1 || plane == PlaneArm::radius) return 0.0;
    return plane == PlaneArm::middle ? 0.5 : 1.0;
  }
  if (arm == LeverArm::contactPoint)
    return pair.radius[1 - side] / (pair.radius[0] + pair.radius[1]);
  return 0.5;
}

double stretchedShare(SpringUpdate when) {
  switch (when) {
    case SpringUpdate::after:
      return 0.0;
    case SpringUpdate::midpoint:
      return 0.5;
    case SpringUpdate::before:
      break;
  }
  return 1.0;
}

double rollingLength(const ContactLaw& law, const CollidingPair& pair) {
  const double reduced = pair.reducedRadius();
  switch (law.conventions.rollingLength) {
    case RollingLength::effective:
      break;
    case RollingLength::twiceEffective:
      return 2.0 * reduced;
    case RollingLength::smallerRadius:
      return pair.plane ? pair.radius[0] : std::min(pair.radius[0], pair.radius[1]);
    case RollingLength::meanRadius:
      return pair.plane ? pair.radius[0] : 0.5 * (pair.radius[0] + pair.radius[1]);
  }
  return reduced;
}

double rollingSquare(const ContactLaw& law, const CollidingPair& pair) {
  const double length = rollingLength(law, pair);
  switch (law.conventions.rollingStiffness) {
    case RollingStiffness::lengthSquare:
      break;
    case RollingStiffness::radii:
      return pair.radius[0] * (pair.plane ? pair.radius[0] : pair.radius[1]);
    case RollingStiffness::constant:
      return 1.0;
  }
  return length * length;
}

double inertiaAboutContact(const CollidingPair& pair, int side) {
  return pair.inertia[side] + pair.mass[side] * pair.radius[side] * pair.radius[side];
}

double rollingDamperUnit(const ContactLaw& law, const CollidingPair& pair, double stiffness) {
  const double length = rollingLength(law, pair);
  if (law.rolling != RollingLaw::spring || law.conventions.rollingDamper == RollingDamper::constant)
    return length * length;
  const double inverse =
      1.0 / inertiaAboutContact(pair, 0) + (pair.plane ? 0.0 : 1.0 / inertiaAboutContact(pair, 1));
  return 2.0 * std::sqrt(stiffness / inverse);
}

}  // namespace crossgrain::inline contact_law
