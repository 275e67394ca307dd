#pragma once

#include "law/contact_reference.hpp"

namespace crossgrain::inline oracle {

/// The linear law as a pair of that mass sees it, its dampers turned into constant ones: γ k
/// (Damper:: viscoelastic) or γ √(m₁₂ k) (critical). Other laws: unchanged. @param reducedMass m₁₂
/// [kg]
ContactLaw withConstantDampers(ContactLaw law, double reducedMass);

/// Duration of a contact of the linear law with tension, t_c = π/ω with ω² = k_n/m₁₂ − η² and
/// η = γ_n/(2 m₁₂) (Lätzel 2003, section 4.1; facts: 2.18 ms for two small disks) [s].
/// @param reducedMass m₁₂ [kg]
/// @throws std::invalid_argument for other laws, and an overdamped one
double contactTime(const ContactLaw& law, double reducedMass);

/// The elastic part of an impact, of any soft law.
struct Impact {
  double reducedMass;    ///< m₁₂ [kg]
  double reducedRadius;  ///< R₁₂ [m]
  double speed;          ///< v_n [m/s]
};

/// Deepest overlap without damping, where the work of f_el is the kinetic energy [m]. Hertz:
/// (15 m₁₂ v²/(16 E₁₂ √R₁₂))^(2/5).
/// @throws std::invalid_argument for a rigid law, and a polynomial one that gives way
double deepestOverlap(const ContactLaw& law, const Impact& impact);

/// ∫ f_el dδ: what the normal spring of a soft law holds at an overlap [J].
/// @param reducedRadius  R₁₂; linear and polynomial laws do not ask for it [m]
double elasticEnergy(const ContactLaw& law, double reducedRadius, double overlap);

/// Of contacts that cohere, in units of impactTime(): what lasts longer counts as a pair that does
/// not part.
constexpr double longestContact = 10.0;

/// How long an impact lasts [s]: contactTime() of a linear law; of one that stiffens its elastic
/// part, T = 2 ∫ dδ/√(v² − 2 W(δ)/m₁₂), for Hertz 2.9432 δ_max/v (Johnson 1985, Eq. 11.24).
/// Under DMT and JKR that of bodies which also come with what their attraction gives them, F_po
/// over the overlap that balances it: else the slowest would seem to take for ever.
double impactTime(const ContactLaw& law, const Impact& impact);

}  // namespace crossgrain::inline oracle
