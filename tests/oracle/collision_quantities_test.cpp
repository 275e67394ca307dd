// What a collision leaves beside its restitutions, and where its energy goes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "oracle/collision_oracle.hpp"
#include "tests/support/pairs.hpp"

namespace {

using namespace crossgrain;
using namespace test;

TEST(CollisionQuantities, NormalDampingTakesOneMinusESquared) {
  // Head on without spin: ½ m₁₂ v² (1 − e²) goes to the dashpot and nothing elsewhere. Distances
  // round at 1e-16 of the reach, overlaps of 1e-4 of it therefore at 1e-12.
  const CollisionEnd end = oracleOutcome(thesisLaw(), smallPair(), {0.0, 1e-3});
  const double before = 0.5 * smallPair().reducedMass() * 1e-6;
  EXPECT_NEAR(end.energyBefore, before, 1e-15 * before);
  EXPECT_NEAR(end.lost->normalDamping, before * (1.0 - end.en * end.en), 1e-10 * before);
  EXPECT_EQ(end.lost->sliding, 0.0);
  EXPECT_EQ(end.lost->stored, 0.0);
  EXPECT_FALSE(end.beta);
  EXPECT_FALSE(end.et);
}

TEST(CollisionQuantities, ASpringThatNeverSlipsKeepsItsEnergyAtTheEnd) {
  // Without damping and slip ξ = Ψ_i v sin(Ωt)/Ω, Ω² = K k_t/m₁₂, until t_c = π/ω: k_t ξ²/2 is
  // left.
  ContactLaw law = thesisLaw();
  law.tangential = TangentialLaw::spring;
  law.gn = 0.0;
  law.mu = 1e9;
  const double v = 1e-7;
  const double ratio = std::sqrt(3.0 * law.kt / law.kn);
  const double omega = ratio * std::sqrt(law.kn / smallPair().reducedMass());
  const double spring = v * std::sin(std::numbers::pi * ratio) / omega;
  const CollisionEnd end = oracleOutcome(law, smallPair(), {1.0, v});
  EXPECT_NEAR(end.lost->stored, 0.5 * law.kt * spring * spring, 1e-5 * end.energyBefore);
  EXPECT_NEAR(end.lost->sliding, 0.0, 1e-5 * end.energyBefore);
}

TEST(CollisionQuantities, ContactTimeAndOverlapAreTheUndampedOscillators) {
  ContactLaw law = thesisLaw();
  law.tangential = TangentialLaw::none;
  law.gn = 0.0;
  const double omega = std::sqrt(law.kn / smallPair().reducedMass());
  const CollisionEnd end = oracleOutcome(law, smallPair(), {0.0, 0.01});
  EXPECT_NEAR(*end.duration, std::numbers::pi / omega, 1e-12 * std::numbers::pi / omega);
  EXPECT_NEAR(*end.maxOverlap, 0.01 / omega, 1e-12 * 0.01 / omega);
}

TEST(CollisionQuantities, CentresAndContactPointAreDifferentQuantities) {
  // Sliding throughout with the normal frozen: friction takes c = (1+e)µ v_n off the centres and
  // K c off the contact point, K = 3, and gives both disks a spin of c v_n/a (J = ½ m a²).
  ContactLaw law = thesisLaw();
  law.tangential = TangentialLaw::coulomb;
  const double v = 1e-6, c = *slidingConstant(law, smallPair()) / 3.0;
  const CollisionEnd oblique = oracleOutcome(law, smallPair(), {4.0, v, Approach::oblique});
  EXPECT_NEAR(oblique.psi, 4.0 - 3.0 * c, 1e-5);
  EXPECT_NEAR(*oblique.beta, -oblique.psi / 4.0, 1e-15);
  EXPECT_NEAR(*oblique.et, (4.0 - c) / 4.0, 1e-5);
  EXPECT_NEAR(std::tan(oblique.reboundAngle), (4.0 - c) / oblique.en, 1e-4);
  EXPECT_NEAR(oblique.spin[0] * smallRadius, c * v, 1e-5 * v);
  EXPECT_NEAR(oblique.spin[1] * smallRadius, c * v, 1e-5 * v);

  const CollisionEnd spun = oracleOutcome(law, smallPair(), {4.0, v});
  EXPECT_NEAR(spun.psi, oblique.psi, 1e-5);
  EXPECT_NEAR(spun.centrePsi, -c, 1e-5);
  EXPECT_FALSE(spun.et) << "the centres met head on";
  EXPECT_NEAR(spun.spin[0] * smallRadius, (-2.0 + c) * v, 1e-5 * v);
}

}  // namespace
