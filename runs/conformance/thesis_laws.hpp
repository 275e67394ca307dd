#pragma once

#include "adapters/contact_law.hpp"
#include "runs/conformance/thesis_numbers.hpp"

/// Contact laws that checks and tests share.
namespace crossgrain::conformance {

/// Lätzel (2003), Table 4.1; every convention at its default, the thesis' own.
inline ContactLaw thesisLaw(TangentialLaw tangential = TangentialLaw::springDashpot) {
  ContactLaw law = withThesisConstants(ContactLaw{});
  law.tangential = tangential;
  return law;
}

/// Impulses with restitutions e_n and e_t0 and Coulomb's µ.
inline ContactLaw rigidLaw(double en, double et0, double mu) {
  ContactLaw law;
  law.normal = NormalLaw::rigid;
  law.en = en;
  law.et0 = et0;
  law.mu = mu;
  return law;
}

/// Hertz' law between alike bodies, 1/E₁₂ = 2 (1 − ν²)/E, with critical dampers; as stiff as the
/// thesis' law where small disks meet at 0.1 m/s.
inline ContactLaw hertzLaw() {
  ContactLaw law;
  law.normal = NormalLaw::hertz;
  law.damper = Damper::critical;
  law.kn = 7e5;
  law.kt = 1.2 * law.kn;  // ν = 1/3
  law.gn = 0.3;
  law.gt = 0.2;
  law.mu = thesis.mu;
  return law;
}

}  // namespace crossgrain::conformance
