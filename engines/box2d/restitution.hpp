#pragma once

#include "engines/box2d/soft_law.hpp"

namespace box2d_granular {

/// Data that a rigid contact needs.
struct Restitution {
  double normal = 1.0;      ///< e_n
  double tangential = 0.0;  ///< e_t0, of a sticking contact
};

/// The inertia that a contact of i with j feels; a wall adds nothing.
struct PairInertia {
  double normal = 0.0;      ///< 1/m_i + 1/m_j = 1/m₁₂ [1/kg]
  double tangential = 0.0;  ///< 1/m_i + 1/m_j + a_i²/J_i + a_j²/J_j [1/kg]
};

/// e_n of the linear law f_n = k_n δ − γ_n v_n, with η = γ_n/(2 m₁₂) and ω² = k_n/m₁₂ − η².
/// With tension exp(−πη/ω); cut exp(−(η/ω)(π − atan2(2ηω, ω² − η²))) (Schwager & Pöschel 2007, who
/// also give the overdamped form).
double normalRestitution(const ContactLaw& law, double reducedMass);

/// One collision of the linear law with the normal held fixed, in tiny steps.
struct Rebound {
  double en;    ///< v_n,f / |v_n,i|
  double psiF;  ///< v_t,f / |v_n,i|
};
Rebound collide(const ContactLaw& law, const PairInertia& pair, double psiI);

/// The rigid contact that stands for a soft one: e_n in closed form, e_t0 = −Ψ_f/Ψ_i at Ψ_i = 0.5
/// clipped to [0, 1].
Restitution rigidEquivalent(const ContactLaw& law, const PairInertia& pair);

}  // namespace box2d_granular
