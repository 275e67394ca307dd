// The penalty engine's laws of rolling resistance and cohesion, by closed forms and by hand.
#include "engines/box2d/general_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/box2d/scenes.hpp"

namespace crossgrain::test {
namespace {

using std::numbers::pi;
namespace box = box2d_granular;

/// Two spheres of .5 m, R₁₂ = .25 m, of E* = 5e4 Pa, or one of .5 m at a plane.
box::PairMotion at(double overlap, bool plane = false) {
  return {overlap, 0.0, 0.0, 0.0, 0.5, plane ? 0.0 : 0.5, 1.0, 0.0, 1e-5};
}

box::SoftLaw adhesive(box::Cohesion cohesion) {
  box::SoftLaw law;
  law.normal = box::Normal::hertz;
  law.kn = 4.0 / 3.0 * 5e4;
  law.cohesion = cohesion;
  law.w = 200.0;
  return law;
}

double forceAt(const box::SoftLaw& law, const box::PairMotion& motion) {
  box::PairMemory memory;
  return pairForce(law, motion, memory).normal;
}

// Forces that LAMMPS gives for γ = w/2 = 100 J/m², R₁₂ = .25 m, E* = 5e4 Pa.
TEST(Box2dAdhesion, JkrForce_IsTheKnownOneOnBothSidesOfTouch) {
  const box::SoftLaw law = adhesive(box::Cohesion::jkr);
  const double pull = 1.5 * pi * 200.0 * 0.25;
  EXPECT_NEAR(forceAt(law, at(0.002)), -201.2221, 1e-4);
  EXPECT_NEAR(forceAt(law, at(0.0)), -8.0 / 9.0 * pull, 1e-9 * pull);
  EXPECT_NEAR(forceAt(law, at(-0.012)), -235.6027, 1e-4);
  EXPECT_NEAR(bondRange(law, 0.25), 0.012277, 1e-6);
  EXPECT_NEAR(forceAt(law, at(-bondRange(law, 0.25))), -pull, 1e-9 * pull);
  box::SoftLaw whole = law;
  whole.jkrEnd = box::JkrEnd::branch;  // δ/δ_p = 3^(2/3) there, the pull 5/9
  EXPECT_NEAR(bondRange(whole, 0.25), std::cbrt(9.0) * bondRange(law, 0.25), 1e-9);
  EXPECT_NEAR(forceAt(whole, at(-bondRange(whole, 0.25))), -5.0 / 9.0 * pull, 1e-6 * pull);
}

TEST(Box2dAdhesion, DmtAndAreaForces_ByHand) {
  const double elastic = 4.0 / 3.0 * 5e4 * 0.5 * std::pow(0.01, 1.5);
  EXPECT_NEAR(forceAt(adhesive(box::Cohesion::dmt), at(0.01)), elastic - 2.0 * pi * 200.0 * 0.25,
              1e-9);
  box::SoftLaw law = adhesive(box::Cohesion::area);
  law.kc = 1e3;
  // Equal spheres: h² = a² − (a − δ/2)²; a plane: a² − (a − δ)².
  EXPECT_NEAR(forceAt(law, at(0.01)), elastic - 1e3 * pi * (0.25 - 0.495 * 0.495), 1e-9);
  EXPECT_NEAR(forceAt(law, at(0.01, true)),
              std::sqrt(2.0) * elastic - 1e3 * pi * (0.25 - 0.49 * 0.49), 1e-9);
  law.cohesionArea = box::CohesionArea::twiceBetweenDisks;
  EXPECT_NEAR(forceAt(law, at(0.01)), elastic - 1e3 * 4.0 * pi * 0.25 * 0.01, 1e-9);
  EXPECT_NEAR(forceAt(law, at(0.01, true)), std::sqrt(2.0) * elastic - 1e3 * 2.0 * pi * 0.5 * 0.01,
              1e-9);
}

TEST(Box2dAdhesion, LoadsOfBounds_AreTheConventions) {
  box::SoftLaw law = adhesive(box::Cohesion::dmt);
  law.tangential = box::Tangential::coulomb;
  law.mu = 0.5;
  const double pull = 2.0 * pi * 200.0 * 0.25;
  for (const auto& [load, bound] : {std::pair(box::CohesionLoad::net, 0.0),
                                    {box::CohesionLoad::withoutPull, 0.0},
                                    {box::CohesionLoad::plusTwicePullOff, 0.5 * pull},
                                    {box::CohesionLoad::magnitudePlusPullOff, pull}}) {
    law.cohesionLoad = load;
    box::PairMotion motion = at(0.0);  // f_n = −F_po
    motion.tangentialVelocity = 1.0;
    box::PairMemory memory;
    EXPECT_NEAR(-pairForce(law, motion, memory).tangential, bound, 1e-9);
  }
}

/// Speed after an impact by that at its beginning, of m₁₂ = 1 kg, by Störmer's scheme.
double restitution(const box::SoftLaw& law, double speed) {
  const double dt = 1e-6;
  box::PairMemory memory;
  double overlap = 0.0, v = speed;
  do {
    v -= dt * pairForce(law, at(overlap), memory).normal;
    overlap += dt * v;
  } while (overlap > 0.0);
  return -v / speed;
}

// e² = k₁/k₂ − k_c δ_min δ₀/(k₁ δ_m²) with δ₀ = (1 − k₁/k₂) δ_m, δ_min = (k₂ − k₁) δ_m/(k₂ + k_c):
// triangles of loading, unloading and pull where k₂ is the limit's. δ_m = v √(m/k₁).
TEST(Box2dAdhesion, ElastoPlasticImpact_LosesTheLoopsArea) {
  box::SoftLaw law;
  law.kn = 1e4;
  law.kUnload = 4e4;
  law.cohesion = box::Cohesion::elastoPlastic;
  for (const double kc : {0.0, 1e3}) {
    law.kc = kc;
    const double k2 = law.kUnload, zero = 1.0 - law.kn / k2, least = (k2 - law.kn) / (k2 + kc);
    // First order in the step: 0.2 of 3e4 steps of an impact, a dozen of them wrong at its corners.
    EXPECT_NEAR(restitution(law, 0.1), std::sqrt(law.kn / k2 - kc * least * zero / law.kn), 1e-3);
  }
  // With a depth: k₂ = k₁ + (k₂max − k₁) δ_m/δ*, δ* = k₂max/(k₂max − k₁) φ 2 R₁₂.
  law.kc = 0.0;
  law.plasticDepth = 0.01;
  const double deepest = 0.1 / std::sqrt(law.kn), full = 4.0 / 3.0 * 0.01 * 0.5;
  EXPECT_NEAR(restitution(law, 0.1), std::sqrt(law.kn / (law.kn + 3e4 * deepest / full)), 1e-3);
  // Beyond δ* it is elastic: of the energy it loses what one to δ* does, ¾ of ½ k₁ δ*², δ* = δ_m/5.
  law.plasticDepth = 3e-4;
  EXPECT_NEAR(restitution(law, 0.1), std::sqrt(1.0 - 0.75 / 25.0), 1e-3);
}

// What a yielding contact gives back is ½ f²/k₂; half way to δ*, k₂ is half way from k₁ to k₂max.
TEST(Box2dAdhesion, ElastoPlasticEnergy_IsTheTriangleOfUnloading) {
  box::SoftLaw law;
  law.kn = 1e4;
  law.kUnload = 4e4;
  law.plasticDepth = 0.01;
  law.cohesion = box::Cohesion::elastoPlastic;
  const double depth = 0.5 * 4.0 / 3.0 * 0.01 * 0.5, force = law.kn * depth;
  box::PairMemory memory;
  EXPECT_NEAR(pairForce(law, at(depth), memory).normal, force, 1e-12 * force);
  EXPECT_NEAR(storedEnergy(law, at(depth), memory), 0.5 * force * force / 2.5e4, 1e-12);
}

TEST(Box2dRolling, Torques_ByHand) {
  box::PairMotion pair = at(0.01);
  pair.a = 0.2;
  pair.b = 0.1;
  pair.spin = 3.0;
  pair.dt = 1e-3;
  pair.rollingInertia = 0.02;
  box::SoftLaw law;
  law.kn = 1e4;  // N = 100 N
  law.muR = 0.1;
  law.gr = 2.0;
  law.kr = 50.0;
  const auto torque = [&](box::PairMemory memory = {}) {
    return pairForce(law, pair, memory).rolling;
  };
  const double effective = 0.02 / 0.3;
  for (const auto& [length, metres] : {std::pair(box::RollingLength::effective, effective),
                                       {box::RollingLength::twiceEffective, 2.0 * effective},
                                       {box::RollingLength::smallerRadius, 0.1},
                                       {box::RollingLength::meanRadius, 0.15}}) {
    law.rollingLength = length;
    law.rolling = box::Rolling::constantTorque;
    EXPECT_NEAR(torque(), -0.1 * metres * 100.0, 1e-12);
    law.rolling = box::Rolling::viscous;
    EXPECT_NEAR(torque(), -2.0 * metres * metres * 3.0, 1e-12);
    law.rolling = box::Rolling::viscousByLoad;
    EXPECT_NEAR(torque(), -0.1 * metres * metres * 100.0 * 3.0, 1e-12);
  }
  law.rolling = box::Rolling::spring;
  law.gr = 0.0;
  law.rollingLength = box::RollingLength::effective;
  box::PairMemory turned;
  turned.angle = 0.01;
  for (const auto& [stiffness, k] :
       {std::pair(box::RollingStiffness::lengthSquare, 50.0 * effective * effective),
        {box::RollingStiffness::radii, 50.0 * 0.02},
        {box::RollingStiffness::constant, 50.0}}) {
    law.rollingStiffness = stiffness;
    EXPECT_NEAR(torque(turned), -k * 0.01, 1e-12);
    law.stretchBefore = true;
    EXPECT_NEAR(torque(turned), -k * 0.013, 1e-12);
    law.stretchBefore = false;
  }
  // k = 50 N m: 2 η √(I k) ω_r; together beyond µ_r L N = 0.667 N m. Outside the bound the spring
  // alone is held to it.
  law.rollingDamper = box::RollingDamper::critical;
  law.gr = 0.05;
  EXPECT_NEAR(torque(), -2.0 * 0.05 * std::sqrt(0.02 * 50.0) * 3.0, 1e-12);
  turned.angle = 0.01;
  EXPECT_NEAR(torque(turned), -10.0 * effective, 1e-12);
  law.rollingDashpotOutside = true;
  EXPECT_NEAR(torque(turned), -0.5 - 0.3, 1e-12);
  law.rollingLoad = box::RollingLoad::elastic;
  pair.normalVelocity = -1.0;
  law.gn = 50.0;  // f_n = 150 N, of which 100 N count
  turned.angle = 1.0;
  EXPECT_NEAR(torque(turned), -10.0 * effective, 1e-12);
  // Parting so fast that tension is cut: no load, no torque, or no limit.
  law.rollingLoad = box::RollingLoad::compression;
  law.cutTension = true;
  pair.normalVelocity = 10.0;
  pair.spin = 0.0;
  EXPECT_EQ(torque(turned), 0.0);
  law.rollingLoad = box::RollingLoad::whileCompressed;
  EXPECT_NEAR(torque(turned), -50.0, 1e-12);
}

// The engine finds the contact as long as the bond lasts, beyond the shapes' overlap.
TEST(Box2dPenalty, JkrBond_LastsBeyondTheOverlap) {
  Scene scene;
  scene.law.normal = NormalLaw::hertz;
  scene.law.tangential = TangentialLaw::none;
  scene.law.kn = 4.0 / 3.0 * 5e4;
  scene.law.cohesion = CohesionLaw::jkr;
  scene.law.w = 200.0;
  scene.dt = 1e-3;
  // So heavy that nothing changes their way: from an overlap of .5 mm apart at .1 m/s.
  addDisk(scene, 0.5, 1e6, {-0.49975, 0.0}, {-0.05, 0.0});
  addDisk(scene, 0.5, 1e6, {0.49975, 0.0}, {0.05, 0.0});
  const auto engine = makeBox2dPenalty();
  engine->load(scene, {});
  double last = 0.0, pull = 0.0;
  for (int step = 1; step < 200; ++step) {
    engine->advance(step * scene.dt);
    const Snapshot now = engine->snapshot(ContactReport::instant);
    if (now.contacts->size() == 0) break;
    last = now.contacts->overlap[0];
    pull = now.contacts->normalForce[0];
  }
  EXPECT_NEAR(last, -0.012277, 0.1e-3);  // within a step
  EXPECT_NEAR(pull, -1.5 * pi * 200.0 * 0.25, 0.01 * 235.6);
}

TEST(Box2dPenalty, PairsOfMaterials_HaveTheirOwnLaws) {
  Scene scene;
  scene.law = box2dLaw();
  scene.law.gn = 0.0;
  scene.dt = 4e-5;
  addDisk(scene, smallRadius, smallMass, {0.0, smallRadius - 1e-5}, Vec2::Zero());
  addDisk(scene, smallRadius, smallMass, {2.0 * smallRadius - 1e-5, smallRadius - 1e-5},
          Vec2::Zero());
  scene.bodies = {planeWall({0.0, 0.0}, {0.0, 1.0})};
  ContactLaw soft = scene.law, hard = scene.law, mixed = scene.law;
  hard.kn = 4.0 * soft.kn;
  mixed.kn = 2.0 * soft.kn;
  scene.materials = Materials{{"soft", "hard"}, {0, 1}, {1}, {soft, mixed, mixed, hard}};
  const auto engine = makeBox2dPenalty();
  const Snapshot start = runTo(*engine, scene, 0.0);
  ASSERT_EQ(start.contacts->size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    const bool bothHard = start.contacts->i[k] == 1;
    EXPECT_NEAR(start.contacts->normalForce[k], (bothHard ? 4.0 : 2.0) * soft.kn * 1e-5, 1e-9);
  }
}

}  // namespace
}  // namespace crossgrain::test
