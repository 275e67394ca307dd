// The elastic part of an impact of 9 J, for each law with constants whose result is a round number.
#include "oracle/impact.hpp"

#include <gtest/gtest.h>

namespace {

using namespace crossgrain;

constexpr Impact impact{2.0, 1.0, 3.0};  // ½ · 2 kg · (3 m/s)², R₁₂ = 1 m

ContactLaw lawOf(NormalLaw normal, double kn) {
  return ContactLaw{.normal = normal, .kn = kn, .kn3 = 0.0};
}

TEST(Impact, IsDeepestWhereTheSpringHoldsAllOfIt) {
  const ContactLaw linear = lawOf(NormalLaw::linear, 50.0);  // v √(m/k) = 3 · √(2/50) m
  EXPECT_NEAR(deepestOverlap(linear, impact), 0.6, 1e-14);
  EXPECT_NEAR(elasticEnergy(linear, 1.0, 0.6), 9.0, 1e-12);
  const ContactLaw hertz = lawOf(NormalLaw::hertz, 22.5);  // 2/5 · 22.5 · 1 J
  EXPECT_NEAR(deepestOverlap(hertz, impact), 1.0, 1e-14);
  EXPECT_NEAR(elasticEnergy(hertz, 1.0, 1.0), 9.0, 1e-12);
  const ContactLaw polynomial = lawOf(NormalLaw::polynomial, 27.0);  // 27/3 · 1³ J
  EXPECT_NEAR(deepestOverlap(polynomial, impact), 1.0, 1e-12);
  EXPECT_NEAR(elasticEnergy(polynomial, 1.0, 1.0), 9.0, 1e-12);
}

}  // namespace
