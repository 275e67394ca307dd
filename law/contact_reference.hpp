#pragma once

#include <algorithm>
#include <cmath>

#include "law/contact_law.hpp"

/// The force of one contact as the texts of the laws have it, by its overlap and lengths alone: the
/// reference that audits of snapshots, the oracle's equations of motion and its schemes in steps
/// are made of. Engines have code of their own and are compared with it. With cohesion.hpp.
namespace crossgrain::inline contact_law {

/// Two disks or spheres, free but for each other, or one and a plane wall that moves at a constant
/// velocity.
struct CollidingPair {
  double radius[2];    ///< [m]; 0 of a wall
  double mass[2];      ///< [kg]; inf of a wall
  double inertia[2];   ///< [kg m²]; inf of a wall
  bool plane = false;  ///< the second is a plane: the normal does not turn

  double reducedMass() const;    ///< m₁₂ [kg]
  double reducedRadius() const;  ///< R₁₂ = a_i a_j/(a_i + a_j), a_i on a plane [m]
  /// dv_t/dt of the contact point per tangential force, 1/m₁₂ + Σ a²/J = K/m₁₂ [1/kg]
  double tangentialCompliance() const;
};

/// A disk and a plane wall.
CollidingPair diskOnWall(double radius, double mass, double inertia);

/// The part of the overlap that an arm of body `side` (0 or 1) is short of its radius. A plane does
/// not turn; `plane` says where the contact point lies on it.
double leverFraction(LeverArm arm, PlaneArm plane, const CollidingPair& pair, int side);

/// Share of a step's motion v_t dt, or of rolling, that a spring has been stretched by when its
/// force is evaluated in that step [-]: 0 (after), 1/2 (midpoint) or 1 (before).
double stretchedShare(SpringUpdate when);

/// L of rolling resistance [m], and what the constant k_r is times, L², a_i a_j [m²] or 1.
/// @see RollingLength, RollingStiffness
double rollingLength(const ContactLaw& law, const CollidingPair& pair);
double rollingSquare(const ContactLaw& law, const CollidingPair& pair);
/// The factor of γ_r in the dashpot: L² [m²], or 2 √(I_c K) of a rolling spring with a critical
/// damper, 1/I_c = Σ 1/(J + m a²) [N m s]. @param stiffness  K of the spring [N m]
double rollingDamperUnit(const ContactLaw& law, const CollidingPair& pair, double stiffness);

/// J + m a² of one body, which turns about the contact [kg m²].
double inertiaAboutContact(const CollidingPair& pair, int side);

/// A function of the overlap and its derivative.
template <class Real>
struct SlopeOf {
  Real value, rate;
};

/// f_el(δ) [N]; Hertz' and the polynomial are 0 for δ < 0. @param reducedRadius  R₁₂ [m]
template <class Real>
Real elasticForce(const ContactLaw& law, Real reducedRadius, Real overlap) {
  const Real depth = std::max(overlap, Real(0)), kn = law.kn;
  switch (law.normal) {
    case NormalLaw::linear:
      return kn * overlap;
    case NormalLaw::hertz:
      return kn * std::sqrt(reducedRadius * depth) * depth;
    case NormalLaw::polynomial:
      return (kn + Real(law.kn3) * depth) * depth * depth;
    case NormalLaw::rigid:
      break;
  }
  return Real(0);
}

/// f_el′ and f_el″.
template <class Real>
SlopeOf<Real> normalStiffness(const ContactLaw& law, Real reducedRadius, Real overlap) {
  const Real depth = std::max(overlap, Real(0)), kn = law.kn, kn3 = law.kn3;
  switch (law.normal) {
    case NormalLaw::linear:
      return {kn, Real(0)};
    case NormalLaw::hertz: {
      const Real root = std::sqrt(reducedRadius * depth);
      return {Real(1.5) * kn * root, depth > Real(0) ? Real(0.75) * kn * root / depth : Real(0)};
    }
    case NormalLaw::polynomial:
      return {(Real(2) * kn + Real(3) * kn3 * depth) * depth, Real(2) * kn + Real(6) * kn3 * depth};
    case NormalLaw::rigid:
      break;
  }
  return {Real(0), Real(0)};
}

/// γ [kg/s] of a dashpot, by the stiffness that its damper looks at. @param inverseMass  1/m₁₂
template <class Real>
SlopeOf<Real> dashpot(Damper damper, double constant, const SlopeOf<Real>& stiffness,
                      Real inverseMass) {
  switch (damper) {
    case Damper::viscoelastic:
      return {Real(constant) * stiffness.value, Real(constant) * stiffness.rate};
    case Damper::critical: {
      const Real value =
          Real(constant) * std::sqrt(std::max(stiffness.value, Real(0)) / inverseMass);
      return {value, stiffness.value > Real(0)
                         ? Real(0.5) * value * stiffness.rate / stiffness.value
                         : Real(0)};
    }
    case Damper::constant:
      break;
  }
  return {Real(constant), Real(0)};
}

/// The same where its derivative is not asked for; 0 where the contact does not resist.
/// @param constant  of the law, in the unit of its damper  @param stiffness  [N/m]
inline double dampingOf(Damper damper, double constant, double stiffness, double reducedMass) {
  return dashpot(damper, constant, {stiffness, 0.0}, 1.0 / reducedMass).value;
}

}  // namespace crossgrain::inline contact_law
