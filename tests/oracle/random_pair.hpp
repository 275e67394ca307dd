#pragma once

#include "cases/case.hpp"
#include "tests/support/draw.hpp"

namespace crossgrain::test {

/// Radii up to 1 : 10, masses up to 1 : 1000, factors q of the inertia from 0.4 to 0.5.
inline void drawPair(Draw& draw, Collision& to) {
  to.radius[0] = 1e-3 * draw.logarithmic(1.0, 10.0);
  to.radius[1] = 1e-3 * draw.logarithmic(1.0, 10.0);
  to.mass[0] = 1e-4;
  to.mass[1] = 1e-4 * draw.logarithmic(1.0, 1000.0);
  to.inertiaFactor = draw.uniform(0.4, 0.5);
}

}  // namespace crossgrain::test
