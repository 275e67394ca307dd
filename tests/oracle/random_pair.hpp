#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "adapters/grain.hpp"
#include "cases/case.hpp"
#include "cases/collision_scene.hpp"
#include "plain_integration.hpp"
#include "tests/support/draw.hpp"

namespace crossgrain::test {

/// Radii up to 1 : 10, masses up to 1 : 1000, factors q of the inertia from 0.4 to 0.5.
inline void drawPair(Draw& draw, Collision& to) {
  to.radius[0] = 1e-3 * draw.logarithmic(1.0, 10.0);
  to.radius[1] = 1e-3 * draw.logarithmic(1.0, 10.0);
  to.mass[0] = 1e-4;
  to.mass[1] = 1e-4 * draw.logarithmic(1.0, 1000.0);
  to.inertiaFactor = draw.uniform(0.4, 0.5);
}

/// Every convention with which a law has a limit of small steps.
inline void drawConventions(Draw& draw, LawConventions& how) {
  how.tension = draw.oneOf({Tension::allow, Tension::cut});
  how.coulombBound = draw.oneOf({CoulombBound::compression, CoulombBound::magnitude});
  how.springUpdate =
      draw.oneOf({SpringUpdate::after, SpringUpdate::before, SpringUpdate::midpoint});
  how.springReset = draw.oneOf({SpringReset::total, SpringReset::springOnly});
  how.leverArm = draw.oneOf({LeverArm::radius, LeverArm::contactPoint});
  how.history = draw.oneOf({History::displacement, History::force});
}

/// Sum of the energy left and of all that was lost [J].
inline double accountOf(const CollisionEnd& end) {
  const EnergySplit& lost = *end.lost;
  double sum = end.energyAfter + lost.normalDamping + lost.tangentialDamping + lost.stiffening +
               lost.sliding + lost.stored;
  for (const auto& part : {lost.rollingDamping, lost.rolling, lost.plastic, lost.detachment})
    sum += part.value_or(0.0);
  return sum;
}

/// Outcome of a start on the in-house engine at that time, if the two have parted by then.
inline std::optional<CollisionEnd> endByEngine(const Case& setup, const CollisionStart& start,
                                               double dt, double time) {
  const Scene scene = collisionScene(setup, {start}, dt);
  const auto engine = makeGrain();
  engine->load(scene, {});
  engine->advance(time);
  return collisionEnd(scene, engine->snapshot(ContactReport::none), 0, start);
}

/// Random collisions against plain integrations, and how they came out.
struct AgainstSmallSteps {
  int compared = 0, noLimit = 0, unsettled = 0;

  /// The oracle lies among what small steps give, but for their own spread and first-order error;
  /// and where it says that there is no limit they are apart.
  void expect(const ContactLaw& law, const CollidingPair& pair, const CollisionStart& start,
              double contactTime) {
    double low = INFINITY, high = -INFINITY;
    for (const double steps : {4000.0, 12000.0})
      for (const double phase : {0.2, 0.7}) {
        const double psi = PlainIntegration::run(law, pair, start, contactTime, steps, phase).psi;
        ASSERT_TRUE(std::isfinite(psi)) << "does not part";
        low = std::min(low, psi);
        high = std::max(high, psi);
      }
    const CollisionEnd end = oracleOutcome(law, pair, start);
    ++compared;
    noLimit += end.noLimit;
    constexpr double firstOrder = 2e-3, apart = 1e-5;
    unsettled += high - low > firstOrder;
    if (end.noLimit) {
      EXPECT_GT(high - low, apart) << "small steps agree on " << low;
    } else {
      const double slack = firstOrder + (high - low);
      EXPECT_GT(end.psi, low - slack);
      EXPECT_LT(end.psi, high + slack);
    }
  }
};

}  // namespace crossgrain::test
