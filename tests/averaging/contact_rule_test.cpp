#include "averaging/contact_rule.hpp"

#include <gtest/gtest.h>

#include "averaging/distributions.hpp"
#include "averaging/global.hpp"
#include "tests/averaging/scenes.hpp"

namespace crossgrain {
namespace {

using test::Instant;
using test::randomInstant;

Contacts onePair(double normalForce, double tangentialForce) {
  return Contacts{.normalForce = {normalForce}, .tangentialForce = {tangentialForce}};
}

TEST(ContactRule, AForceOfEitherKindMakesAContact) {
  EXPECT_TRUE(transmits(onePair(1e-12, 0.0), 0));
  EXPECT_TRUE(transmits(onePair(-1e-12, 0.0), 0)) << "held together by its dashpot";
  EXPECT_TRUE(transmits(onePair(0.0, 1e-12), 0)) << "a dashpot outside the Coulomb bound";
  EXPECT_FALSE(transmits(onePair(0.0, 0.0), 0));
}

/// As rigid engines and cut tension leave them: touching, overlapping or apart, without a force.
Instant withSilentPairs(Instant instant) {
  const std::size_t before = instant.snapshot.contacts->size();
  for (std::int32_t i = 0; i < 20; ++i) instant.addContact(i, i + 7, Vec2(0.6, 0.8), 0.0, 0.0);
  Contacts& pairs = *instant.snapshot.contacts;
  pairs.overlap.resize(pairs.size(), 0.0);
  for (std::size_t k = before; k < pairs.size(); ++k)
    pairs.overlap[k] = (static_cast<double>(k % 3) - 1.0) * 1e-9;
  return instant;
}

/// Every moment, hence every field, every distribution and every number of the scene.
TEST(ContactRule, PairsWithoutForceEnterNothing) {
  const Instant instant = randomInstant(3, 400);
  const Instant more = withSilentPairs(instant);
  ASSERT_EQ(more.snapshot.contacts->size(), instant.snapshot.contacts->size() + 20);
  const Rings rings = test::thesisRings();
  for (const WeightMethod method : {WeightMethod::slicing, WeightMethod::lineHeaviside}) {
    const Weight weight(method, 2e-3);
    EXPECT_EQ(test::momentsOf(rings, instant, weight), test::momentsOf(rings, more, weight));
  }

  DistributionAccumulator few(rings, instant.scene, {1.0, 1.0});
  DistributionAccumulator many(rings, more.scene, {1.0, 1.0});
  few.add(instant.snapshot);
  many.add(more.snapshot);
  const auto a = few.distributions(), b = many.distributions();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(a[k].density, b[k].density);

  const GlobalNumbers of = globalNumbers(instant.scene, instant.snapshot);
  const GlobalNumbers ofMore = globalNumbers(more.scene, more.snapshot);
  EXPECT_EQ(of.coordination, ofMore.coordination);
  EXPECT_EQ(of.meanOverlap, ofMore.meanOverlap);
  EXPECT_EQ(of.listedPairs, of.coordination);
  EXPECT_NEAR(*ofMore.listedPairs, *of.listedPairs + 40.0 / 400.0, 1e-12);
}

}  // namespace
}  // namespace crossgrain
