#include "frozen_normal.hpp"

#include <gsl/gsl_fit.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "oracle/collision_oracle.hpp"
#include "tests/support/pairs.hpp"

namespace {

using namespace crossgrain;
using namespace test;

class BothRoutes : public testing::TestWithParam<std::tuple<TangentialLaw, Tension, Approach>> {
 protected:
  ContactLaw law() const {
    ContactLaw law = thesisLaw();
    law.tangential = std::get<0>(GetParam());
    law.conventions.tension = std::get<1>(GetParam());
    return law;
  }
  Approach approach() const { return std::get<2>(GetParam()); }
};

/// The planar problem differs from the frozen one by the turn of the normal, of order v t_c/a.
TEST_P(BothRoutes, MeetAsTheSpeedGoesToZeroOverTheWholeCurve) {
  for (const CollidingPair& pair : {smallPair(), unequalPair()}) {
    double logSpeed[4], logError[4];
    int noLimit = 0;
    for (int decade = 0; decade < 4; ++decade) {
      const double vn = std::pow(10.0, -2 - decade);
      double largest = 0.0;
      for (int k = 0; k <= 80; ++k) {
        const CollisionStart start{0.05 * k, vn, approach()};
        const CollisionEnd frozen = frozenNormalOutcome(law(), pair, start);
        const CollisionEnd planar = oracleOutcome(law(), pair, start);
        // The frozen route says where there may be none; the oracle, where outcomes are apart.
        EXPECT_TRUE(frozen.noLimit || !planar.noLimit) << "psi " << start.psi;
        if (frozen.noLimit) {
          EXPECT_NEAR(frozen.psi, planar.psi, 0.02) << "psi " << start.psi;
          ++noLimit;
          continue;
        }
        const double difference =
            std::max({std::abs(frozen.psi - planar.psi), std::abs(frozen.en - planar.en),
                      std::abs(frozen.centrePsi - planar.centrePsi),
                      std::abs(*frozen.duration / *planar.duration - 1.0),
                      std::abs(*frozen.maxOverlap / *planar.maxOverlap - 1.0)});
        largest = std::max(largest, difference);
      }
      logSpeed[decade] = std::log(vn);
      logError[decade] = std::log(largest);
    }
    double intercept = 0.0, order = 0.0, c00 = 0.0, c01 = 0.0, c11 = 0.0, squares = 0.0;
    gsl_fit_linear(logSpeed, 1, logError, 1, 4, &intercept, &order, &c00, &c01, &c11, &squares);
    RecordProperty("order", std::to_string(order));
    RecordProperty("difference_at_1e-5", std::to_string(std::exp(logError[3])));
    RecordProperty("points_without_a_limit", noLimit);
    EXPECT_LE(noLimit, law().tangential == TangentialLaw::springDashpot ? 4 * 4 : 0);
    EXPECT_NEAR(order, 1.0, 0.02) << "errors " << std::exp(logError[0]) << " … "
                                  << std::exp(logError[3]);
    EXPECT_LT(std::exp(logError[3]), 5e-5);  // (1 + Ψ) v t_c/a, and more at the kinks
  }
}

ContactLaw undamped(double kt, double mu) {
  ContactLaw law = thesisLaw();
  law.tangential = TangentialLaw::spring;
  law.gn = 0.0;
  law.kt = kt * law.kn;
  law.mu = mu;
  return law;
}

TEST(FrozenNormal, NoSlipNoDampingIsBeckersClosedForm) {
  // e_t0 = −cos(π √(K k_t/k_n)) (Becker et al. 2008) as µ → ∞; K = 3 for disks, 7/2 for spheres.
  for (const double q : {0.5, 0.4})
    for (const double ratio : {0.1, 2.0 / 7.0, 1.0 / 3.0, 0.7586, 1.5}) {
      CollidingPair pair = smallPair();
      for (double& inertia : pair.inertia) inertia *= q / 0.5;
      const double expected = std::cos(std::numbers::pi * std::sqrt((1.0 + 1.0 / q) * ratio));
      EXPECT_NEAR(frozenNormalOutcome(undamped(ratio, 1e12), pair, {1.0, 0.1}).psi, expected, 1e-10)
          << "q " << q << ", k_t/k_n " << ratio;
    }
}

TEST(FrozenNormal, SlidingThroughoutIsTheAsymptoteOfTheCutLaw) {
  for (const TangentialLaw tangential : {TangentialLaw::coulomb, TangentialLaw::viscous})
    for (const Tension tension : {Tension::allow, Tension::cut}) {
      ContactLaw law = thesisLaw();
      law.tangential = tangential;
      law.gt = 1e6;  // the viscous law is then Coulomb's as long as it slides
      law.conventions.tension = tension;
      for (const CollidingPair& pair : {smallPair(), unequalPair()})
        EXPECT_NEAR(frozenNormalOutcome(law, pair, {4.0, 0.1}).psi,
                    4.0 - *slidingConstant(law, pair), 1e-12);
    }
}

TEST(FrozenNormal, ACoulombContactIsWaltonsWithoutTangentialRestitution) {
  // Sticking takes all of v_t, sliding K (1 + e) µ of it: Walton's law with e_t0 = 0, to rounding.
  ContactLaw law = thesisLaw();
  law.tangential = TangentialLaw::coulomb;
  law.conventions.tension = Tension::cut;
  ContactLaw rigid;
  rigid.normal = NormalLaw::rigid;
  rigid.en = restitutionOfLinearLaw(law, smallPair().reducedMass());
  rigid.mu = law.mu;
  for (int k = -40; k <= 40; ++k) {
    const CollisionStart start{0.1 * k, 0.1};
    const CollisionEnd soft = frozenNormalOutcome(law, smallPair(), start);
    const CollisionEnd hard = rigidOutcome(rigid, smallPair(), start);
    EXPECT_NEAR(soft.psi, hard.psi, 1e-12) << start.psi;
    EXPECT_NEAR(soft.en, hard.en, 1e-12);
    EXPECT_NEAR(soft.spin[0], hard.spin[0], 1e-10);
    EXPECT_NEAR(soft.energyAfter, hard.energyAfter, 1e-12 * hard.energyBefore);
  }
}

TEST(FrozenNormal, StickingHasOneRestitutionForEveryPsi) {
  // Where the spring never reaches the bound the law is linear: Ψ_f/Ψ_i is one number.
  const ContactLaw law = undamped(2.0 / 7.0, 1e12);
  const double one = frozenNormalOutcome(law, smallPair(), {1.0, 0.1}).psi;
  for (const double psi : {0.1, 0.7, 2.0, 4.0})
    EXPECT_NEAR(frozenNormalOutcome(law, smallPair(), {psi, 0.1}).psi, psi * one, 1e-10);
}

TEST(FrozenNormal, OtherConventionsAreRefused) {
  ContactLaw law = thesisLaw();
  law.conventions.springUpdate = SpringUpdate::midpoint;
  EXPECT_THROW(frozenNormalOutcome(law, smallPair(), {1.0, 0.1}), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(
    Laws, BothRoutes,
    testing::Combine(testing::Values(TangentialLaw::coulomb, TangentialLaw::viscous,
                                     TangentialLaw::spring, TangentialLaw::springDashpot),
                     testing::Values(Tension::allow, Tension::cut),
                     testing::Values(Approach::spin, Approach::oblique)));

}  // namespace
