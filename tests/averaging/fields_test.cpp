#include "averaging/fields.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "averaging/moments.hpp"
#include "tests/averaging/scenes.hpp"
#include "tests/support/thesis.hpp"

namespace crossgrain {
namespace {

using test::Instant;
using test::twoRings;
using test::valueOf;

using std::numbers::pi;

/// Disk 0 in ring 0 and disk 1 in ring 1, on the x axis, pushing on each other with 5 N; disk 1
/// also pushes disk 0 along −y with 2 N. Radii differ: each disk has its own branch.
Instant touchingPair() {
  Instant pair;
  pair.addDisk({1.6, 0.0}, 0.3, 2.0, {0.25, -1.5}, 3.0);
  pair.addDisk({2.4, 0.0}, 0.2, 1.0, {-0.5, 4.0}, -7.0);
  pair.addContact(0, 1, {-1.0, 0.0}, 5.0, 2.0);  // z × n = (0, −1): force on 0 is (−5, −2)
  return pair;
}

TEST(Fields, StressOfATouchingPairIsForceTimesBranchOverVolume) {
  const Rings rings = twoRings();
  const auto moments = test::momentsOf(rings, touchingPair());
  const double v0 = pi * (4.0 - 1.0) * 0.5;
  const double v1 = pi * (9.0 - 4.0) * 0.5;
  // Disk 0: f = (−5, −2), l = (0.3, 0). Disk 1: f = (5, 2), l = (−0.2, 0). −f⊗l is positive in
  // both.
  EXPECT_NEAR(valueOf("stress_rr", rings, moments, 0), 5.0 * 0.3 / v0, 1e-15);
  EXPECT_NEAR(valueOf("stress_rr", rings, moments, 1), 5.0 * 0.2 / v1, 1e-15);
  EXPECT_NEAR(valueOf("stress_pr", rings, moments, 0), 2.0 * 0.3 / v0, 1e-15);
  EXPECT_NEAR(valueOf("stress_pr", rings, moments, 1), 2.0 * 0.2 / v1, 1e-15);
  EXPECT_NEAR(valueOf("stress_rp", rings, moments, 0), 0.0, 1e-15);  // no branch along φ
  EXPECT_NEAR(valueOf("stress_pp", rings, moments, 0), 0.0, 1e-15);
}

TEST(Fields, MotionOfATouchingPair) {
  const Rings rings = twoRings();
  const auto moments = test::momentsOf(rings, touchingPair());
  const double v0 = pi * 3.0 * 0.5;
  EXPECT_NEAR(valueOf("volume_fraction", rings, moments, 0), 0.09 / 3.0, 1e-15);
  EXPECT_NEAR(valueOf("density", rings, moments, 0), 2.0 / v0, 1e-15);
  EXPECT_NEAR(valueOf("radial_velocity", rings, moments, 0), 0.25, 1e-15);
  EXPECT_NEAR(valueOf("azimuthal_velocity", rings, moments, 0), -1.5, 1e-15);
  EXPECT_NEAR(valueOf("spin", rings, moments, 1), -7.0, 1e-14);
  EXPECT_NEAR(valueOf("dynamic_stress_rr", rings, moments, 0), 2.0 * 0.25 * 0.25 / v0, 1e-15);
  EXPECT_NEAR(valueOf("dynamic_stress_pp", rings, moments, 0), 2.0 * 1.5 * 1.5 / v0, 1e-15);
  EXPECT_NEAR(valueOf("dynamic_stress_rp", rings, moments, 0), 2.0 * 0.25 * -1.5 / v0, 1e-15);
}

TEST(Fields, FabricOfATouchingPair) {
  const Rings rings = twoRings();
  const auto moments = test::momentsOf(rings, touchingPair());
  EXPECT_NEAR(valueOf("fabric_rr", rings, moments, 0), 0.03, 1e-15);  // ν n_r n_r, one contact
  EXPECT_NEAR(valueOf("fabric_pp", rings, moments, 0), 0.0, 1e-15);
  EXPECT_NEAR(valueOf("fabric_trace", rings, moments, 0), 0.03, 1e-15);
  EXPECT_NEAR(valueOf("fabric_deviator", rings, moments, 0), 0.03, 1e-15);
  EXPECT_NEAR(valueOf("coordination", rings, moments, 0), 1.0, 1e-15);
}

TEST(Fields, DirectionsAreTakenAtEachDisksOwnAngle) {
  // The pair turned by 90°: the same profiles.
  Instant pair;
  pair.addDisk({0.0, 1.6}, 0.3, 2.0, {1.5, 0.25}, 3.0);
  pair.addDisk({0.0, 2.4}, 0.2, 1.0, {-4.0, -0.5}, -7.0);
  pair.addContact(0, 1, {0.0, -1.0}, 5.0, 2.0);
  const Rings rings = twoRings();
  const auto turned = test::momentsOf(rings, pair);
  const auto straight = test::momentsOf(rings, touchingPair());
  for (std::size_t slot = 0; slot < rings.slots(); ++slot)
    for (std::size_t q = 0; q < std::tuple_size_v<Moments>; ++q)
      EXPECT_NEAR(turned[slot][q], straight[slot][q], 1e-14);
}

/// A disk, and a wall disk of a wheel that drags it along +y = +φ (Ω > 0).
Instant beside(double disk, double wallDisk) {
  Instant cell;
  cell.addDisk({disk, 0.0}, 0.2);
  cell.addWall("wheel", {Vec2(wallDisk, 0.0)}, 0.1);
  cell.addContact(0, 1, {1.0, 0.0}, 5.0, 2.0);  // force on the disk (5, 2)
  return cell;
}

TEST(Fields, ATurningWheelGivesPositiveShearStress) {
  const Rings rings = twoRings();
  const auto moments = test::momentsOf(rings, beside(1.5, 1.2));
  const double volume = pi * 3.0 * 0.5;
  // The force runs from the disk's centre over the contact to the wall disk's: 0.2 m + 0.1 m.
  EXPECT_NEAR(valueOf("stress_pr", rings, moments, 0), 2.0 * 0.3 / volume, 1e-15);
  EXPECT_NEAR(valueOf("stress_rr", rings, moments, 0), 5.0 * 0.3 / volume, 1e-15);
  EXPECT_NEAR(valueOf("coordination", rings, moments, 0), 1.0, 1e-15);
  // A wall disk on R_i = 1 m: half of it lies inside the wheel, but all its contacts are outside.
  const auto edge = test::momentsOf(rings, beside(1.3, 1.0));
  EXPECT_NEAR(at(edge[rings.slot(0)], Moment::stress, 0), 5.0 * 0.2, 1e-15);
  EXPECT_NEAR(at(edge[rings.slot(0)], Moment::wallStress, 0), 5.0 * 0.1, 1e-15);
  EXPECT_EQ(at(edge[rings.slot(rings.insideBin())], Moment::wallStress, 0), 0.0);
}

TEST(Fields, NothingIsLostWithTheOverflowBins) {
  const Instant instant = test::randomInstant(3, 2900);
  const Rings rings = test::thesisRings();
  double area = 0.0;
  double mass = 0.0;
  for (std::size_t p = 0; p < instant.scene.disks.size(); ++p) {
    area += pi * std::pow(instant.scene.disks.radius[p], 2);
    mass += instant.scene.disks.mass[p];
  }
  for (const auto method :
       {WeightMethod::slicing, WeightMethod::straightCut, WeightMethod::centre}) {
    double sum = 0.0;
    double massSum = 0.0;
    double overflow = 0.0;
    const auto moments = test::momentsOf(rings, instant, method);
    for (const Moments& bin : moments) {
      sum += at(bin, Moment::volume) / rings.height();
      massSum += at(bin, Moment::mass);
    }
    for (const int bin : {rings.insideBin(), rings.outsideBin()})
      overflow += at(moments[rings.slot(bin)], Moment::volume) / rings.height();
    EXPECT_NEAR(sum / area, 1.0, 1e-12);
    EXPECT_NEAR(massSum / mass, 1.0, 1e-12);
    EXPECT_GT(overflow, 0.01 * area);  // the scene does reach beyond both walls
    double rebuilt = overflow;         // Σ ν·(ring area) + overflow
    for (int ring = 0; ring < rings.count(); ++ring)
      rebuilt += valueOf("volume_fraction", rings, moments, ring) * rings.ringVolume(ring) /
                 rings.height();
    EXPECT_NEAR(rebuilt / area, 1.0, 1e-12);
  }
}

TEST(Fields, FabricTraceIsVolumeFractionTimesCoordination) {
  // Lätzel 2003, section 7.2.2; with volume weights an identity.
  const Instant instant = test::randomInstant(4, 2900);
  const Rings rings = test::thesisRings();
  const auto moments = test::momentsOf(rings, instant);
  for (int ring = 0; ring < rings.count(); ++ring) {
    const double trace = valueOf("fabric_trace", rings, moments, ring);
    const double product = valueOf("volume_fraction", rings, moments, ring) *
                           valueOf("coordination", rings, moments, ring);
    EXPECT_NEAR(trace, product, 1e-13 * product);
    // The two invariants give the eigenvalues: F_max F_min is the determinant.
    const double deviator = valueOf("fabric_deviator", rings, moments, ring);
    const double determinant =
        valueOf("fabric_rr", rings, moments, ring) * valueOf("fabric_pp", rings, moments, ring) -
        std::pow(valueOf("fabric_rp", rings, moments, ring), 2);
    EXPECT_NEAR((trace * trace - deviator * deviator) / 4.0, determinant, 1e-13 * trace * trace);
  }
}

TEST(Fields, WallDisksCountOnlyWhenAskedFor) {
  Instant instant;
  instant.addDisk({1.5, 0.0}, 0.1);
  instant.addWall("wheel", {Vec2(0.0, 1.5)}, 0.2);
  const Rings rings = twoRings();
  const auto without = test::momentsOf(rings, instant);
  const auto with = test::momentsOf(rings, instant, WeightMethod::slicing, true);
  EXPECT_NEAR(valueOf("volume_fraction", rings, without, 0), 0.01 / 3.0, 1e-15);
  EXPECT_NEAR(valueOf("volume_fraction", rings, with, 0), 0.05 / 3.0, 1e-15);
  EXPECT_NEAR(valueOf("azimuthal_velocity", rings, with, 0), 0.0, 1e-15);
}

TEST(Fields, AnEmptyRingHasAVolumeFractionAndNothingElse) {
  Instant instant;
  instant.addDisk({1.5, 0.0}, 0.1);
  const Rings rings = twoRings();
  const auto moments = test::momentsOf(rings, instant);
  for (const FieldSpec& field : fieldsIn(2, true)) {
    const auto value = evaluate(field, BinView(rings, moments, rings.slot(1), {1.0, 1.0}));
    const bool filling = field.name == "volume_fraction" || field.name == "density";
    EXPECT_EQ(value.has_value(), filling) << field.name;
    if (value) {
      EXPECT_EQ(value->value, 0.0);
    }
  }
}

TEST(Fields, SlopesMatchFiniteDifferences) {
  const Rings rings = test::thesisRings();
  const auto moments = test::momentsOf(rings, test::randomInstant(5, 2000));
  test::expectSlopes(rings, moments, rings.slot(7), {test::thesis.kn, test::thesis.kt});
}

TEST(Fields, VelocityIsOfTheMass_AndByVolumeUnderItsOwnName) {
  Instant instant;  // in ring 0, of equal size and unequal mass
  instant.addDisk({1.5, 0.0}, 0.1, 3.0, {1.0, 2.0}, 4.0);
  instant.addDisk({0.0, 1.5}, 0.1, 1.0, {2.0, 5.0}, 8.0);  // v_r = 5, v_φ = −2
  const Rings rings = twoRings();
  const auto moments = test::momentsOf(rings, instant);
  const auto of = [&](const char* field) { return valueOf(field, rings, moments, 0); };
  EXPECT_NEAR(of("radial_velocity"), (3.0 * 1.0 + 5.0) / 4.0, 1e-14);
  EXPECT_NEAR(of("radial_velocity_by_volume"), 3.0, 1e-14);
  EXPECT_NEAR(of("azimuthal_velocity"), (3.0 * 2.0 - 2.0) / 4.0, 1e-14);
  EXPECT_NEAR(of("azimuthal_velocity_by_volume"), 0.0, 1e-14);
  EXPECT_NEAR(of("spin"), 6.0, 1e-14);
  // v − u = (−1, 1) and (3, −3): Σ m |v − u|² = 24
  EXPECT_NEAR(of("granular_temperature"), 24.0 / (2.0 * 4.0), 1e-14);
  EXPECT_NEAR(of("pressure") * 2.0, of("stress_trace") + 24.0 / rings.ringVolume(0), 1e-14);
}

TEST(Fields, UnknownNameOrASnapshotOfAnotherScene_Throws) {
  EXPECT_THROW(fieldSpec("viscosity"), std::invalid_argument);
  Instant other = touchingPair(), cut = touchingPair();
  other.snapshot.contacts->j[0] = 2;
  cut.snapshot.velocity.pop_back();
  for (const Instant& instant : {other, cut})
    EXPECT_THROW(test::momentsOf(twoRings(), instant), std::invalid_argument);
}

constexpr double a = test::smallRadius;

TEST(Lattice, TriangularUnderEqualForcesIsAPressure) {
  constexpr double force = 1e-3;
  const Rings rings = test::thesisRings(4);
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
  const Rings rings = test::thesisRings(4);
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
