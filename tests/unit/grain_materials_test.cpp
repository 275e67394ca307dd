#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "tests/unit/grain_packed.hpp"

// Bodies of several materials: each pair by its own law, and the heat of each contact.

namespace {

using namespace grain;
namespace test = crossgrain::test;

/// Two materials, of which disks are in turn; walls are of the second.
Setup mixed(Setup setup,
            const std::function<void(ContactLaw& aa, ContactLaw& ab, ContactLaw& bb)>& change) {
  Materials& materials = setup.materials.emplace(Materials{.count = 2});
  for (std::size_t i = 0; i < setup.disks.size(); ++i)
    materials.ofDisk.push_back(static_cast<std::int32_t>(i % 2));
  materials.ofWall.assign(setup.walls.size(), 1);
  ContactLaw aa = setup.law, ab = setup.law, bb = setup.law;
  change(aa, ab, bb);
  materials.laws = {aa, ab, ab, bb};
  return setup;
}

void differ(ContactLaw& aa, ContactLaw& ab, ContactLaw& bb) {
  aa.kn *= 0.5;
  aa.mu = 0.9;
  ab.gn *= 2.0;
  ab.mu = 0.1;
  ab.kt *= 0.7;
  bb.gt *= 3.0;
  bb.mu = 0.0;
}

Setup withRollingAndCohesion(Setup setup, RollingLaw rolling, CohesionLaw cohesion) {
  setup.law.rolling = rolling;
  setup.law.kr = setup.law.kt;
  setup.law.gr = setup.law.gt;
  setup.law.muR = 0.2;
  setup.law.cohesion = cohesion;
  setup.law.kc = 0.05 * setup.law.kn / (M_PI * test::smallRadius);
  return setup;
}

class Mixed : public testing::TestWithParam<std::tuple<Precision, bool, Integrator>> {};

TEST_P(Mixed, PairsOfOneLaw_GiveTheBitsWithoutMaterials) {
  const auto [precision, more, integrator] = GetParam();
  for (const bool general : {false, true}) {
    grain::Setup setup = test::packed(9, 5);
    if (more) setup = withRollingAndCohesion(setup, RollingLaw::spring, CohesionLaw::area);
    setup.precision = precision;
    setup.law.conventions.integrator = integrator;
    setup.generalKernels = general;
    const auto one = test::advanced(setup, 200);
    const auto mixture =
        test::advanced(mixed(setup, [](ContactLaw&, ContactLaw&, ContactLaw&) {}), 200);
    EXPECT_EQ(test::difference(one, mixture), "") << general;
    EXPECT_GT(one.contacts().size(), 50u);
  }
}

TEST_P(Mixed, GivesTheBitsOfTheGeneralKernelOfOtherThreadsAndOfARestart) {
  const auto [precision, more, integrator] = GetParam();
  grain::Setup setup = test::packed(9, 5);
  if (more) setup = withRollingAndCohesion(setup, RollingLaw::spring, CohesionLaw::area);
  setup.precision = precision;
  setup.law.conventions.integrator = integrator;
  const grain::Setup mixture = mixed(setup, [](ContactLaw& aa, ContactLaw& ab, ContactLaw& bb) {
    differ(aa, ab, bb);
    aa.kr *= 2.0;
    ab.muR = 0.0;
    bb.kc *= 3.0;
  });
  const auto whole = test::withSameBits(mixture, 300);
  EXPECT_NE(test::difference(whole, test::advanced(setup, 300)), "");
}

INSTANTIATE_TEST_SUITE_P(
    Materials, Mixed,
    testing::Combine(testing::Values(Precision::float64, Precision::float32), testing::Bool(),
                     testing::Values(Integrator::positionVerlet, Integrator::semiImplicitEuler)));

/// Three pairs and a disk on a plane, far apart, none of which knows of the others.
struct Encounters {
  grain::Setup setup;
  /// Disks of each; the last meets the plane.
  static constexpr std::size_t disks[4][2] = {{0, 1}, {2, 3}, {4, 5}, {6, 6}};
  static constexpr std::int32_t materials[] = {0, 0, 0, 1, 1, 1, 0};

