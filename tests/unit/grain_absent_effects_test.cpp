#include <gtest/gtest.h>

#include "tests/unit/grain_packed.hpp"

// A scene without an effect shows nothing of it. That nothing is allocated for it either is what
// grain_allocation_test.cpp counts.

namespace {

using namespace grain;
namespace test = crossgrain::test;

Simulation run(grain::Setup setup) {
  Simulation simulation = test::advanced(std::move(setup), 300);
  EXPECT_GT(simulation.contacts().size(), 50u);
  return simulation;
}

void expectNoSpins(const Simulation& simulation) {
  EXPECT_FALSE(simulation.rotates());
  for (std::size_t i = 0; i < simulation.movingCount(); ++i) EXPECT_EQ(simulation.spin(i), 0.0);
}

class AbsentEffects : public testing::TestWithParam<Precision> {
 protected:
  grain::Setup scene() const {
    grain::Setup setup = test::packed(10, 2);
    setup.precision = GetParam();
    return setup;
  }
};

INSTANTIATE_TEST_SUITE_P(Precisions, AbsentEffects,
                         testing::Values(Precision::float64, Precision::float32));

TEST_P(AbsentEffects, FrictionlessContactsHaveNoTangentialForceAndNothingTurns) {
  auto none = scene(), slippery = scene();
  none.law.tangential = TangentialLaw::none;
  slippery.law.mu = 0.0;
  const auto a = run(std::move(none)), b = run(std::move(slippery));
  for (const Simulation* simulation : {&a, &b}) {
    expectNoSpins(*simulation);
    for (const Contact& contact : simulation->contacts()) {
      EXPECT_EQ(contact.tangentialForce, 0.0);
      EXPECT_EQ(contact.spring, 0.0);
      EXPECT_FALSE(contact.sliding);
      EXPECT_NE(contact.normalForce, 0.0);
    }
  }
  EXPECT_EQ(test::difference(a, b), "");
}

TEST_P(AbsentEffects, SpinsThatNothingCouldChangeChangeNothing) {
  auto spun = scene(), still = scene();
  for (auto* setup : {&spun, &still}) setup->law.tangential = TangentialLaw::none;
  still.disks.spin.assign(still.disks.size(), 0.0);
  const auto a = run(std::move(spun)), b = run(std::move(still));
  EXPECT_EQ(test::difference(a, b), "");
  EXPECT_EQ(a.kineticEnergy(), b.kineticEnergy());
}

TEST_P(AbsentEffects, BlockedRotationKeepsFrictionAndSpringsWithoutSpins) {
  auto setup = scene();
  setup.rotation = false;
  const auto simulation = run(std::move(setup));
  expectNoSpins(simulation);
  std::size_t stretched = 0;
  for (const Contact& contact : simulation.contacts())
    stretched += contact.tangentialForce != 0.0 && contact.spring != 0.0;
  EXPECT_GT(stretched, 50u);
}

TEST_P(AbsentEffects, LawsWithoutASpringHaveNone) {
  for (const TangentialLaw tangential : {TangentialLaw::coulomb, TangentialLaw::viscous}) {
    auto setup = scene();
    setup.law.tangential = tangential;
    const auto simulation = run(std::move(setup));
    std::size_t held = 0;
    for (const Contact& contact : simulation.contacts()) {
      EXPECT_EQ(contact.spring, 0.0);
      held += contact.tangentialForce != 0.0;
    }
    EXPECT_GT(held, 50u);
  }
}

TEST_P(AbsentEffects, APlateThatBrakesNoSpinLeavesASingleDiskTurning) {
  grain::Setup setup;
  setup.law = test::thesisLaw();
  setup.dt = 4e-5;
  setup.precision = GetParam();
  setup.bottom = test::thesisBottom<BottomPlate>(0.02, false);
  test::addDisk(setup.disks, 0.0, 0.0, 0.1, 0.0, 8.0);
  Simulation turning(setup);
  setup.bottom->spin = true;
  Simulation braked(setup);
  turning.advance(500);
  braked.advance(500);
  EXPECT_EQ(turning.spin(0), 8.0);
  EXPECT_LT(braked.spin(0), 7.0);
  EXPECT_EQ(turning.velocityX(0), braked.velocityX(0));
}

}  // namespace
