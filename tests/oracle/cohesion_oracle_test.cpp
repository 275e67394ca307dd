// The oracle of bodies that attract each other: closed forms, sticking, small steps.
#include <gtest/gtest.h>

#include <cmath>

#include "law/cohesion.hpp"
#include "oracle/collision_end.hpp"
#include "oracle/collision_oracle.hpp"
#include "oracle/impact.hpp"
#include "random_pair.hpp"
#include "tests/support/pairs.hpp"

namespace {

using namespace crossgrain;
using namespace test;

/// Two spheres of 0.5 m and 1 kg, E* = 5e4 Pa, w = 200 J/m²: R₁₂ = 0.25 m, as LAMMPS was run.
CollidingPair spheres() {
  return {{0.5, 0.5}, {1.0, 1.0}, {0.1, 0.1}};
}

ContactLaw adhesive(CohesionLaw cohesion, JkrEnd end = JkrEnd::largestPull) {
  ContactLaw law;
  law.normal = NormalLaw::hertz;
  law.tangential = TangentialLaw::none;
  law.kn = 4.0 / 3.0 * 5e4;
  law.w = 200.0;
  law.cohesion = cohesion;
  law.conventions.jkrEnd = end;
  return law;
}

ContactLaw elastoPlastic(double kc, double depth = 0.0) {
  ContactLaw law;
  law.tangential = TangentialLaw::none;
  law.kn = 1e4;
  law.kUnload = 4e4;
  law.kc = kc;
  law.plasticDepth = depth;
  law.cohesion = CohesionLaw::elastoPlastic;
  return law;
}

TEST(JkrForms, CharacteristicPoints_AreThoseOfTheEquations) {
  const ContactLaw law = adhesive(CohesionLaw::jkr);
  const double R = 0.25, pull = pullOff(law, R), unit = jkrUnit(law, R);
  EXPECT_NEAR(pull, 1.5 * M_PI * 200.0 * R, 1e-12);
  const auto force = [&](double overlap) {
    const double y = jkrRoot(overlap / unit), cube = y * y * y;
    return pull * (cube - 2.0) * cube;
  };
  // Figures of another program (LAMMPS 29 Sep 2021) for this pair.
  EXPECT_NEAR(force(0.002), -201.2221, 1e-4);
  EXPECT_NEAR(force(0.0), -8.0 / 9.0 * pull, 1e-12 * pull);
  EXPECT_NEAR(force(-0.012), -235.6027, 1e-4);
  EXPECT_NEAR(bondRange(law, R), 1.2277 * std::cbrt(1e4 * R / 25e8), 1e-6);
  EXPECT_NEAR(force(-bondRange(law, R)), -pull, 1e-10 * pull);
  EXPECT_NEAR(jkrRoot(-std::cbrt(9.0) / 3.0), std::cbrt(1.0 / 3.0), 1e-8);  // a double root
  for (const double t : {1.0, 1e3, 1e6}) {
    const double y = jkrRoot(t);
    EXPECT_NEAR(y * y * y * y - 4.0 / 3.0 * y, t, 1e-14 * t);
  }
}

/// ∫ F dδ over the contact by Simpson's rule in y.
TEST(JkrForms, LossFactors_AreTheIntegralOfTheForce) {
  for (const JkrEnd end : {JkrEnd::largestPull, JkrEnd::branch}) {
    const double from = end == JkrEnd::branch ? std::cbrt(1.0 / 3.0) : 1.0,
                 to = std::cbrt(4.0 / 3.0);
    const auto power = [](double y) {  // F dδ/dy
      const double cube = y * y * y;
      return (cube - 2.0) * cube * (4.0 * cube - 4.0 / 3.0);
    };
    constexpr int n = 1000;
    double sum = 0.0;
    for (int k = 0; k < n; ++k) {
      const double h = (to - from) / n, y = from + k * h;
      sum += h / 6.0 * (power(y) + 4.0 * power(y + 0.5 * h) + power(y + h));
    }
    EXPECT_NEAR(jkrLossFactor(end), -sum, 1e-10);
  }
  EXPECT_NEAR(jkrLossFactor(JkrEnd::largestPull), 0.3203, 5e-5);
  EXPECT_NEAR(jkrLossFactor(JkrEnd::branch), 0.6486, 5e-5);
  // Thornton and Ning's 7.09 (w⁵ R⁴/E*²)^⅓.
  const ContactLaw law = adhesive(CohesionLaw::jkr);
  const double scale = std::cbrt(std::pow(200.0, 5) * std::pow(0.25, 4) / 25e8);
  EXPECT_NEAR(jkrLossFactor(JkrEnd::branch) * pullOff(law, 0.25) * jkrUnit(law, 0.25) / scale, 7.09,
              5e-3);
}

/// e² = 1 − (v_s/v)², and just below v_s it sticks.
TEST(CohesionOracle, Jkr_LosesTheClosedFormAndSticksBelowItsSpeed) {
  for (const JkrEnd end : {JkrEnd::largestPull, JkrEnd::branch})
    for (const CollidingPair& pair : {spheres(), diskOnWall(0.5, 1.0, 0.1)}) {
      const ContactLaw law = adhesive(CohesionLaw::jkr, end);
      const double stick = stickingSpeed(law, pair).value();
      for (const double times : {1.02, 1.5, 5.0, 20.0}) {
        const CollisionEnd out = oracleOutcome(law, pair, {0.0, times * stick});
        ASSERT_TRUE(out.parted) << times;
        EXPECT_NEAR(out.en * out.en, 1.0 - 1.0 / (times * times), 1e-8) << times;
        EXPECT_NEAR(out.lost->detachment.value(), 0.5 * pair.reducedMass() * stick * stick,
                    1e-8 * out.energyBefore);
        EXPECT_NEAR(out.lost->normalDamping, 0.0, 1e-12 * out.energyBefore);
      }
      EXPECT_FALSE(oracleOutcome(law, pair, {0.0, 0.99 * stick}).parted);
      EXPECT_FALSE(oracleOutcome(law, pair, {0.0, 0.1 * stick}).parted);
    }
}

TEST(CohesionOracle, DmtAndArea_LoseNothing) {
  ContactLaw area = adhesive(CohesionLaw::area);
  area.kc = 2e3;
  for (const ContactLaw& law : {adhesive(CohesionLaw::dmt), area})
    for (const double speed : {0.5, 5.0}) {
      const CollisionEnd out = oracleOutcome(law, spheres(), {0.0, speed});
      ASSERT_TRUE(out.parted);
      EXPECT_NEAR(out.en, 1.0, 1e-8);
      EXPECT_EQ(closedRestitution(law, 0.5), 1.0);
      EXPECT_FALSE(out.lost->detachment);
    }
}

/// U = 2/5 k_n √R δ^2.5 − F_po δ equals the energy at the deepest overlap; of the area that of the
/// two lenses, ∫ A dδ = π δ² (a − δ/3) on a plane.
TEST(CohesionOracle, DeepestOverlap_IsThatOfTheWork) {
  const CollidingPair pair = diskOnWall(0.5, 1.0, 0.1);
  const ContactLaw dmt = adhesive(CohesionLaw::dmt);
  const double d = *oracleOutcome(dmt, pair, {0.0, 2.0}).maxOverlap;
  EXPECT_NEAR(0.4 * dmt.kn * std::sqrt(0.5) * std::pow(d, 2.5) - pullOff(dmt, 0.5) * d, 2.0, 1e-8);
  ContactLaw area = elastoPlastic(0.0);
  area.cohesion = CohesionLaw::area;
  area.kc = 1e3;
  const double a = *oracleOutcome(area, pair, {0.0, 2.0}).maxOverlap;
  EXPECT_NEAR(0.5 * area.kn * a * a - area.kc * M_PI * a * a * (0.5 - a / 3.0), 2.0, 1e-8);
}

TEST(CohesionOracle, ElastoPlastic_HasTheRestitutionOfItsAreas) {
  for (const double kc : {0.0, 500.0, 2e3})
    for (const double depth : {0.0, 0.05}) {
      const ContactLaw law = elastoPlastic(kc, depth);
      for (const double speed : {0.2, 1.0, 4.0, 8.0}) {  // δ* = 1/30 is reached at 4.7
        const CollisionEnd out = oracleOutcome(law, spheres(), {0.0, speed});
        const double expected = elastoPlasticRestitution(law, spheres(), speed);
        ASSERT_EQ(out.parted, expected > 0.0) << kc << " " << depth << " " << speed;
        if (!out.parted) continue;
        EXPECT_NEAR(out.en, expected, 1e-8) << kc << " " << depth << " " << speed;
        EXPECT_NEAR(out.lost->plastic.value(), (1.0 - expected * expected) * out.energyBefore,
                    1e-8 * out.energyBefore);
      }
    }
  EXPECT_DOUBLE_EQ(closedRestitution(elastoPlastic(0.0), 1.0).value(), 0.5);
}

/// Beyond δ* an impact is elastic: the energies at its deepest point are ½ k₁ δ*² and that under
/// the line k₂max (δ − φ 2 R₁₂), φ 2 R₁₂ = 0.025, which begins at k₁ δ*.
TEST(CohesionOracle, ElastoPlastic_BeyondItsLimit_IsElastic) {
  const ContactLaw law = elastoPlastic(0.0, 0.05);
  const double limit = 0.1 / 3.0, speed = 8.0;
  const CollisionEnd out = oracleOutcome(law, spheres(), {0.0, speed});
  const double force = law.kUnload * (*out.maxOverlap - 0.025);
  const double work = 0.5 * law.kn * limit * limit +
                      0.5 * (force * force - std::pow(law.kn * limit, 2)) / law.kUnload;
  EXPECT_NEAR(work, out.energyBefore, 1e-8 * out.energyBefore);
  // What it loses is the area between k₁ δ and k₂max (δ − 0.025) up to δ*.
  EXPECT_NEAR(out.lost->plastic.value(), 0.5 * law.kn * limit * 0.025, 1e-8 * out.energyBefore);
}

/// k_c = 2e4: e² = 1/4 − 2 (½)(¾) < 0.
TEST(CohesionOracle, ElastoPlastic_PullsTooMuch_Sticks) {
  EXPECT_EQ(closedRestitution(elastoPlastic(2e4), 1.0), 0.0);
  EXPECT_FALSE(oracleOutcome(elastoPlastic(2e4), spheres(), {0.0, 1.0}).parted);
}

/// Without its pull the load of a parting JKR contact is Hertz' force, lost in the rounding of F_po
/// before δ = 0, and a bound of |0| lay between holding v_t = 0 or θ = 0 and slipping. Normal
/// motion on a plane is that of a frictionless contact, e² = 1 − (v_s/v)².
TEST(CohesionOracle, LoadThatVanishesBeforeTheBodiesPart_DoesNotHaltIt) {
  ContactLaw law = adhesive(CohesionLaw::jkr);
  law.mu = 0.3;
  law.muR = 0.2;
  law.kr = 1e3;
  law.conventions.coulombBound = CoulombBound::magnitude;
  law.conventions.rollingLoad = RollingLoad::magnitude;
  const CollidingPair pair = diskOnWall(0.5, 1.0, 0.1);
  const double stick = stickingSpeed(law, pair).value();
  for (const auto& [tangential, rolling] :
       {std::pair{TangentialLaw::coulomb, RollingLaw::none},
        std::pair{TangentialLaw::none, RollingLaw::spring},
        std::pair{TangentialLaw::none, RollingLaw::constantTorque}}) {
    law.tangential = tangential;
    law.rolling = rolling;
    for (int k = 0; k < 40; ++k) {
      const double times = 1.5 + 0.1 * k;
      CollisionEnd end;
      ASSERT_NO_THROW(end = oracleOutcome(law, pair, {0.2, times * stick, Approach::oblique}))
          << times;
      EXPECT_NEAR(end.en * end.en, 1.0 - 1.0 / (times * times), 1e-8) << times;
    }
  }
}

/// Where γ_t |v_t| is the bound to the last bit, and the bound falls, a viscous contact slips. One
/// of 4000 random laws that meets it.
TEST(CohesionOracle, ViscousForceEqualToItsBound_Slips) {
  ContactLaw law;
  law.damper = Damper::critical;
  law.kn = 8590.2109640893268;
  law.kt = 8826.6961902222884;
  law.tangential = TangentialLaw::viscous;
  law.gt = 0.3;
  law.mu = 0.17216828710882892;
  law.cohesion = CohesionLaw::dmt;
  law.w = 0.0093999113166184506;
  law.rolling = RollingLaw::spring;
  law.kr = 0.0048979289262101001;
  law.gr = 0.43621753906041627;
  law.muR = 0.53087143791277702;
  LawConventions& how = law.conventions;
  how.springUpdate = SpringUpdate::midpoint;
  how.springReset = how.rollingReset = SpringReset::springOnly;
  how.history = History::force;
  how.cohesionLoad = CohesionLoad::magnitudePlusPullOff;
  how.rollingDamper = RollingDamper::critical;
  how.rollingStiffness = RollingStiffness::constant;
  how.rollingLength = RollingLength::smallerRadius;
  const CollidingPair pair = diskOnWall(0.0011227701338201465, 1e-4, 5.1312627379199425e-11);
  const CollisionStart start{1.8006635992871836, 0.0016609285766284619};
  CollisionEnd end;
  ASSERT_NO_THROW(end = oracleOutcome(law, pair, start));
  EXPECT_NEAR(end.en, 1.0, 1e-8);  // no dashpot along n; DMT's pull is conservative
}

/// The in-house engine in steps of t_c/4000. A pull that begins or ends with a jump acts up to half
/// a step too long or too short at either end: F_po v dt of the energy, F_po dt/(m₁₂ v) of e. JKR's
/// end is that of the bond, beyond δ = 0; what sticks has no end.
TEST(CohesionOracle, Engine_MeetsItAndSticksWhereItDoes) {
  Case setup;
  setup.source = Collision();
  for (const int side : {0, 1}) {
    collisionIn(setup).radius[side] = 0.5;
    collisionIn(setup).mass[side] = 1.0;
  }
  collisionIn(setup).inertiaFactor = 0.4;
  ContactLaw area = elastoPlastic(0.0);
  area.cohesion = CohesionLaw::area;
  area.kc = 2e3;
  for (const bool wall : {false, true})
    for (const ContactLaw& law :
         {adhesive(CohesionLaw::dmt), adhesive(CohesionLaw::jkr),
          adhesive(CohesionLaw::jkr, JkrEnd::branch), area, elastoPlastic(2e3, 0.05)})
      for (const double speed : {1.0, 6.0}) {
        setup.law = law;
        setup.law.conventions.integrator = Integrator::velocityVerlet;
        collisionIn(setup).wall = wall;
        const CollidingPair pair = collidingPair(setup);
        const CollisionStart start{0.5, speed, Approach::oblique};
        const CollisionEnd expected = oracleOutcome(setup.law, pair, start);
        const double time =
            impactTime(setup.law, {pair.reducedMass(), pair.reducedRadius(), speed});
        const double dt = time / 4000.0;
        const auto found = endByEngine(setup, start, dt, longestContact * time);
        ASSERT_EQ(found.has_value(), expected.parted) << speed;
        if (!found) continue;
        const double jumps = pullOff(law, pair.reducedRadius()) * dt;
        EXPECT_NEAR(found->en, expected.en, 1e-4 + jumps / (pair.reducedMass() * speed))
            << static_cast<int>(law.cohesion) << speed;
        EXPECT_NEAR(*found->duration, *expected.duration, 1e-3 * time);
      }
}

ContactLaw randomCohesion(Draw& draw, const CollidingPair& pair) {
  ContactLaw law;
  LawConventions& how = law.conventions;
  law.cohesion = draw.oneOf(
      {CohesionLaw::area, CohesionLaw::dmt, CohesionLaw::jkr, CohesionLaw::elastoPlastic});
  const double R = pair.reducedRadius();
  const bool hertz = law.cohesion == CohesionLaw::jkr ||
                     (law.cohesion == CohesionLaw::dmt && draw.oneOf({false, true}));
  law.normal = hertz ? NormalLaw::hertz : NormalLaw::linear;
  law.kn = hertz ? draw.logarithmic(1e7, 1e9) : draw.logarithmic(1e3, 1e5);
  law.damper = Damper::critical;
  law.gn = draw.oneOf({0.0, 0.1, 0.4});
  law.gt = law.gn > 0.0 ? draw.uniform(0.05, 0.5) : 0.0;
  law.kt = law.kn * draw.uniform(0.3, 1.2);
  law.mu = draw.uniform(0.05, 0.8);
  law.tangential = draw.oneOf({TangentialLaw::none, TangentialLaw::coulomb, TangentialLaw::viscous,
                               TangentialLaw::springDashpot});
  if (law.tangential == TangentialLaw::viscous) law.gt = 0.3;
  law.kUnload = law.kn * draw.uniform(1.5, 6.0);
  law.plasticDepth = draw.oneOf({0.0, 0.02, 0.0, 1e-3});
  how.tension = draw.oneOf({Tension::allow, Tension::cut});
  how.springUpdate = SpringUpdate::midpoint;
  how.springReset = SpringReset::springOnly;
  how.history = History::force;
  how.coulombBound = draw.oneOf({CoulombBound::compression, CoulombBound::magnitude});
  how.cohesionArea =
      draw.oneOf({CohesionArea::lens, CohesionArea::firstOrder, CohesionArea::twiceBetweenDisks});
  how.jkrEnd = draw.oneOf({JkrEnd::largestPull, JkrEnd::branch});
  how.cohesionLoad =
      draw.oneOf({CohesionLoad::net, CohesionLoad::withoutPull, CohesionLoad::plusTwicePullOff,
                  CohesionLoad::magnitudePlusPullOff, CohesionLoad::netWithoutDashpot});
  if (law.cohesion == CohesionLaw::area)
    law.kc = draw.uniform(0.05, 0.4) * law.kn / (4.0 * M_PI * R);
  if (law.cohesion == CohesionLaw::elastoPlastic) law.kc = draw.uniform(0.0, 0.1) * law.kn;
  return law;
}

/// A speed at which the pull matters: the energy is some times what it does over its own length.
double speedFor(Draw& draw, ContactLaw& law, const CollidingPair& pair) {
  const double R = pair.reducedRadius(), depth = R * draw.logarithmic(1e-4, 1e-2);
  const double energy = elasticEnergy(law, R, depth);
  // F_po d = energy/10 … energy of the loss at most
  if (law.cohesion == CohesionLaw::dmt || law.cohesion == CohesionLaw::jkr) {
    law.w = draw.uniform(0.05, 0.3) * energy / depth / (2.0 * M_PI * R);
  }
  return std::sqrt(2.0 * energy / pair.reducedMass());
}

/// Steps of t_c/2000 that find a jump of the force, or a slip, a step late err by some steps'
/// share, 2e-3 of v_n, of Ψ_f times the arms (K = 3).
TEST(RandomCohesion, Oracle_ClosesTheAccountAndIsWhatSmallStepsGive) {
  Draw draw(21);
  int parted = 0, stuck = 0, noLimit = 0;
  double worst = 0.0;
  for (int k = 0; k < 120; ++k) {
    SCOPED_TRACE(k);
    Collision c;
    drawPair(draw, c);
    Case setup;
    setup.source = c;
    collisionIn(setup).wall = draw.oneOf({false, true});
    const CollidingPair pair = collidingPair(setup);
    ContactLaw law = randomCohesion(draw, pair);
    const CollisionStart start{draw.uniform(0.0, 3.0), speedFor(draw, law, pair),
                               draw.oneOf({Approach::spin, Approach::oblique})};
    const CollisionEnd end = oracleOutcome(law, pair, start);
    const double time = impactTime(law, {pair.reducedMass(), pair.reducedRadius(), start.vn});
    const auto plain = PlainIntegration::run(law, pair, start, time, 2000.0, 0.3);
    ASSERT_EQ(end.parted, std::isfinite(plain.en))
        << static_cast<int>(law.cohesion) << " " << end.en;
    (end.parted ? parted : stuck) += 1;
    noLimit += end.noLimit;
    if (!end.parted) continue;
    EXPECT_NEAR(accountOf(end), end.energyBefore, 1e-8 * end.energyBefore)
        << static_cast<int>(law.cohesion);
    EXPECT_NEAR(end.en, plain.en, 6e-3) << static_cast<int>(law.cohesion);
    if (end.noLimit) continue;
    EXPECT_NEAR(end.psi, plain.psi, 0.02) << static_cast<int>(law.cohesion);
    worst = std::max(worst, std::abs(end.psi - plain.psi));
    const CollisionEnd odd = oracleOutcome(law, pair, {-start.psi, start.vn, start.approach});
    EXPECT_NEAR(odd.psi, -end.psi, 1e-7);
  }
  RecordProperty("largest_difference_of_psi", std::to_string(worst));
  EXPECT_GT(parted, 75);
  EXPECT_GT(stuck, 0);
  EXPECT_LT(noLimit, 10);
}

}  // namespace
