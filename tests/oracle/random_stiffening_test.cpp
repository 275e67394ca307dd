// Guards over random collisions whose stiffness follows the overlap, of pairs and on walls. The
// seed is fixed.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "oracle/collision_end.hpp"
#include "oracle/collision_oracle.hpp"
#include "oracle/impact.hpp"
#include "random_pair.hpp"

namespace {

using namespace crossgrain;
using test::Draw;

/// Hertz' law and polynomials, every damper, every tangential law, both histories; a second disk of
/// up to 10 times the radius and 1000 times the mass, or a wall. Conventions are those that never
/// gain energy where the stiffness is constant.
Case randomStiffeningCase(Draw& draw) {
  Case setup;
  setup.source = Collision();
  Collision& c = collisionIn(setup);
  c.wall = draw.oneOf({false, true});
  drawPair(draw, c);
  c.approach = draw.oneOf({Approach::spin, Approach::firstSpin, Approach::oblique});
  ContactLaw& law = setup.law;
  law.normal = draw.oneOf({NormalLaw::hertz, NormalLaw::polynomial});
  law.kn = draw.logarithmic(1e8, 1e11);
  // Of the order of the normal stiffness; a polynomial's is that of some 1e-5 m.
  law.kt = law.kn * draw.uniform(0.5, 1.5) * (law.normal == NormalLaw::hertz ? 1.0 : 1e-5);
  law.mu = draw.uniform(0.0, 1.0);
  law.tangential = draw.oneOf({TangentialLaw::none, TangentialLaw::coulomb, TangentialLaw::viscous,
                               TangentialLaw::spring, TangentialLaw::springDashpot});
  law.damper = Damper::critical;
  law.gn = draw.uniform(0.0, 1.0);
  law.gt = law.gn * draw.uniform(0.1, 1.5) + 1e-9;
  law.conventions.tension = draw.oneOf({Tension::allow, Tension::cut});
  law.conventions.history = draw.oneOf({History::displacement, History::force});
  law.conventions.springUpdate = SpringUpdate::midpoint;
  if (law.normal == NormalLaw::polynomial || law.conventions.history == History::force)
    law.conventions.springReset = SpringReset::springOnly;  // else there is no oracle
  law.conventions.integrator = Integrator::velocityVerlet;
  return setup;
}

CollisionStart randomStart(Draw& draw, const Case& setup) {
  const CollidingPair pair = collidingPair(setup);
  // The speed whose deepest overlap is this, from the work of f_el.
  const double depth = pair.radius[0] * draw.logarithmic(1e-4, 1e-2);
  double low = 1e-9, high = 1e6;
  for (int k = 0; k < 100; ++k) {
    const double middle = std::sqrt(low * high);
    (deepestOverlap(setup.law, {pair.reducedMass(), pair.reducedRadius(), middle}) < depth ? low
                                                                                           : high) =
        middle;
  }
  return {draw.uniform(0.0, 4.0), low, collisionIn(setup).approach};
}

TEST(RandomStiffening, OfTheOracleCloseTheAccountAndAreOdd) {
  Draw draw(11);
  double gain[2] = {-1.0, -1.0};
  for (int k = 0; k < 300; ++k) {
    Case setup = randomStiffeningCase(draw);
    if (draw.oneOf({false, true})) {
      setup.law.damper = Damper::viscoelastic;
      setup.law.gn = setup.law.gt = 1e-8;
    }
    const CollidingPair pair = collidingPair(setup);
    const CollisionStart start = randomStart(draw, setup);
    const CollisionEnd end = oracleOutcome(setup.law, pair, start);
    ASSERT_NEAR(test::accountOf(end), end.energyBefore, 1e-8 * end.energyBefore)
        << "collision " << k;
    double& most = gain[static_cast<int>(setup.law.conventions.history)];
    most = std::max(most, end.energyAfter / end.energyBefore - 1.0);
    // A reset to the bound stores what the dashpot carried, more than a weak damper takes.
    if (setup.law.damper == Damper::critical) {
      ASSERT_LE(end.energyAfter, end.energyBefore * (1.0 + 1e-12)) << "collision " << k;
    }
    const CollisionEnd odd = oracleOutcome(setup.law, pair, {-start.psi, start.vn, start.approach});
    if (end.noLimit) continue;
    ASSERT_NEAR(odd.psi, -end.psi, 1e-7) << "collision " << k;
    ASSERT_NEAR(odd.en, end.en, 1e-7) << "collision " << k;
  }
  RecordProperty("largest_gain_displacement", std::to_string(gain[0]));
  RecordProperty("largest_gain_force", std::to_string(gain[1]));
}

/// The engine's outcome is the oracle's, and better the shorter the step, for every law drawn.
TEST(RandomStiffening, OfTheEngineMeetTheOracle) {
  Draw draw(12);
  for (int k = 0; k < 50; ++k) {
    Case setup = randomStiffeningCase(draw);
    const CollisionStart start = randomStart(draw, setup);
    const CollidingPair pair = collidingPair(setup);
    const CollisionEnd expected = oracleOutcome(setup.law, pair, start);
    const double contact =
        impactTime(setup.law, {pair.reducedMass(), pair.reducedRadius(), start.vn});
    const auto found = test::endByEngine(setup, start, contact / 4000.0, 8.0 * contact);
    ASSERT_TRUE(found) << "collision " << k << " did not part";
    // First order in dt/t_c where dashpots act or a slip begins within a step.
    ASSERT_NEAR(found->en, expected.en, 5e-3) << "collision " << k;
    if (!expected.noLimit) {
      ASSERT_NEAR(found->psi, expected.psi, 1e-2 * (1.0 + start.psi)) << "collision " << k;
    }
    ASSERT_LE(found->energyAfter, found->energyBefore * (1.0 + 1e-6)) << "collision " << k;
  }
}

/// Also where friction goes on under tension, to the last.
TEST(RandomStiffening, Oracle_EveryConvention_IsWhatSmallStepsGive) {
  Draw draw(13);
  test::AgainstSmallSteps small;
  for (int k = 0; k < 200; ++k) {
    SCOPED_TRACE(k);
    Case setup = randomStiffeningCase(draw);
    ContactLaw& law = setup.law;
    law.mu = draw.uniform(0.05, 1.0);
    law.tangential = draw.oneOf({TangentialLaw::spring, TangentialLaw::springDashpot});
    drawConventions(draw, law.conventions);
    if (law.normal == NormalLaw::hertz && law.conventions.history == History::displacement)
      law.conventions.springReset = SpringReset::total;  // else there is no oracle
    const CollidingPair pair = collidingPair(setup);
    const CollisionStart start = randomStart(draw, setup);
    small.expect(law, pair, start,
                 impactTime(law, {pair.reducedMass(), pair.reducedRadius(), start.vn}));
  }
  EXPECT_EQ(small.compared, 200);
  EXPECT_LT(small.noLimit, 20);
  EXPECT_LT(small.unsettled, 30);
}

}  // namespace
