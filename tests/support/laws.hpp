#pragma once

#include "runs/conformance/conformance_scenes.hpp"

namespace crossgrain::test {
using namespace crossgrain::conformance;

/// Impulses with restitutions e_n and e_t0 and Coulomb's µ.
inline ContactLaw rigidLaw(double en, double et0, double mu) {
  ContactLaw law;
  law.normal = NormalLaw::rigid;
  law.en = en;
  law.et0 = et0;
  law.mu = mu;
  return law;
}

}  // namespace crossgrain::test
