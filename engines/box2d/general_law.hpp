#pragma once

#include "engines/box2d/soft_law.hpp"

namespace box2d_granular {

// The whole law, decided at run time: Hertz, dampers, rolling resistance, cohesion. Of linear laws
// without these contactForce() is the same and faster.

/// Motion of one contact that the law sees.
struct PairMotion {
  double overlap;               ///< δ, with JKR also below 0 [m]
  double normalVelocity;        ///< v_n [m/s]
  double tangentialVelocity;    ///< v_t [m/s]
  double spin;                  ///< ω_r = ω_i − ω_j [rad/s]
  double a, b;                  ///< radii; b is 0 at a plane [m]
  double mass;                  ///< m₁₂ [kg]
  double rollingInertia = 0.0;  ///< I, 1/I = Σ 1/(J + m a²) of the bodies that move [kg m²]
  double dt = 0.0;              ///< [s]

  double radius() const { return b > 0.0 ? a * b / (a + b) : a; }  ///< R₁₂
};

/// What a contact remembers.
struct PairMemory {
  double spring = 0.0;   ///< ξ [m], or the force [N]
  double angle = 0.0;    ///< θ [-]
  double largest = 0.0;  ///< elastoPlastic: the largest overlap [m]
  bool bonded = false;   ///< JKR: touched, and not parted since
};

struct PairForce {
  double normal = 0.0;      ///< f_n [N]
  double tangential = 0.0;  ///< f_t [N]
  double rolling = 0.0;     ///< M on i [N m]
  bool sliding = false;
};

/// The force on i.
PairForce pairForce(const SoftLaw& law, const PairMotion& motion, PairMemory& memory);

/// How far apart surfaces are when they part under JKR [m]; of other laws 0.
double bondRange(const SoftLaw& law, double radius);

/// Stored in a contact: of the elastic force, the springs and the bond [J].
double storedEnergy(const SoftLaw& law, const PairMotion& motion, const PairMemory& memory);

}  // namespace box2d_granular
