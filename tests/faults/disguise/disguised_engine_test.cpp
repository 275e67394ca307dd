// The engine in disguise does what the in-house engine does, and not to the bit: else no false
// alarm could come of it.
#include "tests/faults/disguise/disguised_engine.hpp"

#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <utility>

#include "adapters/grain.hpp"
#include "cases/flow.hpp"
#include "cases/loader.hpp"
#include "cases/time_step.hpp"
#include "results/lockstep_text.hpp"
#include "studies/conformance/conformance_scenes.hpp"
#include "studies/lockstep/lockstep.hpp"
#include "studies/lockstep/terms.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace crossgrain;

Snapshot endOf(Engine& engine, const Scene& scene) {
  engine.load(scene, {});
  for (const double part : {0.3, 0.6, 1.0}) engine.advance(part * conformance::busyEnd);
  return engine.snapshot(ContactReport::instant);
}

/// By the numbers of the two: f_n, f_t, n and the torque against rolling, as numbers.
std::map<std::pair<int, int>, std::array<double, 5>> forcesOf(const Snapshot& now) {
  std::map<std::pair<int, int>, std::array<double, 5>> forces;
  const Contacts& all = *now.contacts;
  for (std::size_t c = 0; c < all.size(); ++c)
    forces[{all.i[c], all.j[c]}] = {all.normalForce[c], all.tangentialForce[c], all.normal[c].x(),
                                    all.normal[c].y(), all.rollingTorque[c]};
  return forces;
}

TEST(DisguisedEngine, DoesTheSameButForRounding) {
  const TemporaryFolder folder;
  ContactLaw law = conformance::fullLaw();
  law.rolling = RollingLaw::spring;
  law.kr = 0.1 * law.kt;
  law.gr = 0.1 * law.gt;
  law.muR = 0.1;
  const Scene scene = conformance::busyScene(law);
  const auto grain = makeGrain();
  const Snapshot original = endOf(*grain, scene);
  test::Disguise all;
  all.transform.placement = {.mirror = true, .turn = 0.3 * std::numbers::pi};
  all.transform.units = {7.0, 0.3, 3.0};
  all.order = 5;
  all.nudge = 6;
  all.restartEvery = 2;
  test::DisguisedEngine disguised(all, folder.path());
  const Snapshot seen = endOf(disguised, scene);
  EXPECT_NE(seen.position, original.position);
  ASSERT_EQ(seen.position.size(), original.position.size());
  for (std::size_t i = 0; i < seen.position.size(); ++i) {
    EXPECT_LT((seen.position[i] - original.position[i]).norm(), 1e-10 * scene.disks.radius[i]);
    EXPECT_LT((seen.velocity[i] - original.velocity[i]).norm(), 1e-9);
    EXPECT_NEAR((*seen.spin)[i], (*original.spin)[i], 1e-7);
  }
  for (std::size_t b = 0; b < seen.bodies.size(); ++b) {
    EXPECT_NEAR(seen.bodies[b].angle, original.bodies[b].angle, 1e-12);
    EXPECT_LT((*seen.bodies[b].force - *original.bodies[b].force).norm(), 1e-8);
    EXPECT_NEAR(*seen.bodies[b].torque, *original.bodies[b].torque, 1e-9);
  }
  const auto theirs = forcesOf(seen), ours = forcesOf(original);
  ASSERT_EQ(theirs.size(), ours.size());
  EXPECT_GT(ours.size(), 3u);
  for (const auto& [pair, force] : ours)
    for (std::size_t k = 0; k < force.size(); ++k)
      EXPECT_NEAR(theirs.at(pair)[k], force[k], k == 4 ? 1e-10 : 1e-7)
          << pair.first << " " << pair.second;
  EXPECT_EQ(disguised.stats().steps, grain->stats().steps);
}

/// Turned, it has its disks in another order, and of those that touch several at once others come
/// first. Two of three that touch at the start are apart a step later.
TEST(DisguisedEngine, OrderOfCollisions_IsNoOtherLaw) {
  const Case setup =
      loadCase(CROSSGRAIN_TESTS "/coverage/rigid-gas.toml", {"preparation.seed=4"}).front();
  const double dt = timeStep(setup);
  const auto none = std::unique_ptr<Engine>();
  const auto nobody = [](double) {};
  std::vector<Packing> packings;
  for (int p = 0; p < setup.preparation.packings; ++p)
    packings.push_back(flowPacking(setup, p, dt, *none, nobody));
  const auto states = statesAlongTheFlow(setup, packings, dt, 16, nobody);
  test::Disguise turned;
  turned.transform.placement.turn = 2.88;
  const TemporaryFolder folder;
  test::DisguisedEngine engine(turned, folder.path());
  const LockstepRow row =
      holdAgainstMirror(engine, {"grain", "", makeGrain, {}, {}, ""}, setup, states, dt, nobody);
  EXPECT_EQ(row.verdict, Equivalence::differs);
  EXPECT_NE(openInLaw(row, lockstepRules(setup.law)), "");
}

}  // namespace
