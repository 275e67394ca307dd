// Collisions whose stiffness follows the overlap, and collisions with a wall.
#include <gtest/gtest.h>

#include <cmath>

#include "oracle/collision_oracle.hpp"
#include "oracle/impact.hpp"
#include "tests/support/pairs.hpp"

namespace {

using namespace crossgrain;

/// A sphere after Chung and Ooi (2011); E [Pa], density [kg/m³].
struct Sphere {
  double radius, young, poisson, density;

  double mass() const { return 4.0 / 3.0 * M_PI * radius * radius * radius * density; }
  CollidingPair withItsLike() const {
    const double inertia = 0.4 * mass() * radius * radius;
    return {{radius, radius}, {mass(), mass()}, {inertia, inertia}};
  }
  CollidingPair onWall() const {
    return diskOnWall(radius, mass(), 0.4 * mass() * radius * radius);
  }
  /// Hertz' law with another body of this material, or (bodies = 1) a rigid one.
  ContactLaw law(int bodies = 2) const {
    ContactLaw law;
    law.normal = NormalLaw::hertz;
    law.tangential = TangentialLaw::none;
    law.kn = 4.0 / 3.0 * young / (bodies * (1.0 - poisson * poisson));
    law.kt = 8.0 * young / (bodies * 2.0 * (1.0 + poisson) * (2.0 - poisson));
    return law;
  }
};

constexpr Sphere glass{0.010, 48e9, 0.20, 2800.0};
constexpr Sphere aluminium{0.1, 70e9, 0.30, 2699.0};
constexpr Sphere alumina{0.0025, 380e9, 0.23, 4000.0};

ContactLaw withFriction(ContactLaw law, TangentialLaw tangential, double mu) {
  law.tangential = tangential;
  law.mu = mu;
  return law;
}

/// δ_max and t_c as computed from Hertz' theory for tests 1 and 2 of Chung and Ooi.
TEST(HertzOracle, ElasticImpactsAreAsDeepAndAsLongAsTheTheorySays) {
  const CollisionEnd pair = oracleOutcome(glass.law(), glass.withItsLike(), {0.0, 20.0});
  EXPECT_NEAR(*pair.maxOverlap, 274.1e-6, 0.05e-6);
  EXPECT_NEAR(*pair.duration, 40.3e-6, 0.05e-6);
  EXPECT_NEAR(pair.en, 1.0, 1e-12);
  const CollisionEnd wall = oracleOutcome(aluminium.law(1), aluminium.onWall(), {0.0, 0.2});
  EXPECT_NEAR(*wall.maxOverlap, 49.7e-6, 0.05e-6);
  EXPECT_NEAR(*wall.duration, 732e-6, 0.5e-6);
  EXPECT_NEAR(wall.en, 1.0, 1e-11);  // overlaps of 5e-4 of a radius, which rounds
  // The closed forms themselves, to all digits.
  const CollidingPair two = glass.withItsLike();
  const Impact impact{two.reducedMass(), two.reducedRadius(), 20.0};
  EXPECT_NEAR(*pair.maxOverlap, deepestOverlap(glass.law(), impact), 1e-11 * *pair.maxOverlap);
  EXPECT_NEAR(*pair.duration, impactTime(glass.law(), impact), 1e-8 * *pair.duration);
  EXPECT_NEAR(impactTime(glass.law(), impact), 2.943275 * *pair.maxOverlap / 20.0,
              1e-6 * *pair.duration);
}

TEST(HertzOracle, CriticalDampersGiveTheWantedRestitutionAtAnySpeed) {
  ContactLaw law = glass.law();
  law.damper = Damper::critical;
  for (const double e : {0.1, 0.5, 0.98}) {
    law.gn = -2.0 * std::sqrt(5.0 / 6.0) * std::log(e) / std::hypot(M_PI, std::log(e));
    for (const double speed : {0.01, 20.0}) {
      EXPECT_NEAR(oracleOutcome(law, glass.withItsLike(), {0.0, speed}).en, e, 1e-9);
      EXPECT_NEAR(*closedRestitution(law, 1.0), e, 1e-14);
    }
    law.conventions.tension = Tension::cut;
    EXPECT_NEAR(oracleOutcome(law, glass.withItsLike(), {0.0, 20.0}).en,
                *closedRestitution(law, 1.0), 1e-9);
    law.conventions.tension = Tension::allow;
  }
}

/// 1 − e = 1.15344 · 3/2 A (k/m₁₂)^(2/5) v^(1/5) − … (Ramírez et al. 1999); the next term is 3/5 of
/// the square of this one.
TEST(HertzOracle, ViscoelasticSpheresLoseMoreWhereTheyAreFaster) {
  ContactLaw law = glass.law();
  law.damper = Damper::viscoelastic;
  law.gn = 2e-8;
  const CollidingPair pair = glass.withItsLike();
  const double k = law.kn * std::sqrt(pair.reducedRadius());
  for (const double v : {0.01, 1.0}) {
    const double first =
        1.15344 * 1.5 * law.gn * std::pow(k / pair.reducedMass(), 0.4) * std::pow(v, 0.2);
    EXPECT_NEAR(1.0 - oracleOutcome(law, pair, {0.0, v}).en, first - 0.6 * first * first,
                3e-5 * first);  // what 1.15344 is rounded to, and the third term
  }
}

/// The disk that Lätzel measured (2003, Fig. 4.4).
TEST(PolynomialOracle, TheMeasuredDiskStopsWhereItsWorkIsTheKineticEnergy) {
  ContactLaw law;
  law.normal = NormalLaw::polynomial;
  law.tangential = TangentialLaw::none;
  law.kn = 8.456e9;
  law.kn3 = -3.73e12;
  const CollisionEnd end = oracleOutcome(law, test::smallPair(), {0.0, 0.1});
  const double d = *end.maxOverlap;
  const double work = 8.456e9 * d * d * d / 3.0 - 3.73e12 * d * d * d * d / 4.0;
  EXPECT_NEAR(work, 0.25 * test::smallMass * 0.01, 1e-10 * work);
  EXPECT_NEAR(end.en, 1.0, 1e-11);
  EXPECT_NEAR(*end.duration,
              impactTime(law, {test::smallPair().reducedMass(), 0.5 * test::smallRadius, 0.1}),
              1e-7 * *end.duration);
  // Beyond δ = 2 k₂/(3 |k₃|) it softens, and gives way where its whole work does not stop the
  // disks.
  EXPECT_THROW(oracleOutcome(law, test::smallPair(), {0.0, 1e5}), std::invalid_argument);
}

/// Sliding throughout: e_t of the centre is 1 − µ (1 + e)/tan θ, whatever the stiffness.
TEST(HertzOracle, SlidingImpactsOnAWallFollowTheRigidBodyLimit) {
  ContactLaw law = withFriction(alumina.law(), TangentialLaw::spring, 0.092);
  for (const double degrees : {45.0, 60.0, 80.0}) {
    const double slope = std::tan(degrees * M_PI / 180.0);
    const CollisionEnd end = oracleOutcome(law, alumina.onWall(), {slope, 3.9, Approach::oblique});
    EXPECT_NEAR(*end.et, 1.0 - 2.0 * 0.092 / slope, 1e-4) << degrees;
  }
}

/// Chung and Ooi's test 4, Al₂O₃: e_t of the centre at fixed speed, points read from its figure.
TEST(HertzOracle, ObliqueImpactsAreThosePublished) {
  ContactLaw law = withFriction(alumina.law(), TangentialLaw::spring, 0.092);
  law.conventions.springUpdate = SpringUpdate::midpoint;
  law.conventions.leverArm = LeverArm::contactPoint;
  law.damper = Damper::critical;
  law.gn = -2.0 * std::sqrt(5.0 / 6.0) * std::log(0.98) / std::hypot(M_PI, std::log(0.98));
  const double published[][2] = {{5, .948},  {10, .687}, {15, .624}, {20, .616}, {25, .634},
                                 {30, .684}, {35, .737}, {40, .781}, {50, .845}, {60, .893},
                                 {70, .932}, {80, .966}, {85, .983}};
  for (const auto& [degrees, et] : published) {
    const double angle = degrees * M_PI / 180.0;
    const CollisionEnd end = oracleOutcome(
        law, alumina.onWall(), {std::tan(angle), 3.9 * std::cos(angle), Approach::oblique});
    EXPECT_NEAR(*end.et, et, 0.01) << degrees << " degrees";
  }
}

/// A wall is a disk of no curvature that nothing moves.
TEST(WallOracle, IsTheLimitOfAHugeHeavyDisk) {
  ContactLaw law = test::thesisLaw();
  law.conventions.springUpdate = SpringUpdate::midpoint;
  law.conventions.springReset = SpringReset::springOnly;
  CollidingPair huge = test::smallPair();
  const CollidingPair wall = diskOnWall(test::smallRadius, test::smallMass, huge.inertia[0]);
  huge.radius[1] = 1e6 * test::smallRadius;
  huge.mass[1] = 1e12 * test::smallMass;
  huge.inertia[1] = huge.mass[1] * huge.radius[1] * huge.radius[1];
  for (const LeverArm lever : {LeverArm::radius, LeverArm::contactPoint})
    for (const Approach approach : {Approach::firstSpin, Approach::oblique})
      for (const double psi : {0.5, 2.0}) {
        law.conventions.leverArm = lever;
        const CollisionStart start{psi, 0.01, approach};
        const CollisionEnd a = oracleOutcome(law, huge, start), b = oracleOutcome(law, wall, start);
        EXPECT_NEAR(a.psi, b.psi, 1e-5);
        EXPECT_NEAR(a.en, b.en, 1e-5);
        EXPECT_NEAR(a.spin[0], b.spin[0], 1e-5 * 0.01 / test::smallRadius);
        EXPECT_NEAR(b.reboundAngle, std::atan2(b.centrePsi, b.en), 1e-14);
      }
}

/// Sliding on a wall: J = µ (1 + e) m v, so Ψ_f = Ψ_i − K (1 + e) µ with K = 3 for disks.
TEST(WallOracle, SlidesByTheClosedForm) {
  ContactLaw law = test::thesisLaw();
  law.tangential = TangentialLaw::coulomb;
  const CollidingPair wall =
      diskOnWall(test::smallRadius, test::smallMass, test::smallPair().inertia[0]);
  ContactLaw cut = law;
  cut.conventions.tension = Tension::cut;
  const double constant = 3.0 * (1.0 + restitutionOfLinearLaw(cut, test::smallMass)) * law.mu;
  EXPECT_NEAR(*slidingConstant(law, wall), constant, 1e-14);
  EXPECT_NEAR(oracleOutcome(law, wall, {4.0, 0.1}).psi, 4.0 - constant, 1e-9);
  // A grazing impact slides too, with the same constant.
  EXPECT_NEAR(oracleOutcome(law, wall, {57.3, 0.1, Approach::oblique}).psi, 57.3 - constant, 1e-8);
}

/// Opposite spins of equal disks roll on each other: nothing happens to them.
TEST(WallOracle, CounterSpinsRollWithoutFriction) {
  const CollisionEnd end =
      oracleOutcome(test::thesisLaw(), test::smallPair(), {0.0, 0.1, Approach::spin, 20.0});
  EXPECT_NEAR(end.spin[0], 20.0, 1e-14);
  EXPECT_NEAR(end.spin[1], -20.0, 1e-14);
  EXPECT_NEAR(end.psi, 0.0, 1e-14);
}

}  // namespace
