#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "averaging/fields.hpp"
#include "tests/averaging/lattice.hpp"
#include "tests/support/thesis.hpp"

namespace crossgrain {
namespace {

using test::valueOf;

constexpr double pi = std::numbers::pi;
constexpr double a = test::smallRadius;

Rings wideRings() {
  return {0.1032, 0.2524, 4, 0.006, 0.0074};
}

TEST(Lattice, TriangularUnderEqualForcesIsAPressure) {
  constexpr double force = 1e-3;
  const Rings rings = wideRings();
  const auto moments = test::momentsOf(rings, test::triangularLattice(a, force));
  for (int ring = 0; ring < rings.count(); ++ring) {
    // Six contacts: −Σ f⊗l = 3 f a I in each disk of volume π a² h, so σ = 3f/(π a h) ν, exactly.
    const double nu = valueOf("volume_fraction", rings, moments, ring);
    const double exact = 3.0 * force / (pi * a * rings.height()) * nu;
    EXPECT_NEAR(valueOf("stress_rr", rings, moments, ring), exact, 1e-12 * exact);
    EXPECT_NEAR(valueOf("stress_pp", rings, moments, ring), exact, 1e-12 * exact);
    EXPECT_NEAR(valueOf("stress_rp", rings, moments, ring), 0.0, 1e-12 * exact);
    EXPECT_NEAR(valueOf("stress_pr", rings, moments, ring), 0.0, 1e-12 * exact);
    EXPECT_NEAR(valueOf("coordination", rings, moments, ring), 6.0, 1e-12);
    // The continuum: ν = π/2√3, p = (√3/2) f/(a h). Rings of 10 a cut the lattice at random: 1 %.
    EXPECT_NEAR(nu, pi / std::sqrt(12.0), 0.01);
    const double pressure = std::sqrt(3.0) / 2.0 * force / (a * rings.height());
    EXPECT_NEAR(valueOf("stress_rr", rings, moments, ring) / pressure, 1.0, 0.01);
  }
}

TEST(Lattice, SquareUnderUnequalForcesAveragesOverTheAngle) {
  constexpr double fx = 3e-3, fy = 1e-3;
  const Rings rings = wideRings();
  const auto moments = test::momentsOf(
      rings, test::lattice(a, {2.0 * a, 0.0}, {0.0, 2.0 * a}, {{1, 0, fx}, {0, 1, fy}}));
  // σ_xx = f_x/(2 a h), σ_yy = f_y/(2 a h); over all angles σ_rr and σ_φφ are both their mean.
  const double mean = (fx + fy) / 2.0 / (2.0 * a * rings.height());
  for (int ring = 0; ring < rings.count(); ++ring) {
    EXPECT_NEAR(valueOf("stress_rr", rings, moments, ring) / mean, 1.0, 0.01);
    EXPECT_NEAR(valueOf("stress_pp", rings, moments, ring) / mean, 1.0, 0.01);
    EXPECT_NEAR(valueOf("stress_rp", rings, moments, ring) / mean, 0.0, 0.01);
    // The trace knows no direction: exact up to ν.
    const double nu = valueOf("volume_fraction", rings, moments, ring);
    const double trace = 2.0 * (fx + fy) / (pi * a * rings.height()) * nu;
    EXPECT_NEAR(
        valueOf("stress_rr", rings, moments, ring) + valueOf("stress_pp", rings, moments, ring),
        trace, 1e-12 * trace);
  }
}

}  // namespace
}  // namespace crossgrain
