#include "averaging/weights.hpp"

#include <gsl/gsl_integration.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "averaging/areas.hpp"
#include "averaging/rings.hpp"
#include "tests/averaging/scenes.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/thesis.hpp"

namespace crossgrain {
namespace {

using std::numbers::pi;

struct Disk {
  double r, a;
};

/// 2ρ·θ(ρ): the length of the circle of radius ρ about the origin that lies in the disk.
double arcLength(double rho, void* data) {
  const auto& [r, a] = *static_cast<const Disk*>(data);
  if (rho <= a - r) return 2.0 * pi * rho;
  return 2.0 * rho *
         std::acos(std::clamp((r * r + rho * rho - a * a) / (2.0 * r * rho), -1.0, 1.0));
}

/// Independent route to commonArea: adaptive quadrature of arc lengths.
double areaByQuadrature(double r, double a, double R) {
  Disk disk{r, a};
  gsl_function f{arcLength, &disk};
  gsl_integration_workspace* work = gsl_integration_workspace_alloc(2000);
  double area = 0.0;
  double whole = std::max(0.0, std::min(a - r, R));  // circles entirely inside the disk
  area += pi * whole * whole;
  const double from = std::max(std::abs(r - a), whole);
  const double to = std::min(R, r + a);
  if (to > from) {
    double part = 0.0;
    double error = 0.0;
    gsl_integration_qags(&f, from, to, 1e-16, 1e-11, 2000, work, &part, &error);
    area += part;
  }
  gsl_integration_workspace_free(work);
  return area;
}

/// The weights of a disk on the x axis.
BinFractions sharesOf(const Rings& rings, Weight weight, double r, double a) {
  return Partition(rings, weight).ofDisk({r, 0.0}, a);
}

double sumOf(const BinFractions& fractions) {
  double sum = 0.0;
  for (const BinFraction& share : fractions) sum += share.fraction;
  return sum;
}

/// The fraction in one ring, or overflow bin.
double fractionIn(const Rings& rings, const BinFractions& fractions, int bin) {
  double sum = 0.0;
  for (const BinFraction& share : fractions)
    if (share.slot == rings.slot(bin)) sum += share.fraction;
  return sum;
}

TEST(Rings, EdgesVolumesAndCoordinate) {
  const Rings rings(0.1, 0.3, 4, 0.5, 0.02);
  EXPECT_EQ(rings.count(), 4);
  EXPECT_DOUBLE_EQ(rings.edge(0), 0.1);
  EXPECT_DOUBLE_EQ(rings.edge(4), 0.3);
  EXPECT_DOUBLE_EQ(rings.centre(1), 0.175);
  EXPECT_DOUBLE_EQ(rings.rTilde(1), 3.75);
  // 2π r Δr h, the thesis' form, is the same number.
  EXPECT_NEAR(rings.ringVolume(1), 2.0 * pi * 0.175 * 0.05 * 0.5, 1e-16);
  double whole = 0.0;
  for (int k = 0; k < 4; ++k) whole += rings.ringVolume(k);
  EXPECT_NEAR(whole, pi * (0.09 - 0.01) * 0.5, 1e-15);
}

TEST(Rings, BinsAreHalfOpenAndOverflowIsKept) {
  const Rings rings = test::thesisRings(150);
  EXPECT_EQ(rings.binOf(0.0), rings.insideBin());
  EXPECT_EQ(rings.binOf(0.3), rings.outsideBin());
  EXPECT_EQ(rings.binOf(rings.outerRadius()), rings.outsideBin());
  for (int k = 0; k < rings.count(); ++k) {
    EXPECT_EQ(rings.binOf(rings.edge(k)), k);
    EXPECT_EQ(rings.binOf(std::nextafter(rings.edge(k), 0.0)), k - 1);
  }
}

TEST(Rings, RefusesWhatIsNoRing) {
  EXPECT_THROW(Rings(0.2, 0.1, 5, 1.0, 1.0), std::invalid_argument);
  EXPECT_THROW(Rings(0.1, 0.2, 0, 1.0, 1.0), std::invalid_argument);
  EXPECT_THROW(Rings(0.1, 0.2, 5, 0.0, 1.0), std::invalid_argument);
  EXPECT_EQ(crossgrain::test::refusalOf<std::invalid_argument>([] {
              Rings({0.1, 0.1}, 1.0, 1.0);
            }),
            "rings: the outer radius must be larger than the inner one, got 0.1");
}

TEST(Weights, NamesGoBothWays) {
  for (const std::string_view name : weightNames) EXPECT_EQ(toString(weightMethod(name)), name);
  EXPECT_THROW(weightMethod("slices"), std::invalid_argument);
}

TEST(CommonArea, MatchesQuadratureOfArcLengths) {
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int k = 0; k < 2000; ++k) {
    const double a = 0.001 + 0.01 * unit(generator);
    const double r = k % 4 == 0 ? a * unit(generator) : 0.3 * unit(generator);
    const double R = std::max(1e-6, r + 1.2 * a * (2.0 * unit(generator) - 1.0));
    // 1e-10 of the disk: the quadrature is asked for 1e-11.
    EXPECT_NEAR(commonArea(r, a, R), areaByQuadrature(r, a, R), 1e-10 * pi * a * a)
        << "r " << r << " a " << a << " R " << R;
  }
}

TEST(CommonArea, LimitsAreExact) {
  EXPECT_EQ(commonArea(0.2, 0.01, 0.19), 0.0);                           // outer tangency
  EXPECT_DOUBLE_EQ(commonArea(0.2, 0.01, 0.25), pi * 0.01 * 0.01);       // disk within
  EXPECT_DOUBLE_EQ(commonArea(0.001, 0.01, 0.005), pi * 0.005 * 0.005);  // circle within the disk
  EXPECT_DOUBLE_EQ(commonArea(0.0, 0.01, 0.004), pi * 0.004 * 0.004);    // concentric
  // Two unit circles whose centres are one radius apart: 2π/3 − √3/2.
  EXPECT_NEAR(commonArea(1.0, 1.0, 1.0), 2.0 * pi / 3.0 - std::sqrt(3.0) / 2.0, 1e-15);
}

TEST(CommonArea, KeepsItsRelativeAccuracyNearTangency) {
  // A lens of depth t ≪ a, R between circles of radii a and R: (4/3) t^{3/2} √(2aR/(a + R)) to
  // leading order; the next term is of relative order t/a = 1e-7 here.
  const double a = 0.00390625, R = 0.25, t = std::ldexp(1.0, -31);
  const double lens = 4.0 / 3.0 * std::pow(t, 1.5) * std::sqrt(2.0 * a * R / (a + R));
  EXPECT_NEAR(commonArea(R + a - t, a, R) / lens, 1.0, 1e-6);
}

TEST(Weights, AddUpToOneForEveryMethod) {
  std::mt19937_64 generator(2);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const int count : {1, 20, 150}) {
    const Rings rings = test::thesisRings(count);
    for (int k = 0; k < 1000; ++k) {
      const double r = 0.3 * unit(generator);
      const double a = 0.06 * unit(generator) + 1e-6;
      for (const auto method :
           {WeightMethod::slicing, WeightMethod::straightCut, WeightMethod::centre,
            WeightMethod::lineGaussian, WeightMethod::lineHeaviside}) {
        const BinFractions shares = sharesOf(rings, {method, 0.003}, r, a);
        EXPECT_NEAR(sumOf(shares), 1.0, 1e-14);
        for (const BinFraction& share : shares) {
          EXPECT_GE(share.fraction, 0.0);
          EXPECT_LT(share.slot, rings.slots());
        }
      }
    }
  }
}

