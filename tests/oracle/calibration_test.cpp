#include "oracle/calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "tests/support/pairs.hpp"

namespace {

using namespace crossgrain;
using std::numbers::pi;

/// Unequal disks: 1 and 3 g, so m₁₂ = 0.75 g; q = 1/2, so K = 3 whatever the radii are.
CollidingPair unequalPair() {
  return {{5e-3, 8e-3}, {1e-3, 3e-3}, {0.5 * 1e-3 * 25e-6, 0.5 * 3e-3 * 64e-6}};
}

struct Wanted {
  Tension tension;
  TangentialLaw tangential;
  double en, et0;
};

void PrintTo(const Wanted& wanted, std::ostream* out) {
  *out << (wanted.tension == Tension::cut ? "cut " : "allow ")
       << (wanted.tangential == TangentialLaw::spring ? "spring " : "spring_dashpot ") << wanted.en
       << ' ' << wanted.et0;
}

constexpr double wantedTime = 1e-3;

ContactLaw calibrated(const Wanted& wanted, const CollidingPair& pair) {
  ContactLaw law;
  law.conventions.tension = wanted.tension;
  law.tangential = wanted.tangential;
  law.conventions.springReset = SpringReset::springOnly;  // or an undamped contact slips at first
  law.conventions.springUpdate = SpringUpdate::before;
  calibrateNormal(law, wanted.en, wantedTime, reduced(pair).mass);
  calibrateTangential(law, wanted.et0, reduced(pair));
  return law;
}

class Calibration : public testing::TestWithParam<Wanted> {};

TEST_P(Calibration, ConstantsGiveBackWhatWasAsked) {
  const Wanted wanted = GetParam();
  const ContactLaw law = calibrated(wanted, unequalPair());
  const ImpliedImpact is = impliedImpact(law, unequalPair());
  const double en = wanted.tension == Tension::cut ? is.enCut : is.enAllowed;
  // Closed forms and a root to 1e-14.
  EXPECT_NEAR(en, wanted.en, 1e-12);
  EXPECT_NEAR(is.contactTime, wantedTime, 1e-12 * wantedTime);
  EXPECT_NEAR(is.et0.value(), wanted.et0, 1e-12);
}

TEST_P(Calibration, TheTwoBodyProblemAgrees) {
  // The planar two-body problem knows none of the closed forms. At 1e-5 m/s the freezing of the
  // normal costs O(v t_c/a) = 2e-6; µ = 1e9 leaves slip no time.
  const Wanted wanted = GetParam();
  ContactLaw law = calibrated(wanted, unequalPair());
  law.mu = 1e9;
  const CollisionEnd end = oracleOutcome(law, unequalPair(), {1.0, 1e-5});
  EXPECT_NEAR(end.en, wanted.en, 1e-5);
  EXPECT_NEAR(end.psi, -wanted.et0, 1e-5);
}

constexpr auto spring = TangentialLaw::spring;
constexpr auto springDashpot = TangentialLaw::springDashpot;

INSTANTIATE_TEST_SUITE_P(Impacts, Calibration,
                         testing::Values(Wanted{Tension::allow, spring, 0.9, 0.5},
                                         Wanted{Tension::cut, spring, 0.9, 0.5},
                                         Wanted{Tension::allow, spring, 0.3, -0.7},
                                         Wanted{Tension::cut, spring, 0.3, -0.7},
                                         Wanted{Tension::allow, spring, 0.05, 0.0},
                                         Wanted{Tension::cut, spring, 0.15, 1.0},
                                         Wanted{Tension::allow, springDashpot, 0.9, 0.5},
                                         Wanted{Tension::cut, springDashpot, 0.9, 0.5},
                                         Wanted{Tension::allow, springDashpot, 0.3, 0.1},
                                         Wanted{Tension::cut, springDashpot, 0.3, 0.1},
                                         Wanted{Tension::allow, springDashpot, 1.0, 1.0},
                                         Wanted{Tension::cut, springDashpot, 1.0, 0.44}));

TEST(ReducedPairs, ByHand) {
  // m₁₂ = 1·3/4 g. Disks: a²/J = 2/m, so K = 1 + 2 m₁₂ (1/m_i + 1/m_j) = 3; spheres: 1 + 5/2.
  EXPECT_DOUBLE_EQ(reduced(unequalPair()).mass, 0.75e-3);
  EXPECT_DOUBLE_EQ(reduced(unequalPair()).K, 3.0);
  CollidingPair pair = unequalPair();
  for (double& inertia : pair.inertia) inertia *= 0.4 / 0.5;
  EXPECT_DOUBLE_EQ(reduced(pair).K, 3.5);
  // A disk that cannot turn: K = 1 + 2 m₁₂/m_j = 1 + 2·0.75/3.
  pair = unequalPair();
  pair.inertia[0] = std::numeric_limits<double>::infinity();
  EXPECT_DOUBLE_EQ(reduced(pair).K, 1.5);
  // A wall: the disk's own mass, and its own turning alone.
  pair = unequalPair();
  pair.mass[1] = pair.inertia[1] = std::numeric_limits<double>::infinity();
  EXPECT_DOUBLE_EQ(reduced(pair).mass, 1e-3);
  EXPECT_DOUBLE_EQ(reduced(pair).K, 3.0);
}

TEST(CalibrateNormal, ElasticContactByHand) {
  // e = 1: k_n = m₁₂ (π/t_c)² and no damping at all; tension makes no difference then.
  for (const Tension tension : {Tension::allow, Tension::cut}) {
    ContactLaw law;
    law.conventions.tension = tension;
    calibrateNormal(law, 1.0, 1e-3, 0.5e-3);
    EXPECT_NEAR(law.kn, 500.0 * pi * pi, 1e-9);
    EXPECT_EQ(law.gn, 0.0);
    EXPECT_FALSE(std::signbit(law.gn));
  }
}

TEST(CalibrateNormal, DampedContactByHand) {
  // e = exp(−π): η t_c = π = ω t_c, so k_n = 2 m₁₂ π²/t_c² and γ_n = 2π m₁₂/t_c.
  ContactLaw law;
  calibrateNormal(law, std::exp(-pi), 1e-3, 0.5e-3);
  EXPECT_NEAR(law.kn, 1000.0 * pi * pi, 1e-8);
  EXPECT_NEAR(law.gn, pi, 1e-12);
  // Cut, η = ω: f_n = 0 at ωt = π − atan2(2, 0) = π/2, so e = exp(−π/2) and half of that t_c.
  law.conventions.tension = Tension::cut;
  calibrateNormal(law, std::exp(-pi / 2.0), 0.5e-3, 0.5e-3);
  EXPECT_NEAR(law.kn, 1000.0 * pi * pi, 1e-8);
  EXPECT_NEAR(law.gn, pi, 1e-12);
}

TEST(CalibrateTangential, ElasticContactsByHand) {
  // Undamped disks, t_s = t_c: −cos(π √(3 k_t/k_n)) (Becker et al. 2008) is 0.5 at a phase of 2π/3,
  // k_t/k_n = (2/3)²/3, and 1 at k_t/k_n = 1/3.
  const CollidingPair pair = unequalPair();
  for (const auto& [et0, ratio] :
       {std::pair{0.5, 4.0 / 27.0}, {1.0, 1.0 / 3.0}, {0.0, 1.0 / 12.0}}) {
    const ContactLaw law = calibrated({Tension::allow, spring, 1.0, et0}, pair);
    EXPECT_NEAR(law.kt / law.kn, ratio, 1e-13);
    EXPECT_EQ(law.gt, 0.0);
  }
  // With a dashpot ω_t t_c = π, and e_t0 = exp(−π) needs η_t = ω_t: k_t = 2 k_n/3, γ_t = 2 m₁₂
  // η_t/3.
  const ContactLaw law = calibrated({Tension::allow, springDashpot, 1.0, std::exp(-pi)}, pair);
  EXPECT_NEAR(law.kt / law.kn, 2.0 / 3.0, 1e-13);
  EXPECT_NEAR(law.gt, 2.0 * 0.75e-3 * pi / (3.0 * wantedTime), 1e-12);
}

TEST(ImpliedImpact, ThesisDisks) {
  // Lätzel (2003), table 4.1: e_n 0.2223, without tension 0.3408, t_c 2.18 ms; sliding 1.770.
  ContactLaw law = test::thesisLaw();
  const ImpliedImpact is = impliedImpact(law, test::smallPair());
  EXPECT_NEAR(is.enAllowed, 0.2223, 5e-5);
  EXPECT_NEAR(is.enCut, 0.3408, 5e-5);
  EXPECT_NEAR(is.contactTime, test::smallContactTime, 5e-6);
  EXPECT_NEAR(is.slidingConstant.value(), 1.770, 5e-4);
  // Friction ends with f_n > 0, so cutting tension leaves e_t0 as it is.
  law.conventions.tension = Tension::cut;
  const ImpliedImpact cut = impliedImpact(law, test::smallPair());
  EXPECT_DOUBLE_EQ(cut.et0.value(), is.et0.value());
  EXPECT_LT(cut.contactTime, is.contactTime);
  EXPECT_DOUBLE_EQ(cut.halfPeriod, is.contactTime);
  law.mu = 1e9;
  EXPECT_NEAR(oracleOutcome(law, test::smallPair(), {1.0, 1e-5}).psi, -is.et0.value(), 1e-5);
}

TEST(ImpliedImpact, FirstTouchDecidesWhereTheResetSpringCarriesTheBound) {
  // e_t0 = 0.5, µ = 0.4: with spring_reset = total the contact slips from µ γ_n/γ_t on until v_t =
  // 0 and its spring is loaded meanwhile. A spring that leaves the dashpot its share sticks again.
  ContactLaw law = calibrated({Tension::allow, springDashpot, 0.9, 0.5}, unequalPair());
  law.mu = 0.4;
  EXPECT_FALSE(impliedImpact(law, unequalPair()).firstTouchSticksToPsi);
  const auto reversal = [&](double psi) {
    return -oracleOutcome(law, unequalPair(), {psi, 1e-5}).psi / psi;
  };
  const double last = law.mu * law.gn / law.gt;
  // 0.01: short slip when the contact ends, which lasts as long as f_n ≈ 0.
  for (const double psi : {0.8 * last, 1.2 * last, 4.0 * last})
    EXPECT_NEAR(reversal(psi), 0.5, 0.01);
  law.conventions.springReset = SpringReset::total;
  law.conventions.springUpdate = SpringUpdate::after;
  EXPECT_DOUBLE_EQ(impliedImpact(law, unequalPair()).firstTouchSticksToPsi.value(), last);
  EXPECT_NEAR(reversal(0.8 * last), 0.5, 0.01);
  EXPECT_GT(reversal(1.2 * last), 1.0);
}

TEST(ImpliedImpact, StickingEndsWhereWaltonsBranchesMeet) {
  ContactLaw law = test::thesisLaw();
  const ImpliedImpact is = impliedImpact(law, test::smallPair());
  const double psi = is.stickingEndsAtPsi.value();
  const double sticking = -is.et0.value() * psi;
  EXPECT_NEAR(psi - is.slidingConstant.value(), sticking, 1e-14);
}

TEST(ImpliedImpact, LargestOverlapOfAnUndampedContact) {
  // Energy: ½ k δ² = ½ m₁₂ v².
  ContactLaw law = test::thesisLaw();
  law.gn = 0.0;
  EXPECT_DOUBLE_EQ(impliedImpact(law, test::smallPair()).overlapPerSpeed,
                   std::sqrt(0.5 * test::smallMass / test::thesis.kn));
  // Damped: δ = (v/ω) e^{−ηt} sin ωt, sampled.
  law.gn = test::thesis.gn;
  const double eta = test::thesis.gn / test::smallMass;
  const double omega = std::sqrt(test::thesis.kn / (0.5 * test::smallMass) - eta * eta);
  double largest = 0.0;
  for (double t = 0.0; t < pi / omega; t += 1e-7)
    largest = std::max(largest, std::exp(-eta * t) * std::sin(omega * t) / omega);
  EXPECT_NEAR(impliedImpact(law, test::smallPair()).overlapPerSpeed, largest, 1e-6 * largest);
}

TEST(ImpliedImpact, WhatFrictionCannotSayIsAbsent) {
  ContactLaw law = test::thesisLaw();
  law.conventions.coulombBound = CoulombBound::magnitude;
  EXPECT_FALSE(impliedImpact(law, test::smallPair()).et0);
  EXPECT_FALSE(impliedImpact(law, test::smallPair()).slidingConstant);
  law.conventions.tension = Tension::cut;  // all bounds are the same then
  EXPECT_TRUE(impliedImpact(law, test::smallPair()).et0);
  law.tangential = TangentialLaw::none;
  EXPECT_FALSE(impliedImpact(law, test::smallPair()).et0);
}

TEST(StickingRestitution, AllBranches) {
  constexpr double t = 2.0;
  EXPECT_NEAR(stickingRestitution(0.0, 1.5, t), -std::cos(3.0), 1e-15);        // undamped
  EXPECT_NEAR(stickingRestitution(0.7, 0.0, t), -std::exp(-2.8), 1e-15);       // dashpot alone
  EXPECT_NEAR(stickingRestitution(0.7, 0.7, t), 0.4 * std::exp(-1.4), 1e-15);  // critical
  // Overdamped with rates 0.5 and 2: η = 1.25, Ω² = 1; v = (2 e^{−2t} − 0.5 e^{−t/2})/1.5.
  EXPECT_NEAR(stickingRestitution(1.25, 1.0, t),
              -(2.0 * std::exp(-4.0) - 0.5 * std::exp(-1.0)) / 1.5, 1e-15);
  // Continuous through critical damping, and nothing overflows far beyond it.
  for (const double off : {-1e-9, -1e-13, 1e-13, 1e-9})
    EXPECT_NEAR(stickingRestitution(0.7 + off, 0.7, t), 0.4 * std::exp(-1.4), 5e-9);
  EXPECT_NEAR(stickingRestitution(1e6, 1.0, t), 0.0, 1e-11);
}

TEST(StickingRestitution, TheTwoBodyProblemAgreesForDashpots) {
  // Viscous and overdamped tangential laws, which calibrateTangential does not make.
  ContactLaw law = test::thesisLaw();
  law.mu = 1e9;
  for (const TangentialLaw tangential : {TangentialLaw::viscous, TangentialLaw::springDashpot}) {
    law.tangential = tangential;
    law.kt = tangential == TangentialLaw::viscous ? 0.0 : 20.0;
    const double et0 = impliedImpact(law, test::smallPair()).et0.value();
    EXPECT_NEAR(oracleOutcome(law, test::smallPair(), {1.0, 1e-5}).psi, -et0, 1e-5);
  }
  law.kt = 20.0;
  EXPECT_FALSE(impliedImpact(law, test::smallPair()).omegaT);
}

TEST(Calibration, WhatCannotBeReachedIsRefused) {
  ContactLaw law;
  for (const double en : {0.0, -0.1, 1.0001, std::nan("")})
    EXPECT_THROW(calibrateNormal(law, en, 1e-3, 1e-3), std::invalid_argument) << en;
  law.conventions.tension = Tension::cut;
  EXPECT_THROW(calibrateNormal(law, std::exp(-2.0), 1e-3, 1e-3), std::invalid_argument);
  EXPECT_NO_THROW(calibrateNormal(law, 0.1354, 1e-3, 1e-3));
  const ReducedPair pair{1e-3, 3.0};
  law.tangential = spring;
  EXPECT_THROW(calibrateTangential(law, -1.0, pair), std::invalid_argument);
  EXPECT_THROW(calibrateTangential(law, 1.0001, pair), std::invalid_argument);
  law.tangential = springDashpot;
  EXPECT_THROW(calibrateTangential(law, 0.0, pair), std::invalid_argument);
  EXPECT_THROW(calibrateTangential(law, 1.0001, pair), std::invalid_argument);
  law.tangential = TangentialLaw::coulomb;
  EXPECT_THROW(calibrateTangential(law, 0.5, pair), std::invalid_argument);
  law = test::thesisLaw();
  law.gn = 1.0;  // critical: 2 √(352.1 · 0.1375e-3) = 0.44 kg/s
  EXPECT_THROW(impliedImpact(law, test::smallPair()), std::invalid_argument);
}

/// A disk of 1 g and 5 mm on a plane: I = 3/2 m a², K = I ((2π 20)² + 25), G = 10 I; and
/// back, by every convention.
TEST(CalibrateRolling, FrequencyAndDecay_AreThoseOfTheOscillator) {
  const CollidingPair disk = diskOnWall(5e-3, 1e-3, 0.5 * 1e-3 * 25e-6);
  for (const CollidingPair& pair : {disk, unequalPair()})
    for (const auto stiffness :
         {RollingStiffness::lengthSquare, RollingStiffness::radii, RollingStiffness::constant})
      for (const auto damper : {RollingDamper::constant, RollingDamper::critical}) {
        ContactLaw law;
        law.rolling = RollingLaw::spring;
        law.conventions.rollingStiffness = stiffness;
        law.conventions.rollingDamper = damper;
        calibrateRolling(law, pair, 20.0, 5.0);
        EXPECT_NEAR(impliedRolling(law, pair).frequency, 20.0, 1e-12);
        EXPECT_NEAR(impliedRolling(law, pair).decay, 5.0, 1e-12);
      }
  ContactLaw law;
  law.rolling = RollingLaw::spring;
  calibrateRolling(law, disk, 20.0, 5.0);
  const double inertia = 1.5 * 1e-3 * 25e-6;
  EXPECT_NEAR(law.kr, inertia * (1600.0 * pi * pi + 25.0) / 25e-6, 1e-9);
  EXPECT_NEAR(law.gr, 2.0 * inertia * 5.0 / 25e-6, 1e-15);
}

TEST(CalibrateRolling, AngleOfRest_IsTheCoefficientsTangent) {
  ContactLaw law;
  EXPECT_NEAR(rollingCoefficientOf(law, 0.3), std::tan(0.3), 1e-15);
  law.conventions.rollingLength = RollingLength::twiceEffective;
  EXPECT_NEAR(rollingCoefficientOf(law, 0.3), 0.5 * std::tan(0.3), 1e-15);
  law.muR = rollingCoefficientOf(law, 0.3);
  EXPECT_NEAR(restAngle(law), 0.3, 1e-15);
}

/// R₁₂ = 0.25 m, γ = 100 J/m², w = 200 J/m²: 235.62 N under JKR, 314.16 N under DMT.
TEST(CalibrateAdhesion, WorkOfAdhesion_IsThatOfThePull) {
  ContactLaw law;
  law.cohesion = CohesionLaw::jkr;
  EXPECT_NEAR(workOfAdhesion(law, 235.6194490, 0.25), 200.0, 1e-6);
  law.cohesion = CohesionLaw::dmt;
  EXPECT_NEAR(workOfAdhesion(law, 314.1592654, 0.25), 200.0, 1e-6);
}

}  // namespace
