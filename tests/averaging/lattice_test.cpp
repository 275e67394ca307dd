#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "averaging/fields.hpp"
#include "tests/averaging/scenes.hpp"

namespace crossgrain {
namespace {

using test::Instant;

constexpr double pi = std::numbers::pi;
constexpr double a = 0.0037;

Rings wideRings() {
  return {0.1032, 0.2524, 4, 0.006, 0.0074};
}

/// All lattice points m·e1 + n·e2 within 0.28 m of the origin; neighbours along each of `bonds`
/// (in units of e1, e2) push on each other with the force given.
struct Bond {
  int m, n;
  double force;
};

Instant lattice(const Vec2& e1, const Vec2& e2, const std::vector<Bond>& bonds) {
  constexpr int reach = 80;
  Instant instant;
  std::vector<std::int32_t> index(4 * reach * reach, -1);
  const auto slot = [&](int m, int n) {
    return static_cast<std::size_t>((m + reach) * 2 * reach + n + reach);
  };
  for (int m = -reach; m < reach; ++m)
    for (int n = -reach; n < reach; ++n) {
      const Vec2 x = m * e1 + n * e2;
      if (x.norm() > 0.28) continue;
      index[slot(m, n)] = static_cast<std::int32_t>(instant.scene.disks.size());
      instant.addDisk(x, a);
    }
  for (int m = -reach + 1; m < reach - 1; ++m)
    for (int n = -reach + 1; n < reach - 1; ++n)
      for (const Bond& bond : bonds) {
        const std::int32_t here = index[slot(m, n)];
        const std::int32_t there = index[slot(m + bond.m, n + bond.n)];
        if (here < 0 || there < 0) continue;
        const Vec2 outward = (bond.m * e1 + bond.n * e2).normalized();
        const bool first = here < there;
        instant.addContact(first ? here : there, first ? there : here,
                           first ? Vec2(-outward) : outward, bond.force, 0.0);
      }
  return instant;
}

double valueOf(const char* field, const Rings& rings, const std::vector<Moments>& moments,
               int ring) {
  return evaluate(fieldSpec(field), moments[rings.slot(ring)], rings.volume(ring)).value().value;
}

TEST(Lattice, TriangularUnderEqualForcesIsAPressure) {
  constexpr double force = 1e-3;
  const Rings rings = wideRings();
  const auto moments =
      test::momentsOf(rings, lattice({2.0 * a, 0.0}, {a, std::sqrt(3.0) * a},
                                     {{1, 0, force}, {0, 1, force}, {-1, 1, force}}));
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
  const auto moments =
      test::momentsOf(rings, lattice({2.0 * a, 0.0}, {0.0, 2.0 * a}, {{1, 0, fx}, {0, 1, fy}}));
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