TEST(Weights, RingsInsideOneDisk) {
  // The disk reaches over the origin: the wheel's hole and the first rings lie inside it whole.
  const Rings rings(0.01, 0.05, 4, 0.006, 0.0074);
  const BinFractions weights = sharesOf(rings, WeightMethod::slicing, 0.005, 0.04);
  const double disk = 0.04 * 0.04;
  EXPECT_NEAR(fractionIn(rings, weights, -1), 0.01 * 0.01 / disk, 1e-15);
  EXPECT_NEAR(fractionIn(rings, weights, 0), (0.02 * 0.02 - 0.01 * 0.01) / disk, 1e-15);
  EXPECT_NEAR(fractionIn(rings, weights, 1), (0.03 * 0.03 - 0.02 * 0.02) / disk, 1e-15);
  EXPECT_NEAR(sumOf(weights), 1.0, 1e-15);
}

TEST(Weights, HalfADiskOnTheWallLiesOutside) {
  // Centre on R_i: a straight edge would halve it, the curved one leaves a little more outside R_i.
  const Rings rings = test::thesisRings();
  const BinFractions straight =
      sharesOf(rings, WeightMethod::straightCut, rings.innerRadius(), test::wallRadius);
  EXPECT_NEAR(fractionIn(rings, straight, -1), 0.5, 1e-13);
  const BinFractions weights =
      sharesOf(rings, WeightMethod::slicing, rings.innerRadius(), test::wallRadius);
  // The arc bends away from its tangent at the centre by y²/2R; over −a … a that is a³/3R of πa².
  const double cap = test::wallRadius / (3.0 * pi * rings.innerRadius());
  EXPECT_NEAR(0.5 - fractionIn(rings, weights, -1), cap, 0.02 * cap);
}

TEST(Weights, StraightCutIsTheFormulaOfTheThesis) {
  // Lätzel 2003, Eq. 5.4, for a disk that reaches over both edges of ring 5.
  const Rings rings = test::thesisRings(40);
  const double r = rings.centre(5) + 0.0004, a = test::largeRadius;
  const double phiInner = std::acos((r - rings.edge(5)) / a);
  const double phiOuter = std::acos((rings.edge(6) - r) / a);
  const double slice = pi - phiInner + std::sin(phiInner) * std::cos(phiInner) - phiOuter +
                       std::sin(phiOuter) * std::cos(phiOuter);
  const BinFractions weights = sharesOf(rings, WeightMethod::straightCut, r, a);
  EXPECT_NEAR(fractionIn(rings, weights, 5), slice / pi, 1e-14);
}

TEST(Weights, StraightCutIsWithinOnePerCentInTheThesisCell) {
  // Lätzel 2003, section 5.2: "well below one per-cent in all situations considered here".
  const Rings rings = test::thesisRings(20);
  double worst = 0.0;
  for (const double a : {test::smallRadius, test::largeRadius})
    for (int k = 0; k <= 4000; ++k) {
      const double r = rings.innerRadius() + a +
                       (rings.outerRadius() - rings.innerRadius() - 2.0 * a) * k / 4000;
      const BinFractions exact = sharesOf(rings, WeightMethod::slicing, r, a);
      const BinFractions straight = sharesOf(rings, WeightMethod::straightCut, r, a);
      for (int bin = -1; bin <= rings.count(); ++bin)
        worst = std::max(
            worst, std::abs(fractionIn(rings, exact, bin) - fractionIn(rings, straight, bin)));
    }
  RecordProperty("worst_fraction", std::to_string(worst));
  EXPECT_LT(worst, 0.01);
  EXPECT_GT(worst, 0.001);  // the two methods do differ
}

}  // namespace
}  // namespace crossgrain
