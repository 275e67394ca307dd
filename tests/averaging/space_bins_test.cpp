// How bins in space divide spheres and lines: closed forms, and points at random.
#include "averaging/space_bins.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "averaging/space_rings.hpp"
#include "averaging/volumes.hpp"

namespace crossgrain {
namespace {

using std::numbers::pi;

constexpr double inf = INFINITY;

TEST(SphereFractions, PlanesAndCubes) {
  EXPECT_EQ(fractionBelow(0.0), 0.5);
  EXPECT_EQ(fractionBelow(-3.0), 0.0);
  EXPECT_EQ(fractionBelow(1.0), 1.0);
  EXPECT_EQ(fractionBelow(0.5), 27.0 / 32.0);  // ½ + ¾(½ − 1/24)
  EXPECT_NEAR(fractionWithin(Vec3::Zero(), Vec3(inf, 1.0, 5.0)), 0.125, 1e-9);
  EXPECT_NEAR(fractionWithin(Vec3(-inf, 0.0, -inf), Vec3(0.0, inf, 7.0)), 0.25, 1e-9);
  // A cube inside the sphere, and one that cuts off six caps that do not meet.
  EXPECT_NEAR(fractionWithin(Vec3::Constant(-0.5), Vec3::Constant(0.5)), 3.0 / (4.0 * pi), 1e-9);
  EXPECT_NEAR(fractionWithin(Vec3::Constant(-0.8), Vec3::Constant(0.8)),
              1.0 - 6.0 * (1.0 - fractionBelow(0.8)), 1e-9);
  // Two cuts: whichever direction slices lie along, and all parts together.
  for (const double x : {-0.99999, -0.6, 0.02, 0.7071, 0.999})
    for (const double y : {-0.8, 0.001, 0.7072, 0.9999}) {
      const double one = fractionWithin(Vec3(-inf, -inf, x), Vec3(inf, y, inf));
      EXPECT_NEAR(one, fractionWithin(Vec3(x, -2.0, -inf), Vec3(2.0, inf, y)), 1e-8);
      EXPECT_NEAR(one + fractionWithin(Vec3(-inf, y, x), Vec3(inf, inf, inf)),
                  1.0 - fractionBelow(x), 1e-8);
      double parts = 0.0;
      for (const double from : {-1.0, -0.3, 0.4})
        parts += fractionWithin(Vec3(from, -inf, x), Vec3(from == 0.4 ? 1.0 : from + 0.7, y, inf));
      EXPECT_NEAR(parts, one, 1e-8) << x << ' ' << y;
    }
}

TEST(SphereFractions, Cylinders) {
  // About the centre the cylinder leaves the ring (1 − R²)^3/2 of a bored sphere.
  for (const double R : {0.2, 0.7, 0.95})
    EXPECT_NEAR(fractionInCylinder(0.0, R, -inf, inf), 1.0 - std::pow(1.0 - R * R, 1.5), 1e-9);
  // Viviani: half as wide as the sphere, through its centre: 2π/3 − 8/9.
  EXPECT_NEAR(fractionInCylinder(0.5, 0.5, -1.0, 1.0), 0.5 - 2.0 / (3.0 * pi), 1e-9);
  // Cut elsewhere it is integrated over other pieces; worst where it all but touches at the
  // equator.
  for (const double gap :
       {0.5, 0.1, 1e-2, 1e-3, 1e-4, 1e-6, -1e-6, -1e-4, -1e-3, -1e-2, -0.1, -0.4})
    for (const double s : {0.1, 0.5, 1.7}) {
      const double R = s < 1.0 ? 1.0 - s + gap : s - 1.0 - gap;
      for (const double z : {-0.7, -0.01, 0.003, 0.3})
        EXPECT_NEAR(fractionInCylinder(s, R, -inf, z) + fractionInCylinder(s, R, z, inf),
                    fractionInCylinder(s, R, -inf, inf), 1e-8)
            << s << ' ' << R << ' ' << z;
    }
  EXPECT_EQ(fractionInCylinder(3.0, 2.0, -inf, inf), 0.0);
  EXPECT_EQ(fractionInCylinder(0.5, 2.0, -inf, 0.0), 0.5);
  // A cylinder so wide that its side is a plane: its sagitta over the sphere is 1/2R.
  EXPECT_NEAR(fractionInCylinder(1e6, 1e6 + 0.5, -inf, inf), fractionBelow(0.5), 1e-6);
}

TEST(Kernels, NormsAndClosedForms) {
  for (const Kernel kind : {Kernel::heaviside, Kernel::lucy, Kernel::gauss}) {
    const KernelIn1d kernel(kind, 0.3);
    const double c = kernel.reach();
    EXPECT_EQ(kernel.below(-c), 0.0);
    EXPECT_EQ(kernel.below(c), 1.0);
    EXPECT_DOUBLE_EQ(kernel.below(0.0), 0.5);
    constexpr int steps = 3000;
    double sum = 0.0, line = 0.0;
    for (int k = 0; k < steps; ++k) {
      const double x = c * (2.0 * (k + 0.5) / steps - 1.0), h = 1e-5;
      sum += kernel.density(x) * 2.0 * c / steps;
      if (std::abs(x) < c - h) {
        EXPECT_NEAR((kernel.below(x + h) - kernel.below(x - h)) / (2.0 * h), kernel.density(x),
                    1e-6);
      }
      line += kernel.below(0.07 - (0.2 + 0.5 * (k + 0.5) / steps)) / steps;
    }
    EXPECT_NEAR(sum, 1.0, 1e-6) << "midpoint rule";
    EXPECT_NEAR(kernel.lineBelow(0.07, 0.2, 0.7), line, 1e-6);
    EXPECT_NEAR(kernel.lineBelow(0.07, 0.1, 0.1 + 1e-7), kernel.below(-0.03), 1e-6);
    EXPECT_DOUBLE_EQ(kernel.lineBelow(9.0, 0.2, 0.7), 1.0);
  }
  // Their heights at 0: 1/2c, 5/4c, 1/√(2π)w over what is left within 3w.
  EXPECT_DOUBLE_EQ(KernelIn1d(Kernel::heaviside, 0.5).density(0.0), 1.0);
  EXPECT_DOUBLE_EQ(KernelIn1d(Kernel::lucy, 0.5).density(0.0), 2.5);
  EXPECT_NEAR(KernelIn1d(Kernel::gauss, 0.5).density(0.0), 0.797884561 / 0.997300204, 1e-9);
  EXPECT_THROW(KernelIn1d(Kernel::lucy, 0.0), std::invalid_argument);
}

const BoxOf<3> periodicBox{Vec3(-1.0, 0.0, 0.0), Vec3(1.0, 3.0, 2.0), {true, false, true}};

/// Bins of every kind, in a box that repeats along x and z where they can be.
struct AllBins {
  Cells grid{Vec3(-1.0, 0.2, 0.3), Vec3(1.0, 2.4, 2.3), {4, 2, 3}, periodicBox};
  Cells part{Vec3(-0.6, 0.2, 1.1), Vec3(0.7, 2.4, 1.9), {2, 1, 2}, periodicBox};
  Cells slabs{Vec3(-1.0, -0.5, 0.0), Vec3(1.0, 3.5, 2.0), {1, 8, 1}, periodicBox, 1};
  SpaceRings rings{
      0.4, 1.3, 3, 0.1, 2.1, 4, BoxOf<3>{Vec3(0, 0, 0), Vec3(0, 0, 2), {false, false, true}}};
  std::vector<const SpaceBins*> each = {&grid, &part, &slabs, &rings};
};

TEST(SpaceBins, AgreeWithPointsAtRandom) {
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  constexpr int samples = 20000;
  const AllBins bins;
  for (const SpaceBins* coordinate : bins.each)
    for (int k = 0; k < 12; ++k) {
      const Vec3 x(2.0 * unit(generator), 2.0 * unit(generator), 3.0 * unit(generator));
      const Vec3 step = 0.8 * Vec3(unit(generator), unit(generator), unit(generator));
      const double a = 0.2 + 0.15 * (1.0 + unit(generator));
      std::vector<double> ofSphere(coordinate->slots()), ofLine = ofSphere, ball = ofSphere,
                                                         line = ofSphere;
      for (int inside = 0; inside < samples;) {
        const Vec3 offset(unit(generator), unit(generator), unit(generator));
        if (offset.squaredNorm() > 1.0) continue;
        ++inside;
        ball[coordinate->slotAt(x + a * offset)] += 1.0 / samples;
        line[coordinate->slotAt(x + 0.5 * (1.0 + unit(generator)) * step)] += 1.0 / samples;
      }
      BinFractions fractions;
      coordinate->sphereFractions(x, a, WeightMethod::slicing, fractions);
      for (const auto& [slot, fraction] : fractions) ofSphere[slot] += fraction;
      std::vector<LineFraction> along;
      coordinate->lineFractions(x, step, WeightMethod::slicing, along);
      for (const LineFraction& each : along) ofLine[each.slot] += each.fraction;
      double sphere = 0.0, whole = 0.0;
      for (std::size_t slot = 0; slot < ball.size(); ++slot) {
        // Five standard deviations of a fraction of 20,000 points; some 2000 are looked at.
        EXPECT_NEAR(ofSphere[slot], ball[slot], 5.0 * 0.5 / std::sqrt(samples)) << slot;
        EXPECT_NEAR(ofLine[slot], line[slot], 5.0 * 0.5 / std::sqrt(samples)) << slot;
        sphere += ofSphere[slot];
        whole += ofLine[slot];
      }
      EXPECT_NEAR(sphere, 1.0, 1e-8);
      EXPECT_NEAR(whole, 1.0, 1e-14);
    }
}

TEST(SpaceBins, WhatIsPeriodicOverflowsNowhere) {
  const Cells slabs(Vec3::Zero(), Vec3(2.0, 3.0, 4.0), {1, 1, 5},
                    BoxOf<3>{Vec3::Zero(), Vec3(2.0, 3.0, 4.0), {true, true, true}}, 2);
  BinFractions fractions;
  for (const Weight& weight : {Weight(WeightMethod::slicing), Weight(WeightMethod::lucy, 0.7),
                               Weight(WeightMethod::gauss, 0.3)})
    for (const double z : {-4.1, 0.05, 3.9, 17.0}) {
      slabs.sphereFractions(Vec3(5.0, -7.0, z), 0.5, weight, fractions);
      double sum = 0.0;
      for (const auto& [slot, fraction] : fractions) {
        EXPECT_NEAR(slot == 0 ? fraction : 0.0, 0.0, 1e-15);
        sum += fraction;
      }
      EXPECT_NEAR(sum, 1.0, 1e-14);
    }
}

TEST(SpaceBins, RefuseWhatIsNoBin) {
  EXPECT_THROW(Cells(Vec3::Zero(), Vec3(1, 1, -1), {1, 1, 1}, {}), std::invalid_argument);
  EXPECT_THROW(Cells(Vec3::Zero(), Vec3::Ones(), {1, 0, 1}, {}), std::invalid_argument);
  EXPECT_THROW(Cells(Vec3::Zero(), Vec3::Ones(), {2, 1, 1}, {}, 2), std::invalid_argument);
  EXPECT_THROW(Cells(Vec3(-1.5, 0, 0), Vec3(1, 3, 2), {1, 1, 1}, periodicBox),
               std::invalid_argument)
      << "longer than the box";
  EXPECT_THROW(SpaceRings(0.5, 0.4, 1, 0.0, 1.0, 1), std::invalid_argument);
  EXPECT_THROW(SpaceRings(0.0, 0.4, 1, 0.0, 1.0, 1, periodicBox), std::invalid_argument);
  const AllBins bins;
  EXPECT_THROW(bins.grid.require(Weight(WeightMethod::lucy, 0.5)), std::invalid_argument);
  EXPECT_THROW(bins.slabs.require(Weight(WeightMethod::lucy, 0.0)), std::invalid_argument);
  EXPECT_THROW(bins.slabs.require(WeightMethod::straightCut), std::invalid_argument);
  EXPECT_NO_THROW(bins.slabs.require(Weight(WeightMethod::gauss, 0.5)));
}

TEST(SpaceBins, SphereBeyondWhatAnIntegerCounts_IsOutside) {
  // (x − low)/width is 10¹⁴ and more: as an index that is no int.
  const Cells slabs(Vec3::Zero(), Vec3(1.0, 1.0, 1e-12), {1, 1, 4}, {}, 2);
  const SpaceRings rings(0.0, 1e-12, 4, 0.0, 1.0, 1);
  for (const double far : {300.0, 1e12, 1e300}) {
    BinFractions fractions;
    slabs.sphereFractions(Vec3(0.5, 0.5, far), 0.1, WeightMethod::slicing, fractions);
    ASSERT_EQ(fractions.size(), 1u);
    EXPECT_EQ(fractions[0].slot, 0u);
    EXPECT_EQ(fractions[0].fraction, 1.0);
    rings.sphereFractions(Vec3(far, 0.0, 0.5), 0.1, WeightMethod::slicing, fractions);
    ASSERT_EQ(fractions.size(), 1u);
    EXPECT_EQ(fractions[0].fraction, 1.0);
  }
}

TEST(SpaceRings, VolumesAndDirections) {
  const SpaceRings rings(0.0, 2.0, 2, -1.0, 3.0, 2);
  EXPECT_DOUBLE_EQ(rings.volume(1), 2.0 * pi);  // inner ring, lower layer
  EXPECT_DOUBLE_EQ(rings.volume(4), 6.0 * pi);  // outer ring, upper layer
  EXPECT_EQ(rings.slotAt(Vec3(0.0, 1.5, 2.0)), 4U);
  EXPECT_EQ(rings.slotAt(Vec3(0.0, 2.5, 2.0)), 0U);
  const Eigen::Matrix3d at = rings.directions(Vec3(0.0, 2.0, 1.0));
  EXPECT_TRUE(at.col(0).isApprox(Vec3::UnitY()) && at.col(1).isApprox(-Vec3::UnitX()) &&
              at.col(2).isApprox(Vec3::UnitZ()));
}

}  // namespace
}  // namespace crossgrain
