// The oracle against a plain integration in small equal steps.
#include "plain_integration.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/pairs.hpp"

namespace {

using namespace crossgrain;

struct Named {
  const char* name;
  CollidingPair pair;
  double psi, vn;
  SpringReset reset;
  double allowed;  ///< of Ψ_f
};

class SmallSteps : public testing::TestWithParam<Named> {};

TEST_P(SmallSteps, ThesisLaw_GiveWhatTheOracleHas) {
  const auto& [name, pair, psi, vn, reset, allowed] = GetParam();
  ContactLaw law = test::thesisLaw();
  law.conventions.springReset = reset;
  const CollisionEnd oracle = oracleOutcome(law, pair, {psi, vn, Approach::oblique});
  ASSERT_FALSE(oracle.noLimit);
  const auto plain = test::PlainIntegration::run(law, pair, {psi, vn, Approach::oblique},
                                                 test::smallContactTime, 200'000, 0.0);
  EXPECT_NEAR(plain.en, oracle.en, allowed);
  EXPECT_NEAR(plain.psi, oracle.psi, allowed);
}

/// A spring stretched after its force slips on at a bound that falls; whether v_t vanishes before
/// that begins is decided within a step of 1/400 t_c here.
TEST(Oracle, SpringStretchedAfter_JumpsWhereSmallStepsDo) {
  struct Jump {
    double gn, mu, below, above;
  };
  for (const Jump& jump : {Jump{0.0, 0.44, 1.319, 1.3215}, Jump{0.05, 0.44, 1.0175, 1.0195},
                           Jump{0.05, 0.2, 0.4615, 0.4635}}) {
    ContactLaw law = test::thesisLaw();
    law.tangential = TangentialLaw::spring;
    law.conventions.tension = Tension::cut;
    law.gn = jump.gn;
    law.mu = jump.mu;
    const auto oracle = [&](double psi) {
      return oracleOutcome(law, test::smallPair(), {psi, 0.01}).psi;
    };
    for (const double psi : {jump.below, jump.above})
      EXPECT_NEAR(oracle(psi),
                  test::PlainIntegration::run(law, test::smallPair(), {psi, 0.01},
                                              test::smallContactTime, 20'000, 0.3)
                      .psi,
                  1e-3)
          << jump.gn << " " << psi;
    EXPECT_GT(std::abs(oracle(jump.above) - oracle(jump.below)), 0.2);
  }
}

// Reset to the bound, a slip ends where v_t = 0: found a step late, 5e-6 t_c, an error of second
// order. Reset beside the dashpot it ends where f* falls below the bound, and while the bound rises
// every other step sticks: first order (3e-4 at 16,000 steps). Where both could happen the former
// has no limit (CollisionEnd::noLimit), so those collisions take the latter.
INSTANTIATE_TEST_SUITE_P(
    , SmallSteps,
    testing::Values(
        Named{"sticks", test::smallPair(), 0.2, 0.01, SpringReset::total, 1e-8},
        Named{"slides", test::smallPair(), 4.0, 0.01, SpringReset::total, 1e-8},
        Named{"fast", test::smallPair(), -2.0, 0.5, SpringReset::total, 1e-8},
        Named{"slips_and_reverses", test::smallPair(), 1.0, 0.01, SpringReset::springOnly, 1e-5},
        Named{"unequal", test::unequalPair(), 1.0, 0.05, SpringReset::springOnly, 1e-5}),
    [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
