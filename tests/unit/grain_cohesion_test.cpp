#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engines/grain/contact_force.hpp"
#include "tests/unit/grain_packed.hpp"

// Cohesion: forces over the overlap against their closed forms, losses of a contact, the ledger and
// the bits of the step.

namespace {

using namespace grain;
namespace test = crossgrain::test;

/// R₁₂ = 0.25, E* = 5e4, γ = 100, w = 2 γ.
ContactLaw jkrLaw() {
  ContactLaw law;
  law.normal = NormalLaw::hertz;
  law.kn = 4.0 / 3.0 * 5e4;
  law.w = 200.0;
  law.cohesion = CohesionLaw::jkr;
  return law;
}

ContactMotion<double> at(double overlap, double radius = 0.25, double reach = 1.0) {
  ContactMotion<double> motion{};
  motion.overlap = overlap;
  motion.radius = radius;
  motion.reach = reach;
  return motion;
}

double force(const ContactLaw& law, double overlap, double memory = 1.0) {
  return bodyForce(generalLaw<double>(law, 1e-5, true), at(overlap), memory);
}

TEST(CubeRoot, OfManySizes_IsRightToRounding) {
  for (double v = 1e-30; v < 1e30; v *= 7.3)
    EXPECT_NEAR(cubeRoot(v) * cubeRoot(v) * cubeRoot(v), v, 1e-15 * v);
  EXPECT_EQ(cubeRoot(0.0), 0.0);
}

TEST(Jkr, ForceOverOverlap_IsThatOfItsEquations) {
  // By the equations in a, solved by bisection: F = 4 E* a³/(3 R) − √(8π w E* a³),
  // δ = a²/R − √(2π w a/E*).
  const double R = 0.25, E = 5e4, w = 200.0;
  const auto overlapOf = [&](double a) { return a * a / R - std::sqrt(2.0 * M_PI * w * a / E); };
  const double aAtPull = std::cbrt(9.0 * M_PI * w * R * R / (8.0 * E));
  for (const double overlap : {-0.012, -0.005, 0.0, 0.002, 0.02, 0.5}) {
    double low = aAtPull, high = 1.0;
    for (int k = 0; k < 200; ++k) {
      const double a = 0.5 * (low + high);
      (overlapOf(a) < overlap ? low : high) = a;
    }
    const double a3 = low * low * low;
    const double expected = 4.0 * E * a3 / (3.0 * R) - std::sqrt(8.0 * M_PI * w * E * a3);
    EXPECT_NEAR(force(jkrLaw(), overlap), expected, 1e-9 * std::abs(expected)) << overlap;
  }
}

TEST(Jkr, CharacteristicPoints_AreTheClosedForms) {
  const ContactLaw law = jkrLaw();
  const double pull = 1.5 * M_PI * 200.0 * 0.25;
  EXPECT_NEAR(force(law, 0.0), -8.0 / 9.0 * pull, 1e-12 * pull);
  const GeneralLaw<double> general = generalLaw<double>(law, 1e-5, true);
  const double range = jkrRange(general, 0.25);
  // δ_p = −1.2277 (γ² R/E*²)^(1/3)
  EXPECT_NEAR(range, 1.2277 * std::cbrt(1e4 * 0.25 / 25e8), 1e-4 * range);
  EXPECT_NEAR(force(law, -range), -pull, 1e-9 * pull);
  // Where the branch ends, 3^(2/3) times as far: −5/9 F_po.
  EXPECT_NEAR(force(law, -std::cbrt(9.0) * range), -5.0 / 9.0 * pull, 1e-7 * pull);
  // Figures that another program (LAMMPS 29 Sep 2021) gave for this pair.
  EXPECT_NEAR(force(law, 0.002), -201.2221, 1e-4);
  EXPECT_NEAR(force(law, 0.0), -209.4395, 1e-4);
  EXPECT_NEAR(force(law, -0.012), -235.6027, 1e-4);
  EXPECT_NEAR(range, 0.012277, 1e-6);
}

TEST(Jkr, EnergyBetweenTwoOverlaps_IsTheIntegralOfTheForce) {
  const GeneralLaw<double> law = generalLaw<double>(jkrLaw(), 1e-5, true);
  for (const auto& [from, to] : {std::pair{-0.012, 0.0}, std::pair{0.0, 0.01}}) {
    constexpr int n = 20000;
    double sum = 0.0;
    for (int k = 0; k < n; ++k)
      sum += force(jkrLaw(), from + (to - from) * (k + 0.5) / n) * (to - from) / n;
    EXPECT_NEAR(bodyEnergy(law, at(to), 1.0) - bodyEnergy(law, at(from), 1.0), sum,
                1e-7 * std::abs(sum));
  }
  EXPECT_NEAR(bodyEnergy(law, at(0.0), 1.0), 0.0, 1e-12);
}

TEST(Dmt, ForceAndEquilibrium_AreTheClosedForms) {
  ContactLaw law = jkrLaw();
  law.cohesion = CohesionLaw::dmt;
  const double pull = 2.0 * M_PI * 200.0 * 0.25;
  EXPECT_NEAR(force(law, 0.0), -pull, 1e-12 * pull);
  EXPECT_NEAR(force(law, std::cbrt(std::pow(0.75 * pull / (5e4 * 0.5), 2.0))), 0.0, 1e-9 * pull);
}

TEST(CohesionAreas, OfTwoSpheres_AreTheirLensToFirstOrder) {
  ContactLaw law{.kn = 1e5, .cohesion = CohesionLaw::area, .kc = 1e4};
  // Radii 0.3 and 0.6 at a distance d: the circle in which the spheres meet, by Heron's formula.
  const double overlap = 0.02, s = 0.9, d = s - overlap;
  const double half = 0.5 * (0.3 + 0.6 + d);
  const double height = 2.0 * std::sqrt(half * (half - 0.3) * (half - 0.6) * (half - d)) / d;
  const auto area = [&](CohesionArea kind, const ContactMotion<double>& motion) {
    law.conventions.cohesionArea = kind;
    return cohesionArea(generalLaw<double>(law, 1e-5, true), motion);
  };
  const ContactMotion<double> pair = at(overlap, 0.2, s), plane = at(overlap, 0.3, 0.0);
  EXPECT_NEAR(area(CohesionArea::lens, pair), M_PI * height * height, 1e-14);
  EXPECT_NEAR(area(CohesionArea::lens, plane), M_PI * (0.09 - 0.28 * 0.28), 1e-15);
  EXPECT_NEAR(area(CohesionArea::firstOrder, pair), 2.0 * M_PI * 0.2 * overlap, 1e-16);
  EXPECT_NEAR(area(CohesionArea::twiceBetweenDisks, pair), 4.0 * M_PI * 0.2 * overlap, 1e-16);
  EXPECT_NEAR(area(CohesionArea::twiceBetweenDisks, plane), 2.0 * M_PI * 0.3 * overlap, 1e-16);
  law.conventions.cohesionArea = CohesionArea::lens;
  EXPECT_NEAR(bodyForce(generalLaw<double>(law, 1e-5, true), pair, law.kt),
              1e5 * overlap - 1e4 * M_PI * height * height, 1e-9);
  // The energy's slope is the force.
  const GeneralLaw<double> general = generalLaw<double>(law, 1e-5, true);
  for (const double reach : {s, 0.0}) {
    double none = 0.0;
    const double slope = (bodyEnergy(general, at(0.02 + 1e-6, 0.2, reach), 0.0) -
                          bodyEnergy(general, at(0.02 - 1e-6, 0.2, reach), 0.0)) /
                         2e-6;
    EXPECT_NEAR(bodyForce(general, at(0.02, 0.2, reach), none), slope, 1e-6 * slope);
  }
}

/// k₁ = 1e3, k₂ = 4e3, k_c = 500.
ContactLaw plasticLaw() {
  return ContactLaw{.kn = 1e3, .cohesion = CohesionLaw::elastoPlastic, .kc = 500.0, .kUnload = 4e3};
}

TEST(ElastoPlastic, LoadingUnloadingAndPull_FollowTheirLines) {
  const GeneralLaw<double> law = generalLaw<double>(plasticLaw(), 1e-5, true);
  double memory = 0.0;
  const auto f = [&](double overlap) { return bodyForce(law, at(overlap), memory); };
  EXPECT_DOUBLE_EQ(f(0.01), 10.0);                         // k₁ δ
  EXPECT_DOUBLE_EQ(f(0.0075), 4e3 * 0.0075 - 3e3 * 0.01);  // δ₀ = ¾ δ_max: nothing
  EXPECT_NEAR(f(0.007), -2.0, 1e-12);
  EXPECT_DOUBLE_EQ(memory, 0.01);
  // δ_min = (k₂ − k₁) δ_max/(k₂ + k_c) = 6.67e-3; below it the pull is k_c δ and δ_max falls.
  EXPECT_NEAR(f(0.0045), -500.0 * 0.0045, 1e-12);
  EXPECT_NEAR(memory, (4e3 + 500.0) / 3e3 * 0.0045, 1e-15);
  EXPECT_NEAR(f(0.005), -500.0 * 0.0045 + 4e3 * 0.0005, 1e-12);  // back up along k₂
  EXPECT_DOUBLE_EQ(f(0.02), 20.0);
}

TEST(ElastoPlastic, StiffnessThatGrows_KeepsItsLineThroughThePull) {
  ContactLaw plain = plasticLaw();
  plain.plasticDepth = 0.05;  // δ* = 4/3 · 0.05 · 0.5 = 0.0333
  const GeneralLaw<double> law = generalLaw<double>(plain, 1e-5, true);
  double memory = 0.01;
  EXPECT_DOUBLE_EQ(bodyForce(law, at(0.01), memory), 10.0);
  const double k2 = 1e3 + 3e3 * 0.3;
  EXPECT_NEAR(bodyForce(law, at(0.009), memory), 10.0 - k2 * 0.001, 1e-12);
  const double pulled = bodyForce(law, at(0.001), memory);
  EXPECT_NEAR(pulled, -0.5, 1e-12);
  // At the same overlap the line that δ_max now has gives the same force.
  EXPECT_NEAR(bodyForce(law, at(0.001), memory), pulled, 1e-12);
}

// δ* = 0.0333, δ₀ of it φ 2 R₁₂ = 0.025: from there on 4e3 (δ − 0.025), down to −k_c δ at δ_min =
// 4e3 · 0.025/4500, and no further loading makes δ₀ grow.
TEST(ElastoPlastic, BeyondTheLimit_IsElasticOnItsBranch) {
  ContactLaw plain = plasticLaw();
  plain.plasticDepth = 0.05;
  const GeneralLaw<double> law = generalLaw<double>(plain, 1e-5, true);
  double memory = 0.0;
  const auto f = [&](double overlap) { return bodyForce(law, at(overlap), memory); };
  EXPECT_NEAR(f(0.0333), 33.3, 1e-12);
  for (const double overlap : {0.0334, 0.05, 0.06, 0.04, 0.025, 0.023, 0.05})
    EXPECT_NEAR(f(overlap), 4e3 * (overlap - 0.025), 1e-11) << overlap;
  EXPECT_NEAR(memory, 0.1 / 3.0, 1e-15);
  EXPECT_NEAR(f(0.02), -10.0, 1e-12);
  EXPECT_LT(memory, 0.0333);
  const double left = memory;
  EXPECT_NEAR(f(left), 1e3 * left, 1e-11);  // δ_max has fallen: it yields again
}

// A step late: the step that presses to 0.01 has the k₂ of 0.008, 1e3 + 3e3 · 0.24 = 1720, so that
// δ₀ = (1 − 1/1.72) 0.01; the next one has k₂ of 0.01, 1900. Its pull has a limit on parting only.
TEST(ElastoPlastic, LaggedStiffness_LeavesDeltaZeroAsItWas) {
  ContactLaw plain = plasticLaw();
  plain.plasticDepth = 0.05;
  plain.conventions.unloadingStiffness = UnloadingStiffness::lagged;
  const GeneralLaw<double> law = generalLaw<double>(plain, 1e-5, true);
  double memory = 0.0, rest = 0.0;
  const auto f = [&](double overlap, double parting) {
    ContactMotion<double> motion = at(overlap);
    motion.normalVelocity = parting;
    return laggedPlasticForce(law, motion, memory, rest);
  };
  EXPECT_DOUBLE_EQ(f(0.008, -1.0), 8.0);
  EXPECT_EQ(rest, 0.0);
  EXPECT_DOUBLE_EQ(f(0.01, -1.0), 10.0);
  EXPECT_NEAR(rest, 0.0041860465, 1e-9);
  EXPECT_DOUBLE_EQ(f(0.009, 1.0), 9.0);  // its line is above k₁ δ
  EXPECT_NEAR(f(0.007, 1.0), 1900.0 * (0.007 - rest), 1e-12);
  EXPECT_NEAR(f(0.003, -1.0), 1900.0 * (0.003 - rest), 1e-12);  // approaching: beyond −k_c δ
  EXPECT_NEAR(f(0.003, 1.0), -1.5, 1e-12);
  EXPECT_NEAR(memory, 0.003 * 2400.0 / 900.0, 1e-15);
  EXPECT_NEAR(rest, (1.0 - 1.0 / 1.9) * memory, 1e-15);

  // The first evaluation loads by k₁ even beyond δ*, and finds δ₀.
  GeneralLaw<double> atStart = law;
  atStart.halfStep = 0.0;
  memory = rest = 0.0;
  EXPECT_DOUBLE_EQ(laggedPlasticForce(atStart, at(0.05), memory, rest), 50.0);
  EXPECT_NEAR(rest, 0.025, 1e-15);
}

/// Two disks of 1 kg that approach with v each.
grain::Setup approaching(const ContactLaw& law, double v, double gap = 1e-9) {
  grain::Setup setup{.law = law, .dt = 1e-5, .ledger = true};
  setup.disks = {{-0.5 - 0.5 * gap, 0.5 + 0.5 * gap},
                 {0.0, 0.0},
                 {v, -v},
                 {0.0, 0.0},
                 {0.0, 0.0},
                 {0.5, 0.5},
                 {1.0, 1.0},
                 {0.125, 0.125}};
  return setup;
}

double relativeSpeed(const Simulation& s) {
  return s.velocityX(1) - s.velocityX(0);
}

/// Until they are apart, or have turned twice. @returns whether they part
bool partsAgain(Simulation& simulation) {
  int turns = 0;
  for (double before = relativeSpeed(simulation); turns < 3;) {
    simulation.step();
    const double now = relativeSpeed(simulation);
    turns += before * now < 0.0;
    before = now;
    if (simulation.contacts().empty() && now > 0.0) return true;
  }
  return false;
}

TEST(Jkr, StickingSpeed_IsThatOfTheEnergyLost) {
  // ½ m* v² = 0.3203 F_po a_p²/R where the largest pull ends it, 0.6486 at the end of the branch.
  const double pull = 1.5 * M_PI * 200.0 * 0.25;
  for (const auto& [end, share] :
       {std::pair{JkrEnd::largestPull, 0.32039}, std::pair{JkrEnd::branch, 0.64857}}) {
    ContactLaw law = jkrLaw();
    law.conventions.jkrEnd = end;
    const double depth = jkrDepth(generalLaw<double>(law, 1e-5, true), 0.25);
    const double loss = share * pull * depth;
    const double sticking = std::sqrt(2.0 * loss / 0.5);  // relative, m* = ½
    Simulation slow(approaching(law, 0.5 * 0.995 * sticking));
    EXPECT_FALSE(partsAgain(slow));
    Simulation fast(approaching(law, 0.5 * 1.01 * sticking));
    ASSERT_TRUE(partsAgain(fast));
    EXPECT_NEAR(fast.energyLedger()->lostDetachment, loss, 2e-3 * loss);
    const double left = 0.25 * relativeSpeed(fast) * relativeSpeed(fast);
    EXPECT_NEAR(left, (1.01 * 1.01 - 1.0) * loss, 3e-3 * loss);
  }
}

TEST(Jkr, PairsThatPassAtADistance_DoNotTouch) {
  ContactLaw law = jkrLaw();
  const double range = jkrRange(generalLaw<double>(law, 1e-5, true), 0.25);
  grain::Setup setup = approaching(law, 0.0, 0.5 * range);
  Simulation simulation(std::move(setup));
  simulation.advance(100);
  EXPECT_TRUE(simulation.contacts().empty());
  EXPECT_EQ(simulation.velocityX(0), 0.0);
}

TEST(ElastoPlastic, Restitution_IsThatOfTheAreas) {
  // e² = k₁/k₂ − k_c δ_min δ₀/(k₁ δ_max²); k_c = 0: √(k₁/k₂).
  for (const double kc : {0.0, 500.0}) {
    ContactLaw law = plasticLaw();
    law.kc = kc;
    Simulation simulation(approaching(law, 0.05));
    ASSERT_TRUE(partsAgain(simulation));
    const double square = 0.25 - kc * (3e3 / (4e3 + kc)) * 0.75 / 1e3;
    EXPECT_NEAR(relativeSpeed(simulation) / 0.1, std::sqrt(square), 1e-3);
    const double before = 0.5 * 0.5 * 0.01;
    EXPECT_NEAR(simulation.energyLedger()->lostPlastic, (1.0 - square) * before, 2e-3 * before);
  }
}

// Neither friction nor a dashpot asks for velocities, but the limit of its pull does: e² = k₁/k₂ −
// k_c δ_min δ₀/(k₁ δ_max²) with δ_max = v √(m₁₂/k₁), k₂ = k₁ + 3 k₁ δ_max/δ*.
TEST(ElastoPlastic, LaggedStiffness_PullsAtMostKcDelta) {
  ContactLaw law = plasticLaw();
  law.plasticDepth = 0.05;
  law.conventions.unloadingStiffness = UnloadingStiffness::lagged;
  Simulation simulation(approaching(law, 0.05));
  ASSERT_TRUE(partsAgain(simulation));
  const double k2 = 1e3 + 3e3 * 0.1 * std::sqrt(0.5 / 1e3) * 30.0;
  const double square = 1e3 / k2 - 500.0 * (k2 - 1e3) / (k2 + 500.0) * (1.0 - 1e3 / k2) / 1e3;
  EXPECT_NEAR(relativeSpeed(simulation) / 0.1, std::sqrt(square), 1e-3);
}

TEST(CohesionLoads, InCoulombsBound_AreTheConventions) {
  // A pair at rest under DMT without load slips at nothing, at µ F_po, or at 2 µ F_po − µ F_po; in
  // the last its dashpot takes no part.
  ContactLaw law = jkrLaw();
  law.cohesion = CohesionLaw::dmt;
  law.tangential = TangentialLaw::coulomb;
  law.mu = 0.5;
  double approach = 0.0;
  const double pull = 2.0 * M_PI * 200.0 * 0.25;
  const auto bound = [&](CohesionLoad load, double overlap) {
    law.conventions.cohesionLoad = load;
    ContactMotion<double> motion = at(overlap);
    motion.normalVelocity = approach;
    motion.tangentialVelocity = 1.0;
    double spring = 0.0, memory = 0.0, rest = 0.0;
    return -contactForce(generalLaw<double>(law, 1e-5, true), motion, spring, memory, rest)
                .tangential;
  };
  const double rest = std::cbrt(std::pow(0.75 * pull / (5e4 * 0.5), 2.0));
  EXPECT_NEAR(bound(CohesionLoad::net, rest), 0.0, 1e-9);
  EXPECT_NEAR(bound(CohesionLoad::withoutPull, rest), 0.5 * pull, 1e-9);
  EXPECT_NEAR(bound(CohesionLoad::plusTwicePullOff, rest), pull, 1e-9);
  EXPECT_NEAR(bound(CohesionLoad::plusTwicePullOff, 0.0), 0.5 * pull, 1e-9);
  EXPECT_NEAR(bound(CohesionLoad::magnitudePlusPullOff, rest), 0.5 * pull, 1e-9);
  EXPECT_NEAR(bound(CohesionLoad::magnitudePlusPullOff, 0.0), pull, 1e-9);  // F = −F_po
  law.gn = 10.0;
  approach = -1.0;
  EXPECT_NEAR(bound(CohesionLoad::plusTwicePullOff, rest), pull, 1e-9);
  EXPECT_NEAR(bound(CohesionLoad::net, rest), 5.0, 1e-9);
  EXPECT_NEAR(bound(CohesionLoad::netWithoutDashpot, rest), 0.0, 1e-9);
}

TEST(Jkr, TangentialSpring_SeesItsContactRadius) {
  // k_t a: at δ = 0 a = (2πw R²/E*)^(1/3), from 4/3 √(a/a_p) = (a/a_p)² with a_p³ = 9π w R²/(8 E*);
  // a = a_p at −δ_p.
  ContactLaw law = jkrLaw();
  law.tangential = TangentialLaw::spring;
  law.mu = 1e6;
  law.kt = 1e4;
  law.conventions.cohesionLoad = CohesionLoad::plusTwicePullOff;
  const double modulus = 0.75 * law.kn, radius = at(0.0).radius;
  const auto stiffness = [&](double overlap) {
    ContactMotion<double> motion = at(overlap);
    double spring = 1e-6, memory = 1.0, rest = 0.0;
    return -contactForce(generalLaw<double>(law, 1e-5, true), motion, spring, memory, rest)
                .tangential /
           1e-6;
  };
  const double peak = std::cbrt(9.0 * M_PI * law.w * radius * radius / (8.0 * modulus));
  EXPECT_NEAR(stiffness(0.0), law.kt * std::cbrt(2.0 * M_PI * law.w * radius * radius / modulus),
              1e-6 * law.kt);
  EXPECT_NEAR(stiffness(-peak * peak / (3.0 * radius)), law.kt * peak, 1e-6 * law.kt * peak);
}

TEST(CutTension, OfACohesiveContact_CutsTheDashpotAlone) {
  ContactLaw law = jkrLaw();
  law.cohesion = CohesionLaw::dmt;
  law.conventions.tension = Tension::cut;
  law.gn = 1e4;
  ContactMotion<double> parting = at(1e-6);
  parting.normalVelocity = 1.0;
  double spring = 0.0, memory = 0.0, rest = 0.0;
  const double f =
      contactForce(generalLaw<double>(law, 1e-5, true), parting, spring, memory, rest).normal;
  EXPECT_NEAR(f, force(law, 1e-6), 1e-9);
  EXPECT_LT(f, 0.0);
}

ContactLaw lawOf(CohesionLaw cohesion) {
  ContactLaw law = test::thesisLaw();
  law.cohesion = cohesion;
  if (cohesion == CohesionLaw::area) law.kc = 1e4;
  if (cohesion == CohesionLaw::elastoPlastic) {
    law.kUnload = 3.0 * law.kn;
    law.kc = 0.5 * law.kn;
    law.plasticDepth = 0.02;  // or they are elastic on the limit branch
  }
  if (cohesion == CohesionLaw::dmt || cohesion == CohesionLaw::jkr) {
    law.normal = NormalLaw::hertz;
    law.kn *= 1e4;
    law.kt *= 1e4;
    law.w = cohesion == CohesionLaw::jkr ? 0.2 : 0.1;
  }
  return law;
}

class CohesionLedger : public testing::TestWithParam<CohesionLaw> {};

TEST_P(CohesionLedger, OfAGas_ClosesBetterTheSmallerTheStep) {
  const auto worst = [&](double dt) {
    grain::Setup setup = test::crowd(4, 11, dt);
    setup.law = lawOf(GetParam());
    setup.ledger = true;
    Simulation simulation(std::move(setup));
    double most = 0.0;
    while (simulation.time() < 0.05) {
      simulation.step();
      most = std::max(most, std::abs(test::residual(*simulation.energyLedger())));
    }
    const EnergyLedger& ledger = *simulation.energyLedger();
    // A contact that yields ends with only a little of the last step's pull.
    EXPECT_EQ(ledger.lostDetachment > 1e-4 * ledger.initial, GetParam() == CohesionLaw::jkr);
    EXPECT_EQ(ledger.lostPlastic > 0.0, GetParam() == CohesionLaw::elastoPlastic);
    return most / ledger.initial;
  };
  const double coarse = worst(4e-6), fine = worst(5e-7);
  EXPECT_LT(fine, 1e-3);
  EXPECT_LT(fine, 0.3 * coarse);
}

TEST_P(CohesionLedger, KernelsThreadsAndRestarts_GiveTheSameBits) {
  for (const Precision precision : {Precision::float64, Precision::float32}) {
    grain::Setup setup = test::packed(5, 21);
    const double kt = setup.law.kt;
    setup.law = lawOf(GetParam());
    if (setup.law.normal == NormalLaw::linear) setup.law.kt = kt;
    setup.precision = precision;
    const Simulation whole = test::withSameBits(setup, 8250);  // across a renumbering
    std::size_t pulling = 0;
    for (const Contact& contact : whole.contacts()) pulling += contact.normalForce < 0.0;
    // An area softens the linear law: it pulls at no overlap.
    EXPECT_EQ(pulling > 0, GetParam() != CohesionLaw::area);
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, CohesionLedger,
                         testing::Values(CohesionLaw::area, CohesionLaw::dmt, CohesionLaw::jkr,
                                         CohesionLaw::elastoPlastic));

TEST(CohesionLaw, WithALawThatCannotCarryIt_IsRefused) {
  const auto refused = [](const ContactLaw& law) {
    grain::Setup setup = approaching(law, 0.1);
    EXPECT_THROW(Simulation{std::move(setup)}, std::invalid_argument);
  };
  ContactLaw law = jkrLaw();
  law.normal = NormalLaw::linear;
  refused(law);
  law = jkrLaw();
  law.w = 0.0;
  refused(law);
  law = plasticLaw();
  law.kUnload = 0.5 * law.kn;
  refused(law);
}

}  // namespace