  explicit Encounters(ContactLaw law) {
    setup.law = law;
    setup.dt = 4e-5;
    for (int k = 0; k < 3; ++k) {
      const double y = 0.05 * (3 - k);  // the grid numbers them the other way round
      test::addDisk(setup.disks, 0.1, y, 0.3, 0.02, 20.0);
      test::addDisk(setup.disks, 0.1 + 2.0 * test::smallRadius, y + 1e-3, -0.3, 0.0, -5.0);
    }
    test::addDisk(setup.disks, test::smallRadius, 0.3, -0.3, 0.1, 10.0);
    setup.walls = {test::standing({{0.0, 0.0, 1.0, 0.0}})};
  }
};

TEST(Materials, EachPair_MovesAsUnderItsLawAlone) {
  for (const NormalLaw normal : {NormalLaw::linear, NormalLaw::hertz, NormalLaw::rigid}) {
    ContactLaw law = test::thesisLaw();
    law.normal = normal;
    if (normal == NormalLaw::hertz) law.kn = law.kt = 1e6;
    if (normal == NormalLaw::rigid) {
      law.tangential = TangentialLaw::coulomb;
      law.en = 0.9;
      law.et0 = 0.2;
    }
    Encounters scene(law);
    if (normal == NormalLaw::rigid)
      scene.setup.law.conventions.integrator = Integrator::semiImplicitEuler;
    if (normal == NormalLaw::rigid)
      scene.setup.law.conventions.dampingVelocity = DampingVelocity::lagged;
    ContactLaw laws[3] = {scene.setup.law, scene.setup.law, scene.setup.law};
    differ(laws[0], laws[1], laws[2]);
    laws[0].en = 0.5;
    laws[2].et0 = 0.0;
    grain::Setup mixture = scene.setup;
    Materials& materials = mixture.materials.emplace(Materials{.count = 2});
    materials.ofDisk.assign(std::begin(scene.materials), std::end(scene.materials));
    materials.ofWall = {1};
    materials.laws = {laws[0], laws[1], laws[1], laws[2]};
    const auto together = test::advanced(mixture, 300);
    const std::size_t lawOf[] = {0, 1, 2, 1};
    for (std::size_t pair = 0; pair < 4; ++pair) {
      grain::Setup alone = scene.setup;
      alone.law = laws[lawOf[pair]];
      if (alone.law.mu == 0.0 && normal != NormalLaw::rigid)
        alone.law.tangential = TangentialLaw::none;
      const auto reference = test::advanced(alone, 300);
      for (const std::size_t disk : scene.disks[pair]) {
        EXPECT_EQ(together.x(disk), reference.x(disk)) << pair;
        EXPECT_EQ(together.velocityX(disk), reference.velocityX(disk)) << pair;
        EXPECT_EQ(together.velocityY(disk), reference.velocityY(disk)) << pair;
        // Without friction there is no spin to see; what the disk had it keeps.
        EXPECT_EQ(together.spin(disk),
                  reference.rotates() ? reference.spin(disk) : scene.setup.disks.spin[disk]);
        EXPECT_NE(together.velocityX(disk), scene.setup.disks.vx[disk]) << "they have met";
      }
    }
  }
}

TEST(Materials, BondsOfDifferentAdhesion_LastAsFarAsTheirOwn) {
  // Two disks drawn apart slowly under JKR: each bond holds to a_p²/3R₁₂ of its own w.
  grain::Setup setup;
  setup.law.normal = NormalLaw::hertz;
  setup.law.kn = 1e5;
  setup.law.w = 0.01;
  setup.law.cohesion = CohesionLaw::jkr;
  setup.dt = 1e-6;
  test::addDisk(setup.disks, test::smallRadius, 0.0, 0.0, 0.0, 0.0);
  test::addDisk(setup.disks, test::smallRadius, 0.1, 0.0, 0.0, 0.0);
  Wall away = test::standing({{1e-7, 0.0, 1.0, 0.0}});
  away.moves = true;
  away.motion = [](double t) { return WallState{.x = -0.01 * t, .vx = -0.01}; };
  setup.walls = {away};
  grain::Setup mixture =
      mixed(setup, [](ContactLaw&, ContactLaw& ab, ContactLaw& bb) { bb.w = 8.0 * ab.w; });
  for (double& mass : mixture.disks.mass) mass = 1e3;  // they stay where they are
  const auto endOf = [&](double w) {
    const double R = test::smallRadius, a = std::cbrt(1.5 * M_PI * w * R * R / 1e5);
    return a * a / (3.0 * R);
  };
  Simulation simulation(mixture);
  double gap[2] = {0.0, 0.0};
  while (!simulation.contacts().empty() && simulation.steps() < 20000) {
    for (const Contact& c : simulation.contacts()) gap[c.i] = -c.overlap;
    simulation.step();
  }
  EXPECT_NEAR(gap[0], endOf(0.01), 2e-8);  // a step goes 1e-8 m
  EXPECT_NEAR(gap[1], endOf(0.08), 2e-8);
  EXPECT_NEAR(gap[1] / gap[0], 4.0, 0.01);  // w^(2/3)
}

TEST(Materials, LawsThatTheSetupCannotHave_AreRefused) {
  grain::Setup setup = test::packed(4, 1);
  const auto refused = [&](const std::function<void(grain::Setup&)>& change) {
    grain::Setup bad = mixed(setup, [](ContactLaw&, ContactLaw&, ContactLaw&) {});
    change(bad);
    EXPECT_THROW(Simulation{bad}, std::invalid_argument);
  };
  refused([](grain::Setup& s) { s.materials->ofDisk.front() = 2; });
  refused([](grain::Setup& s) { s.materials->ofWall.pop_back(); });
  refused([](grain::Setup& s) { s.materials->laws.pop_back(); });
  refused([](grain::Setup& s) { s.law.gn = 0.0; });
  refused([](grain::Setup& s) { s.law.mu = 0.0; });
}

TEST(Materials, Ledger_ClosesAtTheSchemesOrder) {
  const auto worst = [](double dt) {
    grain::Setup setup =
        withRollingAndCohesion(test::packed(6, 3), RollingLaw::spring, CohesionLaw::area);
    setup.law.conventions.springUpdate = SpringUpdate::midpoint;
    setup.dt = dt;
    setup.ledger = true;
    Simulation simulation(mixed(setup, differ));
    double most = 0.0;
    while (simulation.time() < 0.01) {
      simulation.step();
      most = std::max(most, std::abs(test::residual(*simulation.energyLedger())));
      EXPECT_NEAR(simulation.energyLedger()->elasticNormal +
                      simulation.energyLedger()->elasticTangential +
                      simulation.energyLedger()->elasticRolling,
                  simulation.elasticEnergy(), 0.05 * simulation.elasticEnergy());
    }
    return most;
  };
  const double order = std::log2(worst(4e-5) / worst(5e-6)) / 3.0;
  EXPECT_GT(order, 1.8);
  EXPECT_LT(order, 2.5);
}

// Heat of each contact.

double lost(const EnergyLedger& l) {
  return l.lostNormalDamping + l.lostTangentialDamping + l.lostSliding + l.lostRollingDamping +
         l.lostRolling + l.lostPlastic;
}

class HeatOfContacts
    : public testing::TestWithParam<std::tuple<RollingLaw, CohesionLaw, Integrator>> {};

// The power of a contact is what the ledger took from it in the step, so over all of them it is the
// ledger's rate, but for what contacts lost that have just ended.
TEST_P(HeatOfContacts, OfAllContacts_IsTheLedgersRate) {
  const auto [rolling, cohesion, integrator] = GetParam();
  grain::Setup setup = withRollingAndCohesion(test::packed(6, 3), rolling, cohesion);
  setup.law.kUnload = 2.0 * setup.law.kn;
  if (cohesion == CohesionLaw::elastoPlastic) setup.law.kc = 0.1 * setup.law.kn;
  setup.law.conventions.integrator = integrator;
  if (integrator == Integrator::semiImplicitEuler)
    setup.law.conventions.dampingVelocity = DampingVelocity::lagged;
  setup.ledger = true;
  Simulation simulation(mixed(setup, differ));
  ASSERT_EQ(simulation.contactLosses().size(), simulation.contacts().size());
  std::size_t compared = 0;
  for (int step = 0; step < 150; ++step) {
    const EnergyLedger before = *simulation.energyLedger();
    const std::vector<Contact> contacts = simulation.contacts();
    simulation.step();
    const double rate = (lost(*simulation.energyLedger()) - lost(before)) / setup.dt;
    const auto losses = simulation.contactLosses();
    ASSERT_EQ(losses.size(), simulation.contacts().size());
    const bool ended = std::ranges::any_of(contacts, [&](const Contact& c) {
      return std::ranges::none_of(simulation.contacts(),
                                  [&](const Contact& now) { return c.i == now.i && c.j == now.j; });
    });
    if (ended) continue;
    ++compared;
    double size = lost(before) * 1e-5 / setup.dt;  // of which sums keep 1e-16
    for (const double power : losses) size += std::abs(power);
    EXPECT_NEAR(std::accumulate(losses.begin(), losses.end(), 0.0), rate, 1e-10 * size) << step;
  }
  EXPECT_GT(compared, 20u);
  // In one go, as a run to a snapshot does it, and after a restart.
  Simulation whole(mixed(setup, differ)), restored(mixed(setup, differ));
  whole.advance(149);
  std::stringstream kept;
  whole.save(kept);
  restored.restore(kept);
  for (Simulation* other : {&whole, &restored}) {
    other->advance(1);
    EXPECT_EQ(other->contactLosses(), simulation.contactLosses());
  }
}

INSTANTIATE_TEST_SUITE_P(
    Laws, HeatOfContacts,
    testing::Values(std::tuple(RollingLaw::none, CohesionLaw::none, Integrator::positionVerlet),
                    std::tuple(RollingLaw::spring, CohesionLaw::area, Integrator::velocityVerlet),
                    std::tuple(RollingLaw::viscous, CohesionLaw::elastoPlastic,
                               Integrator::semiImplicitEuler)));

TEST(HeatOfAContact, OfOneDashpotAtTheBeginning_IsItsForceTimesTheVelocity) {
  // Two disks that touch from t = 0, undamped along the tangent: γ_n v_n².
  grain::Setup setup;
  setup.law = test::thesisLaw();
  setup.law.tangential = TangentialLaw::none;
  setup.dt = 1e-6;
  setup.ledger = true;
  test::addDisk(setup.disks, 0.0, 0.0, 0.1, 0.0, 0.0);
  test::addDisk(setup.disks, 1.999 * test::smallRadius, 0.0, -0.1, 0.0, 0.0);
  Simulation simulation(setup);
  const auto expect = [&](double relative) {
    const double v = simulation.velocityX(1) - simulation.velocityX(0);
    ASSERT_EQ(simulation.contactLosses().size(), 1u);
    EXPECT_NEAR(simulation.contactLosses().front(), setup.law.gn * v * v,
                relative * setup.law.gn * v * v);
  };
  expect(5e-4);  // with the velocity half way through the first half kick
  simulation.advance(50);
  expect(2e-3);  // a mean over the last step, in which v changes by 1e-3 of itself
}

}  // namespace
