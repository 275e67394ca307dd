#pragma once

#include <vector>

#include "tests/averaging/scenes.hpp"

namespace crossgrain::test {

/// Neighbours along m·e1 + n·e2 push on each other with that force [N].
struct Bond {
  int m, n;
  double force;
};

/// Disks of radius a on all lattice points m·e1 + n·e2 within 0.28 m of the origin.
Instant lattice(double a, const Vec2& e1, const Vec2& e2, const std::vector<Bond>& bonds);

/// Touching disks, six neighbours each, equal forces.
Instant triangularLattice(double a, double force);

}  // namespace crossgrain::test
