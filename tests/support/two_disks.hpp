#pragma once

#include "cases/case.hpp"

namespace crossgrain::test {

/// An assembly of two disks of diameter 1 m and 1 kg, 2 m apart and 2 m above the floor, for 3 s in
/// steps of 1 ms. It has no walls yet.
inline Case twoDisks() {
  Case setup;
  setup.source = Assembly();
  setup.law.normal = NormalLaw::linear;
  setup.law.kn = 100.0;
  setup.run.dt = 1e-3;
  DiskGroup group{.places = {{0.0, 2.0}, {2.0, 2.0}}, .radius = 0.5, .mass = 1.0};
  assemblyIn<2>(setup).disks = {group};
  assemblyIn<2>(setup).duration = 3.0;
  return setup;
}

}  // namespace crossgrain::test
