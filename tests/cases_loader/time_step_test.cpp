#include "cases/time_step.hpp"
#include "oracle/impact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cases/stable_step.hpp"
#include "support/nearest.hpp"
#include "tests/support/laws.hpp"

namespace crossgrain::test {
namespace {

TEST(ContactTime, OfTwoSmallThesisDisksIs2180Microseconds) {
  EXPECT_NEAR(contactTime(thesisLaw(), smallMass / 2), smallContactTime,
              0.005e-3);  // as printed: 3 digits
}

TEST(ContactTime, AgreesWithTheRestitutionThatTheThesisPrints) {
  // e_n = exp(−η t_c), an independent number: 0.2223 (section 4.1)
  const double eta = thesis.gn / smallMass;
  EXPECT_NEAR(std::exp(-eta * contactTime(thesisLaw(), smallMass / 2)), 0.2223, 0.00005);
}

TEST(ContactTime, UndampedIsHalfAPeriodOfTheOscillator) {
  ContactLaw law = thesisLaw();
  law.gn = 0.0;
  EXPECT_DOUBLE_EQ(contactTime(law, 2.0), std::numbers::pi * std::sqrt(2.0 / thesis.kn));
}

TEST(ContactTime, DoesNotExistForRigidAndOverdampedLaws) {
  ContactLaw law = thesisLaw();
  law.normal = NormalLaw::rigid;
  EXPECT_THROW(contactTime(law, smallMass / 2), std::invalid_argument);
  law = thesisLaw();
  law.gn = 2.0 * std::sqrt(law.kn * smallMass / 2) * 1.0001;  // just above critical
  EXPECT_THROW(contactTime(law, smallMass / 2), std::invalid_argument);
}

TEST(TimeStep, IsGivenOrAFractionOfTheLightestPairsContact) {
  Case c;
  c.law = thesisLaw();
  c.particles.small = 10;
  c.particles.large = 5;
  c.particles.smallMass = smallMass;
  c.particles.largeMass = largeMass;
  EXPECT_NEAR(timeStep(c), 43.5e-6, 0.05e-6);  // t_c/50, rounded to 44 µs in the thesis' digest
  c.particles.small = 0;                       // √(m_l/m_s) longer, up to the damping's share
  EXPECT_GT(timeStep(c), 55e-6);
  c.run.dt = 4e-5;
  EXPECT_EQ(timeStep(c), 4e-5);
}

TEST(TimeStep, OfACollisionIsOnePerSweep) {
  Case c;
  c.kind = CaseKind::collision;
  c.law = thesisLaw();
  c.collision.mass[0] = c.collision.mass[1] = smallMass;
  c.collision.stepsPerContact = {50, 1000};
  const auto steps = collisionTimeSteps(c);
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_DOUBLE_EQ(steps[0], 20.0 * steps[1]);
  EXPECT_EQ(timeStep(c), steps[0]);
}

TEST(TimeStep, OfHertzsLawIsAFractionOfTheFastestImpact) {
  Case c;
  c.kind = CaseKind::collision;
  c.law = thesisLaw();
  c.law.normal = NormalLaw::hertz;
  c.law.kn = 1e6;
  c.law.gn = 0.0;
  c.collision.mass[0] = c.collision.mass[1] = smallMass;
  c.collision.radius[0] = c.collision.radius[1] = smallRadius;
  c.collision.psi = {0.0};
  c.collision.vn = {0.1, 3.2};
  // t ∝ v^(−1/5) (Johnson 1985, Eq. 11.24): 32^(1/5) = 2
  const auto [shortest, longest] = impactTimes(c);
  EXPECT_NEAR(longest, 2.0 * shortest, 1e-9 * longest);
  EXPECT_DOUBLE_EQ(timeStep(c), shortest / 50.0);  // as many steps as a case takes unasked
}

TEST(Nearest, CountsInsertionsDeletionsReplacementsAndSwaps) {
  EXPECT_EQ(editDistance("kitten", "sitting"), 3u);  // the textbook pair
  EXPECT_EQ(editDistance("", "abc"), 3u);
  EXPECT_EQ(editDistance("tensoin", "tension"), 1u);
}

TEST(Nearest, IsNoneIfAllAreFar) {
  const std::vector<std::string> names = {"small_radius", "large_radius", "mu"};
  EXPECT_EQ(nearest("smal_radius", names), "small_radius");
  EXPECT_EQ(nearest("xyzzy", names), std::nullopt);
  EXPECT_EQ(suggestion("xyzzy", names), " (there are: small_radius, large_radius, mu)");
}

/// Two small disks of the thesis: 2/ω = 2 √(m₁₂/k_n).
Case thesisCell() {
  Case c;
  c.law = thesisLaw();
  c.particles.small = 10;
  c.particles.smallRadius = smallRadius;
  c.particles.smallMass = smallMass;
  c.cell = {.innerRadius = 0.1, .outerRadius = 0.2, .height = 0.006, .omega = 1.0};
  return c;
}

TEST(StepLimit, OfALinearLawIsTwoOverOmega) {
  const Case c = thesisCell();
  const double limit = 2.0 * std::sqrt(smallMass / 2.0 / thesis.kn);
  EXPECT_DOUBLE_EQ(pairStepLimit(c)->dt, limit);
  EXPECT_EQ(whyUnstableStep(c, 0.999 * limit, "run.dt"), "");
  EXPECT_EQ(whyUnstableStep(c, 1.0, "run.dt"),
            "run.dt = 1 s is beyond 2/ω = 0.00125 s of the stiffest, lightest contact (k = 352.1 "
            "N/m, m₁₂ = 0.0001375 kg): no soft law is stable there");
  EXPECT_DOUBLE_EQ(pairStepLimit(c, smallMass / 8.0)->dt, limit / 2.0);  // lighter disks in a file
}

TEST(StepLimit, OfHertzFollowsTheDeepestImpactAtTheRimsSpeed) {
  Case c = thesisCell();
  c.law.normal = NormalLaw::hertz;
  c.law.kn = 1e6;
  // δ_max^(5/2) = m₁₂ v²/(0.8 k √R₁₂), dF/dδ = 1.5 k √(R₁₂ δ)
  const double mass = smallMass / 2.0, radius = smallRadius / 2.0, speed = 0.1;
  const double deepest = std::pow(mass * speed * speed / (0.8 * 1e6 * std::sqrt(radius)), 0.4);
  EXPECT_NEAR(pairStepLimit(c)->stiffness, 1.5e6 * std::sqrt(radius * deepest), 1e-6);
}

TEST(StepLimit, OfRigidDisksAndOfCollisionsIsNone) {
  Case c = thesisCell();
  c.law.normal = NormalLaw::rigid;
  EXPECT_FALSE(pairStepLimit(c));
  EXPECT_EQ(whyUnstableStep(c, 1.0, "run.dt"), "");
  c.law = thesisLaw();
  c.kind = CaseKind::collision;
  EXPECT_FALSE(pairStepLimit(c));
}

}  // namespace
}  // namespace crossgrain::test
