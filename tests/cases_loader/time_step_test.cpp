#include "cases/time_step.hpp"
#include "oracle/impact.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "adapters/grain.hpp"
#include "cases/assembly_scene.hpp"
#include "support/nearest.hpp"
#include "tests/support/laws.hpp"

namespace crossgrain::test {
namespace {

TEST(ContactTime, IsHalfAPeriod) {
  ContactLaw law = thesisLaw();
  EXPECT_NEAR(contactTime(law, smallMass / 2), smallContactTime, 0.005e-3);  // as printed: 3 digits
  law.gn = 0.0;
  EXPECT_DOUBLE_EQ(contactTime(law, 2.0), std::numbers::pi * std::sqrt(2.0 / thesis.kn));
}

TEST(ContactTime, RigidOrOverdamped_Throws) {
  ContactLaw law = thesisLaw();
  law.normal = NormalLaw::rigid;
  EXPECT_THROW(contactTime(law, smallMass / 2), std::invalid_argument);
  law = thesisLaw();
  law.gn = 2.0 * std::sqrt(law.kn * smallMass / 2) * 1.0001;  // just above critical
  EXPECT_THROW(contactTime(law, smallMass / 2), std::invalid_argument);
}

TEST(TimeStep, IsGivenOrAFractionOfTheLightestContact) {
  Case c;
  c.law = thesisLaw();
  couetteIn(c).particles.small = 10;
  couetteIn(c).particles.large = 5;
  couetteIn(c).particles.smallMass = smallMass;
  couetteIn(c).particles.largeMass = largeMass;
  EXPECT_NEAR(timeStep(c), 43.5e-6, 0.05e-6);  // t_c/50, rounded to 44 µs in the thesis' digest
  couetteIn(c).particles.small = 0;            // √(m_l/m_s) longer, up to the damping's share
  EXPECT_GT(timeStep(c), 55e-6);
  c.run.dt = 4e-5;
  EXPECT_EQ(timeStep(c), 4e-5);
}

TEST(TimeStep, Collision_OnePerSweep) {
  Case c{.source = Collision(), .law = thesisLaw()};
  collisionIn(c).mass[0] = collisionIn(c).mass[1] = smallMass;
  collisionIn(c).stepsPerContact = {50, 1000};
  const auto steps = collisionTimeSteps(c);
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_DOUBLE_EQ(steps[0], 20.0 * steps[1]);
  EXPECT_EQ(timeStep(c), steps[0]);
}

TEST(TimeStep, Hertz_IsAFractionOfTheFastestImpact) {
  Case c{.source = Collision(), .law = thesisLaw()};
  c.law.normal = NormalLaw::hertz;
  c.law.kn = 1e6;
  c.law.gn = 0.0;
  collisionIn(c).mass[0] = collisionIn(c).mass[1] = smallMass;
  collisionIn(c).radius[0] = collisionIn(c).radius[1] = smallRadius;
  collisionIn(c).psi = {0.0};
  collisionIn(c).vn = {0.1, 3.2};
  // t ∝ v^(−1/5) (Johnson 1985, Eq. 11.24): 32^(1/5) = 2
  const auto [shortest, longest] = impactTimes(c);
  EXPECT_NEAR(longest, 2.0 * shortest, 1e-9 * longest);
  EXPECT_DOUBLE_EQ(timeStep(c), shortest / 50.0);  // as many steps as a case takes unasked
}

TEST(Nearest, IsThatOfTheFewestEdits_NoneIfAllAreFar) {
  EXPECT_EQ(editDistance("kitten", "sitting"), 3u);  // the textbook pair
  EXPECT_EQ(editDistance("", "abc"), 3u);
  EXPECT_EQ(editDistance("tensoin", "tension"), 1u);
  const std::vector<std::string> names = {"small_radius", "large_radius", "mu"};
  EXPECT_EQ(nearest("smal_radius", names), "small_radius");
  EXPECT_EQ(nearest("xyzzy", names), std::nullopt);
  EXPECT_EQ(suggestion("xyzzy", names), " (there are: small_radius, large_radius, mu)");
}

/// Two small disks of the thesis: 2/ω = 2 √(m₁₂/k_n).
Case thesisCell() {
  Case c;
  c.law = thesisLaw();
  couetteIn(c).particles.small = 10;
  couetteIn(c).particles.smallRadius = smallRadius;
  couetteIn(c).particles.smallMass = smallMass;
  couetteIn(c).cell = {.innerRadius = 0.1, .outerRadius = 0.2, .height = 0.006, .omega = 1.0};
  return c;
}

/// K = 3 of disks.
TEST(StepLimit, Linear_EachTerm_IsItsOscillators) {
  Case c = thesisCell();
  const double mass = smallMass / 2.0;
  c.law.gn = 0.0;
  c.law.tangential = TangentialLaw::coulomb;
  const double limit = 2.0 * std::sqrt(mass / thesis.kn);
  EXPECT_DOUBLE_EQ(pairStepLimit(c)->dt, limit);
  EXPECT_DOUBLE_EQ(pairStepLimit(c, LightestPair{mass / 4.0, mass / 12.0})->dt, limit / 2.0);
  EXPECT_EQ(unstableStepFault(c, 0.999 * limit, "run.dt"), "");
  const std::string why = unstableStepFault(c, 1.0, "run.dt");
  for (const char* part : {"run.dt = 1 s", "0.00125 s", "normal spring", "352.1 N/m"})
    EXPECT_NE(why.find(part), std::string::npos) << why;
  c.law.cohesion = CohesionLaw::elastoPlastic;
  c.law.kUnload = 4.0 * c.law.kn;  // a contact unloads by as much
  EXPECT_DOUBLE_EQ(pairStepLimit(c)->dt, limit / 2.0);
  c.law.cohesion = CohesionLaw::none;

  c.law.tangential = TangentialLaw::spring;
  c.law.kt = 20.0 * c.law.kn;
  const double tangential = 2.0 * std::sqrt(mass / 3.0 / c.law.kt);
  EXPECT_DOUBLE_EQ(pairStepLimit(c)->dt, tangential);
  c.law.conventions.springUpdate = SpringUpdate::before;
  EXPECT_DOUBLE_EQ(pairStepLimit(c)->dt, tangential / std::sqrt(2.0));  // of a predicted v_t
  EXPECT_STREQ(pairStepLimit(c)->term, "tangential");
  // A dashpot alone: dt = 1/η of a velocity half a step old, half as much of a predicted one.
  c.law.tangential = TangentialLaw::viscous;
  c.law.gt = 100.0;
  const double eta = 100.0 * 3.0 / mass / 2.0;
  EXPECT_DOUBLE_EQ(pairStepLimit(c)->dt, 0.5 / eta);
  c.law.conventions.dampingVelocity = DampingVelocity::lagged;
  EXPECT_DOUBLE_EQ(pairStepLimit(c)->dt, 1.0 / eta);
  c.law.conventions.dampingVelocity = DampingVelocity::implicit;
  EXPECT_DOUBLE_EQ(pairStepLimit(c)->dt, limit);
}

/// L = a at a plane, a/2 between equal disks; J = m a²/2.
TEST(StepLimit, Rolling_IsThatOfAPlaneOrOfTwoDisksThatTurnAgainstEachOther) {
  Case c = thesisCell();
  c.law.gn = c.law.mu = 0.0;
  c.law.tangential = TangentialLaw::none;
  c.law.rolling = RollingLaw::spring;
  c.law.muR = 0.1;
  c.law.kr = 20.0 * c.law.kn;
  // On a plane without friction θ̈ = −k_r a²/J θ.
  EXPECT_DOUBLE_EQ(pairStepLimit(c)->dt, 2.0 * std::sqrt(smallMass / 2.0 / c.law.kr));
  EXPECT_STREQ(pairStepLimit(c)->term, "rolling");
  // With friction it rolls: J + m a². Two disks that gear have θ̈ = −k_r (a/2)² 2/J θ.
  c.law.mu = 0.5;
  c.law.tangential = TangentialLaw::coulomb;
  EXPECT_DOUBLE_EQ(pairStepLimit(c)->dt, 2.0 * std::sqrt(smallMass / c.law.kr));
  c.law.conventions.rollingLength = RollingLength::smallerRadius;  // L = a: four times as stiff
  EXPECT_DOUBLE_EQ(pairStepLimit(c)->dt, std::sqrt(smallMass / c.law.kr));
  // A dashpot alone, γ_r L² 2/J, of a predicted ω_r: dt = 1/(2η).
  c.law.rolling = RollingLaw::viscous;
  c.law.gr = 100.0;
  EXPECT_DOUBLE_EQ(pairStepLimit(c)->dt, 0.5 / (100.0 * 4.0 / smallMass / 2.0));
}

/// A start's file may have disks of any inertia.
TEST(StepLimit, Tangential_OfAStartsFile_TakesItsInertias) {
  Disks disks;
  disks.radius = {1e-3, 1e-3, 1e-3};
  disks.mass = {1e-6, 2e-6, 1e-6};
  disks.inertia = {1e-12, 1e-14, 5e-13};
  disks.position = disks.velocity = std::vector<Vec2>(3, Vec2::Zero());
  disks.spin = {0.0, 0.0, 0.0};
  EXPECT_DOUBLE_EQ(lightestPair(disks, true).normal, 0.5e-6);
  EXPECT_DOUBLE_EQ(lightestPair(disks, true).tangential, 1.0 / (0.5e6 + 1e8 + 1e6 + 2e6));
  EXPECT_DOUBLE_EQ(lightestPair(disks, false).tangential, 0.5e-6);
}

/// The in-house engine at the limit: a disk that lies on a plane, with µ so large that it never
/// slips, is pushed a little. What it does at a shorter step dies out or stays, at a longer one
/// grows.
TEST(StepLimit, EngineBelowIt_Stays_BeyondIt_BlowsUp) {
  struct Term {
    double gn, kt, gt;
    DampingVelocity velocity;
    SpringUpdate update;
    bool tangential;
  };
  using enum DampingVelocity;
  using enum SpringUpdate;
  const auto describe = [](const Term& term) {
    return fmt::format("gn {} kt {} gt {} velocity {} update {}", term.gn, term.kt, term.gt,
                       static_cast<int>(term.velocity), static_cast<int>(term.update));
  };
  for (const Term& term :
       {Term{0.0, 20000.0, 0.0, lagged, before, true},
        Term{0.0, 20000.0, 0.0, predicted, before, true},
        Term{0.5, 20000.0, 0.3, predicted, before, true},
        Term{0.5, 20000.0, 0.3, lagged, before, true},
        Term{0.05, 500.0, 0.9, predicted, after, true}, Term{0.05, 500.0, 0.9, lagged, after, true},
        Term{0.05, 500.0, 0.9, predicted, midpoint, true},
        Term{0.05, 20000.0, 0.3, implicit, before, true},
        Term{0.3, 10.0, 0.0, predicted, before, false},
        Term{0.3, 10.0, 0.0, lagged, before, false}}) {
    Case c;
    c.source = Assembly();
    c.law.tangential = TangentialLaw::springDashpot;
    c.law.kn = 1000.0;
    c.law.gn = term.gn;
    c.law.kt = term.kt;
    c.law.gt = term.gt;
    c.law.mu = 1e6;
    c.law.conventions.dampingVelocity = term.velocity;
    c.law.conventions.springUpdate = term.update;
    DiskGroup disk{.radius = 5e-4, .mass = 7.85e-6};
    const double resting = disk.mass * 1e4 / c.law.kn;  // so deep that no contact is lost
    disk.position = {0.0, disk.radius - (term.tangential ? 1.0 : 1.0 + 1e-9) * resting};
    disk.velocity = {term.tangential ? 1e-9 : 0.0, 0.0};
    assemblyIn<2>(c).disks = {disk};
    WallGroup floor;
    floor.planes.push_back({.point = Vec2::Zero(), .normal = {0.0, 1.0}});
    assemblyIn<2>(c).walls = {floor};
    assemblyIn<2>(c).gravity = {0.0, -1e4};
    c.run.dt = 1e-6;
    const auto limit = pairStepLimit(c);
    ASSERT_TRUE(limit);
    EXPECT_STREQ(limit->term, term.tangential ? "tangential" : "normal");
    const auto speedAfter = [&](double dt) {
      Scene scene = assemblyScene(c);
      scene.dt = dt;
      const auto engine = makeGrain();
      engine->load(scene, {});
      engine->advance(3000.0 * dt);
      return engine->snapshot(ContactReport::none).velocity[0].norm();
    };
    EXPECT_LT(speedAfter(0.99 * limit->dt), 1e-6) << describe(term);
    EXPECT_GT(speedAfter(1.01 * limit->dt), 1e-4) << describe(term);
  }
}

TEST(StepLimit, Hertz_FollowsTheDeepestImpact_RigidLawsAndCollisionsHaveNone) {
  Case c = thesisCell();
  c.law.normal = NormalLaw::hertz;
  c.law.tangential = TangentialLaw::none;
  c.law.kn = 1e6;
  // δ_max^(5/2) = m₁₂ v²/(0.8 k √R₁₂), dF/dδ = 1.5 k √(R₁₂ δ)
  const double mass = smallMass / 2.0, radius = smallRadius / 2.0, speed = 0.1;
  const double deepest = std::pow(mass * speed * speed / (0.8 * 1e6 * std::sqrt(radius)), 0.4);
  EXPECT_NEAR(pairStepLimit(c)->stiffness, 1.5e6 * std::sqrt(radius * deepest), 1e-6);
  c.law.normal = NormalLaw::rigid;
  EXPECT_FALSE(pairStepLimit(c));
  EXPECT_EQ(unstableStepFault(c, 1.0, "run.dt"), "");
  c.law = thesisLaw();
  c.source = Collision();
  EXPECT_FALSE(pairStepLimit(c));
}

}  // namespace
}  // namespace crossgrain::test
