#include "engines/box2d/restitution.hpp"

#include <gtest/gtest.h>

#include "adapters/box2d_common.hpp"
#include "tests/box2d/scenes.hpp"

namespace crossgrain::test {
namespace {

using box2d_granular::normalRestitution;
using box2d_granular::PairInertia;

double reduced(double a, double b) {
  return a * b / (a + b);
}

PairInertia disksOfReducedMass(double mass) {
  return {1.0 / mass, 3.0 / mass};
}

ContactLaw softLaw(Tension tension, TangentialLaw tangential = TangentialLaw::springDashpot) {
  ContactLaw law = box2dLaw(tangential);
  law.conventions.tension = tension;
  return law;
}

// The values of the thesis' disks, with tension and cut, are known to three digits.
TEST(Box2dRestitution, ClosedFormGivesTheThesisPairs) {
  const struct {
    double reducedMass, tension, cut;
  } pairs[] = {{reduced(smallMass, smallMass), 0.222, 0.341},
               {reduced(smallMass, largeMass), 0.274, 0.378},
               {reduced(largeMass, largeMass), 0.342, 0.428},
               {smallMass, 0.365, 0.446},
               {largeMass, 0.478, 0.533}};
  for (const auto& pair : pairs) {
    EXPECT_NEAR(normalRestitution(softLaw(Tension::allow), pair.reducedMass), pair.tension, 6e-4);
    EXPECT_NEAR(normalRestitution(softLaw(Tension::cut), pair.reducedMass), pair.cut, 6e-4);
  }
}

TEST(Box2dRestitution, ClosedFormAgreesWithTheIntegratedCollision) {
  for (const Tension tension : {Tension::allow, Tension::cut}) {
    for (const double gn : {0.0, 0.05, 0.19, 0.4, 0.6}) {
      ContactLaw law = softLaw(tension);
      law.gn = gn;
      const double mass = reduced(smallMass, smallMass);
      // 1e-4: the first-order scheme's error at the steps it takes. From γ_n = 2√(k_n m₁₂) = 0.44
      // on the contact is overdamped and, with tension, never parts.
      EXPECT_NEAR(box2d_granular::collide(law, disksOfReducedMass(mass), 0.0).en > 0.0
                      ? box2d_granular::collide(law, disksOfReducedMass(mass), 0.0).en
                      : 0.0,
                  normalRestitution(law, mass), 1e-4)
          << "gn " << gn;
    }
  }
}

// Known of two small disks: the spring turns Ψ = 0.5 into −0.47, spring and dashpot into −0.055,
// and Ψ = 1 into −0.21.
TEST(Box2dRestitution, TangentialReboundOfTheThesisLaws) {
  const PairInertia pair = disksOfReducedMass(reduced(smallMass, smallMass));
  EXPECT_NEAR(
      box2d_granular::collide(softLaw(Tension::allow, TangentialLaw::spring), pair, 0.5).psiF,
      -0.47, 5e-3);
  EXPECT_NEAR(box2d_granular::collide(softLaw(Tension::allow), pair, 0.5).psiF, -0.055, 1e-3);
  EXPECT_NEAR(box2d_granular::collide(softLaw(Tension::allow), pair, 1.0).psiF, -0.21, 5e-3);
  // Sliding throughout: Ψ_f = Ψ_i − 3(1 + 0.3408)µ.
  EXPECT_NEAR(box2d_granular::collide(softLaw(Tension::allow), pair, 6.0).psiF, 6.0 - 1.770, 5e-3);
}

TEST(Box2dRestitution, RigidEquivalentStaysWithinItsRange) {
  const PairInertia pair = disksOfReducedMass(reduced(smallMass, smallMass));
  EXPECT_NEAR(box2d_granular::rigidEquivalent(softLaw(Tension::allow), pair).tangential, 0.11,
              2e-3);
  // Dashpot or friction alone never reverse v_t.
  for (const TangentialLaw law :
       {TangentialLaw::none, TangentialLaw::coulomb, TangentialLaw::viscous})
    EXPECT_NEAR(box2d_granular::rigidEquivalent(softLaw(Tension::allow, law), pair).tangential, 0.0,
                1e-3);
}

}  // namespace
}  // namespace crossgrain::test
