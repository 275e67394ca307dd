#pragma once

#include "engines/grain/contact_force.hpp"

namespace grain {

/// A vector in space.
template <class Real>
struct Vec3 {
  Real x{}, y{}, z{};

  Vec3& operator+=(const Vec3& b) { return *this = {x + b.x, y + b.y, z + b.z}; }
  Vec3& operator-=(const Vec3& b) { return *this = {x - b.x, y - b.y, z - b.z}; }
  friend Vec3 operator+(Vec3 a, const Vec3& b) { return a += b; }
  friend Vec3 operator-(Vec3 a, const Vec3& b) { return a -= b; }
  friend Vec3 operator*(Real s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
};
template <class Real>
Real dot(const Vec3<Real>& a, const Vec3<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
Vec3<Real> cross(const Vec3<Real>& a, const Vec3<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Real>
Real length(const Vec3<Real>& a) {
  return squareRoot(dot(a, a));
}

/// How ξ follows a normal that turned from n to n′, before it is stretched: by the smallest
/// rotation from n to n′; by that to first order (YADE: ScGeom::rotate); less its part along n′,
/// and then to the old length (LAMMPS' pair_style granular) or not (gran/hooke/history).
enum class SpringTurn { rotated, firstOrder, rescaled, projected };
/// Whether ξ turns with a pair that turns about n, by ½(ω_i + ω_j)·n dt.
enum class SpringTwist { meanSpin, none };

/// What engines differ in that have the same law in space.
struct SpaceConventions {
  SpringTurn turn = SpringTurn::rotated;
  SpringTwist twist = SpringTwist::meanSpin;
};

/// ξ in the tangent plane of `now` that was in that of `before`, both of length 1.
template <class Real>
Vec3<Real> turnedSpring(SpringTurn how, const Vec3<Real>& spring, const Vec3<Real>& before,
                        const Vec3<Real>& now) {
  const Vec3<Real> w = cross(before, now);
  if (how == SpringTurn::firstOrder) return spring + cross(w, spring);
  if (how == SpringTurn::rotated) {  // Rodrigues' formula, |w| = sin θ, n·n′ = cos θ
    const Vec3<Real> first = cross(w, spring);
    return spring + first + (Real(1) / (Real(1) + dot(before, now))) * cross(w, first);
  }
  const Vec3<Real> inPlane = spring - dot(spring, now) * now;
  const Real left = length(inPlane);
  if (how == SpringTurn::projected || !(left > Real(0))) return inPlane;
  return (length(spring) / left) * inPlane;
}

/// ξ turned by a small angle about the normal; with SpringTurn::firstOrder to first order, too.
template <class Real>
Vec3<Real> twistedSpring(SpringTurn how, const Vec3<Real>& spring, const Vec3<Real>& normal,
                         Real angle) {
  const Vec3<Real> aside = cross(normal, spring);
  if (how == SpringTurn::firstOrder) return spring + angle * aside;
  return Real(__builtin_cos(angle)) * spring + Real(__builtin_sin(angle)) * aside;
}

template <class Real>
struct SpaceForce {
  Real normal;            ///< f_n [N]
  Vec3<Real> tangential;  ///< f_t on i, in the tangent plane [N]
  bool sliding;           ///< Coulomb's bound holds
};

/// The force on i: springForce() of contact_force.hpp with directions in place of signs. The normal
/// part, the bound and all conventions are those functions' own.
/// @param contact  its tangentialVelocity is not read
/// @param slip     v_t [m/s]
/// @param spring   ξ, in the tangent plane of this instant; kept as long as the contact lasts [m]
/// @pre a linear law with constant dampers, without friction or with springs
template <class L, class Real>
SpaceForce<Real> spaceForce(const L& law, const ContactMotion<Real>& contact,
                            const Vec3<Real>& slip, Vec3<Real>& spring) {
  const Real normal = normalForce(law, contact, elasticForce(law, contact));
  if (law.tangential == Tangential::none) return {normal, {}, false};
  const Real bound = coulombBound(law, normal);
  const Vec3<Real> stretch = law.dt * slip;
  const Real part = law.stretch == Stretch::after    ? Real(0)
                    : law.stretch == Stretch::before ? Real(1)
                                                     : Real(0.5);
  const Vec3<Real> stretched = spring + part * stretch;
  const Vec3<Real> elastic = -law.kt * stretched;
  Vec3<Real> viscous{};
  if (law.tangential == Tangential::springDashpot) viscous = -law.gt * slip;
  Vec3<Real> trial = elastic + viscous;
  if (law.implicitDamping && law.tangential == Tangential::springDashpot)
    trial = (Real(1) / (Real(1) + law.gt * contact.tangentialCompliance)) * trial;
  const Vec3<Real>& tested = law.dashpotOutsideBound ? elastic : trial;
  const Real size = length(tested);
  if (size <= bound) {
    spring = stretched + (Real(1) - part) * stretch;
    return {normal, trial, false};
  }
  // A bound below zero turns the force round; of no force it has no direction.
  const Vec3<Real> slipping = size > Real(0) ? (bound / size) * tested : Vec3<Real>{};
  spring = -law.inverseKt * (law.resetSpringOnly ? slipping - viscous : slipping);
  if (law.stretch == Stretch::midpoint) spring += Real(0.5) * stretch;
  return {normal, slipping, true};
}

}  // namespace grain
