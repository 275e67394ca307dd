#pragma once

#include "engines/grain/contact_force.hpp"

namespace grain {

/// A vector in space.
template <class Real>
struct Vec3 {
  Real x{}, y{}, z{};

  GRAIN_INLINE Vec3& operator+=(const Vec3& b) { return *this = {x + b.x, y + b.y, z + b.z}; }
  GRAIN_INLINE Vec3& operator-=(const Vec3& b) { return *this = {x - b.x, y - b.y, z - b.z}; }
  bool operator==(const Vec3&) const = default;
  GRAIN_INLINE friend Vec3 operator+(Vec3 a, const Vec3& b) { return a += b; }
  GRAIN_INLINE friend Vec3 operator-(Vec3 a, const Vec3& b) { return a -= b; }
  GRAIN_INLINE friend Vec3 operator*(Real s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
};
template <class Real>
GRAIN_INLINE Real dot(const Vec3<Real>& a, const Vec3<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
GRAIN_INLINE Vec3<Real> cross(const Vec3<Real>& a, const Vec3<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Real>
GRAIN_INLINE Real length(const Vec3<Real>& a) {
  return squareRoot(dot(a, a));
}
template <class Real>
GRAIN_INLINE bool isZero(const Vec3<Real>& a) {
  return a.x == Real(0) && a.y == Real(0) && a.z == Real(0);
}

template <class Real>
GRAIN_INLINE Vec3<Real> either(bool first, const Vec3<Real>& a, const Vec3<Real>& b) {
  return {first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z};
}

template <class Real>
GRAIN_INLINE Vec3<Real> operator-(const Vec3<Real>& a) {
  return {-a.x, -a.y, -a.z};
}

/// `some`, or `all` of it and a further part.
template <class Real>
GRAIN_INLINE Vec3<Real> plusShare(const Vec3<Real>& some, const Vec3<Real>& all, bool share,
                                  const Vec3<Real>&) {
  return either(share, all, some);
}
template <class Real>
GRAIN_INLINE Vec3<Real> plusShare(const Vec3<Real>& some, const Vec3<Real>&, Real share,
                                  const Vec3<Real>& part) {
  return some + share * part;
}

/// Differences of engines that have the same law in space.
struct SpaceConventions {
  SpringTurn turn = SpringTurn::rotated;
  SpringTwist twist = SpringTwist::meanSpin;

  bool operator==(const SpaceConventions&) const = default;
};
inline SpaceConventions spaceConventions(const ContactLaw& law) {
  return {law.conventions.springTurn, law.conventions.springTwist};
}

/// ξ in the tangent plane of `now` that was in that of `before`, both of length 1.
template <class Real>
GRAIN_INLINE Vec3<Real> turnedSpring(SpringTurn how, const Vec3<Real>& spring,
                                     const Vec3<Real>& before, const Vec3<Real>& now) {
  const Vec3<Real> w = cross(before, now);
  if (how == SpringTurn::firstOrder) return spring + cross(w, spring);
  if (how == SpringTurn::rotated) {  // Rodrigues' formula, |w| = sin θ, n·n′ = cos θ
    const Vec3<Real> first = cross(w, spring);
    return spring + first + (Real(1) / (Real(1) + dot(before, now))) * cross(w, first);
  }
  const Vec3<Real> inPlane = spring - dot(spring, now) * now;
  if (how == SpringTurn::projected) return inPlane;
  const Real left = length(inPlane);
  return (left > Real(0) ? length(spring) / left : Real(1)) * inPlane;
}

/// ξ turned by a small angle about the normal; with SpringTurn::firstOrder to first order. Of
/// tan(angle/2) = p/q, the fourth convergent of Lambert's continued fraction, within 1e-12 of
/// itself up to 0.15, cos = (q² − p²)/(q² + p²) and sin = 2 p q/(q² + p²): ξ keeps its length, and
/// products and a quotient are the same bits everywhere.
template <class Real>
GRAIN_INLINE Vec3<Real> twistedSpring(SpringTurn how, const Vec3<Real>& spring,
                                      const Vec3<Real>& normal, Real angle) {
  const Vec3<Real> aside = cross(normal, spring);
  if (how == SpringTurn::firstOrder) return spring + angle * aside;
  const Real half = Real(0.5) * angle, square = half * half;
  const Real p = half * (Real(105) - Real(10) * square);
  const Real q = Real(105) - Real(45) * square + square * square;
  const Real whole = Real(1) / (q * q + p * p);
  return ((q * q - p * p) * whole) * spring + (Real(2) * p * q * whole) * aside;
}

/// Memory of a contact from step to step. Its vectors lie in the tangent plane of `normal`.
template <class Real>
struct SpaceMemory {
  Vec3<Real> normal{};           ///< of the last step in which it touched
  Vec3<Real> spring{}, angle{};  ///< ξ, θ
  Real memory{}, rest{};         ///< as of contactForce()
};

/// Two bodies that meet, or a sphere and a wall, for which what is j's is 0 but its velocity.
template <class Real>
struct Meeting {
  Vec3<Real> normal;    ///< from j to i
  Vec3<Real> velocity;  ///< of i relative to j, of the centres or of the wall's point [m/s]
  Vec3<Real> spinI, spinJ;
  Real overlap;
  Real radiusI, radiusJ;  ///< a_j = 0: a wall
  Real leverI, leverJ;    ///< arms of the force
  Real armI, armJ;        ///< arms of the spins in v_t
  Real inverseMass;       ///< the sum of both
  Real inverseMassI, inverseMassJ, inverseInertiaI, inverseInertiaJ;
};

/// Levers and arms of two spheres; and of one on a plane, its centre `height` above it.
template <class L, class Real>
GRAIN_INLINE void setArms(const L& law, Meeting<Real>& of) {
  of.leverI = armOf(law.lever, of.radiusI, of.radiusJ, of.overlap);
  of.leverJ = armOf(law.lever, of.radiusJ, of.radiusI, of.overlap);
  of.armI = armOf(law.velocityLever, of.radiusI, of.radiusJ, of.overlap);
  of.armJ = armOf(law.velocityLever, of.radiusJ, of.radiusI, of.overlap);
}
template <class L, class Real>
GRAIN_INLINE void setArms(const L& law, Meeting<Real>& of, Real height) {
  of.leverI = planeArmOf(law.lever, law.planeLever, of.radiusI, height);
  of.armI = planeArmOf(law.velocityLever, law.planeLever, of.radiusI, height);
}

/// Action on both: force on i, −force on j; torques on each about its own centre.
template <class Real>
struct MeetingForce {
  Real normal;                     ///< f_n
  Vec3<Real> tangential, rolling;  ///< f_t on i; M on i, −M on j
  Vec3<Real> force, torqueI, torqueJ;
  Real sliding;
};

/// f* within the bound, else bound·f*/|f*|; the spring is what is left of it: springForce() of
/// contact_force.hpp with directions in place of signs.
/// @param unit     force per spring  @param inverse 1/unit, or 0
/// @param stretch  what the spring grows by in a step
/// @tparam Share  of an option that is known bool, of one that is a number of LawOptions that
template <class Real, class Share>
struct SpringLimit {
  SpringUpdate when;
  Real unit, inverse, bound;
  bool limited;
  Share dashpotTested, dashpotLeftOut;  ///< against the bound; of the spring where it slips
  Real divisor;                         ///< of implicit damping

  GRAIN_INLINE Vec3<Real> force(Vec3<Real>& spring, const Vec3<Real>& stretch,
                                const Vec3<Real>& viscous, Real& sliding) const {
    const Real part = partBefore<Real>(when);
    const Vec3<Real> stretched = spring + part * stretch;
    const Vec3<Real> elastic = -unit * stretched;
    Vec3<Real> trial = elastic + viscous;
    if (divisor != Real(1)) trial = (Real(1) / divisor) * trial;
    const Vec3<Real> tested = plusShare(elastic, trial, dashpotTested, viscous);
    const Real size = length(tested);
    // Choices of numbers and not of ways to go, so that contacts can be taken side by side.
    const bool holds = !limited || size <= bound;
    // A bound below zero turns the force round; of no force it has no direction.
    const Vec3<Real> slipping = (size > Real(0) ? bound / size : Real(0)) * tested;
    Vec3<Real> slipped =
        -inverse * plusShare(slipping, slipping - viscous, dashpotLeftOut, -viscous);
    if (when == SpringUpdate::midpoint) slipped += Real(0.5) * stretch;
    spring = either(holds, stretched + (Real(1) - part) * stretch, slipped);
    sliding = holds ? Real(0) : Real(1);
    return either(holds, trial, slipping);
  }
};

/// f_t on i. @param slip  v_t [m/s]
template <class L, class Real>
GRAIN_INLINE Vec3<Real> tangentialForce(const L& law, const ContactMotion<Real>& contact,
                                        const Vec3<Real>& slip, Real load, Vec3<Real>& spring,
                                        Real& sliding) {
  const Real bound = coulombBound(law, load);
  if (law.tangential == TangentialLaw::coulomb || law.tangential == TangentialLaw::viscous) {
    const Real speed = length(slip);
    Real size = bound;
    sliding = Real(1);
    if (law.tangential == TangentialLaw::viscous) {
      const Real gt = tangentialDamping(law, contact);
      Real trial = gt * speed;
      if (law.implicitDamping) trial /= Real(1) + gt * contact.tangentialCompliance;
      size = smaller(trial, bound);
      sliding = trial > bound ? Real(1) : Real(0);
    }
    return (speed > Real(0) ? -size / speed : Real(0)) * slip;
  }
  // With History::force the spring is the force itself: one unit of it per unit.
  const bool force = law.history == History::force;
  const Real stiffness = tangentialStiffness(law, contact);
  Real inverse = law.inverseKt;
  if (force) inverse = Real(1);
  if (law.normal == NormalLaw::hertz && !force)
    inverse = stiffness > Real(0) ? Real(1) / stiffness : Real(0);
  const Vec3<Real> stretch = (force ? stiffness * law.dt : law.dt) * slip;
  Vec3<Real> viscous{};
  Real divisor = Real(1);
  if (law.tangential == TangentialLaw::springDashpot) {
    const Real gt = tangentialDamping(law, contact);
    viscous = -gt * slip;
    if (law.implicitDamping) divisor += gt * contact.tangentialCompliance;
  }
  const SpringLimit<Real, bool> limit{law.stretch,
                                      force ? Real(1) : stiffness,
                                      inverse,
                                      bound,
                                      true,
                                      !law.dashpotOutsideBound,
                                      law.resetSpringOnly,
                                      divisor};
  return limit.force(spring, stretch, viscous, sliding);
}

/// M on i, of the relative spin that rolls: ω_i − ω_j less its part along n, which twists.
/// rollingTorque() of contact_force.hpp with directions in place of signs.
template <class L, class Real>
GRAIN_INLINE Vec3<Real> rollingResistance(const L& law, const Meeting<Real>& meeting,
                                          const ContactMotion<Real>& contact, Real load,
                                          Vec3<Real>& angle) {
  const Vec3<Real> relative = meeting.spinI - meeting.spinJ;
  const Vec3<Real> spin = relative - dot(relative, meeting.normal) * meeting.normal;
  RollingMotion<Real> motion = rollingMotion(law, meeting.radiusI, meeting.radiusJ, Real(0));
  const Real bound = rollingBound(law, motion, contact, load);
  if (law.rolling != RollingLaw::spring) {
    const Real viscous = law.viscous * (law.gr * motion.length * motion.length) +
                         law.viscousByLoad * (bound * motion.length);
    const Real size = length(spin), constant = law.constantTorque * bound;
    return (-viscous - (size > Real(0) ? constant / size : Real(0))) * spin;
  }
  if (seesRollingInertia(law))
    motion.inertia =
        Real(1) /
        (inverseRollingInertia(meeting.inverseMassI, meeting.inverseInertiaI, meeting.radiusI) +
         inverseRollingInertia(meeting.inverseMassJ, meeting.inverseInertiaJ, meeting.radiusJ));
  const Real stiffness = law.kr * motion.square;
  Real sliding;
  const SpringLimit<Real, Real> limit{
      law.stretch,           stiffness,         Real(1) / stiffness, bound,
      bound > law.unlimited, law.dashpotTested, law.dashpotLeftOut,  Real(1)};
  return limit.force(angle, law.dt * spin, -rollingDamping(law, motion) * spin, sliding);
}

/// Springs of the last step in the tangent plane of this one.
template <class L, class Real>
GRAIN_INLINE void followNormal(const L& law, const SpaceConventions& how,
                               const Meeting<Real>& meeting, SpaceMemory<Real>& kept) {
  const Vec3<Real> before = kept.normal, now = meeting.normal;
  const bool first = how.turn == SpringTurn::firstOrder;
  const Vec3<Real>& about = first ? before : now;
  const bool twists = how.twist == SpringTwist::meanSpin && law.rotation;
  const Real twist =
      twists ? Real(0.5) * law.dt * dot(meeting.spinI + meeting.spinJ, about) : Real(0);
  const auto follow = [&](Vec3<Real>& spring) GRAIN_INLINE_LAMBDA {
    spring = turnedSpring(how.turn, spring, before, now);
    if (twists) spring = twistedSpring(how.turn, spring, about, twist);
  };
  if (hasSprings(law)) follow(kept.spring);
  if (law.rolling == RollingLaw::spring) follow(kept.angle);
}

/// v_t
template <class L, class Real>
GRAIN_INLINE Vec3<Real> slipOf(const L& law, const Meeting<Real>& meeting) {
  const Vec3<Real>& n = meeting.normal;
  Vec3<Real> slip = meeting.velocity - dot(meeting.velocity, n) * n;
  if (law.rotation) slip -= cross(meeting.armI * meeting.spinI + meeting.armJ * meeting.spinJ, n);
  return slip;
}

/// View of it for the scalar parts of the law.
template <class L, class Real>
GRAIN_INLINE ContactMotion<Real> motionOf(const L& law, const Meeting<Real>& meeting) {
  ContactMotion<Real> motion{};
  motion.overlap = meeting.overlap;
  const bool wall = !(meeting.radiusJ > Real(0));
  motion.reach = wall ? Real(0) : meeting.radiusI + meeting.radiusJ;
  motion.radius = wall ? meeting.radiusI : meeting.radiusI * meeting.radiusJ / motion.reach;
  if (law.damper == Damper::critical) motion.mass = Real(1) / meeting.inverseMass;
  motion.normalVelocity = dot(meeting.velocity, meeting.normal);
  motion.normalCompliance = law.halfStep * meeting.inverseMass;
  motion.tangentialCompliance = motion.normalCompliance;
  if (law.rotation)
    motion.tangentialCompliance +=
        law.halfStep * (meeting.armI * meeting.leverI * meeting.inverseInertiaI +
                        meeting.armJ * meeting.leverJ * meeting.inverseInertiaJ);
  return motion;
}

/// The law in space, of a pair that touches. @param kept  zero when it begins to
template <class L, class Real>
GRAIN_INLINE MeetingForce<Real> meetingForce(const L& law, const SpaceConventions& how,
                                             const Meeting<Real>& meeting,
                                             SpaceMemory<Real>& kept) {
  const Vec3<Real>& n = meeting.normal;
  const bool friction = law.tangential != TangentialLaw::none;
  const bool rolls = law.rotation && law.rolling != RollingLaw::none;
  const ContactMotion<Real> motion = motionOf(law, meeting);
  if (hasSprings(law) || law.rolling == RollingLaw::spring) followNormal(law, how, meeting, kept);
  kept.normal = n;

  const Real body = remembersRest(law) ? laggedPlasticForce(law, motion, kept.memory, kept.rest)
                                       : bodyForce(law, motion, kept.memory);
  MeetingForce<Real> found{};
  found.normal = normalForce(law, motion, body);
  found.force = found.normal * n;
  if (!friction && !rolls) return found;
  const Real load = boundLoad(law, motion, found.normal, body);
  if (friction) {
    const Vec3<Real> slip = slipOf(law, meeting);
    found.tangential = tangentialForce(law, motion, slip, load, kept.spring, found.sliding);
    found.force += found.tangential;
    if (!law.rotation) return found;
    const Vec3<Real> couple = cross(n, found.tangential);
    found.torqueI = -meeting.leverI * couple;
    found.torqueJ = -meeting.leverJ * couple;
  }
  if (!rolls) return found;
  found.rolling = rollingResistance(law, meeting, motion, load, kept.angle);
  found.torqueI += found.rolling;
  found.torqueJ -= found.rolling;
  return found;
}

}  // namespace grain
