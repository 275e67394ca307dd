#pragma once

#include "studies/conformance/conformance_scenes.hpp"

namespace crossgrain::test {
using namespace crossgrain::conformance;

/// Impulses with restitutions e_n and e_t0 and Coulomb's µ.
inline ContactLaw rigidLaw(double en, double et0, double mu) {
  return ContactLaw{.normal = NormalLaw::rigid, .mu = mu, .en = en, .et0 = et0};
}

}  // namespace crossgrain::test
