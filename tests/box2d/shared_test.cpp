// Behaviour that both Box2D engines share, beyond the conformance suite, which checks every engine
// for fresh starts, for walls that move and push, and for the laws of motion.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "tests/box2d/scenes.hpp"
#include "tests/support/refusal.hpp"

namespace crossgrain::test {
namespace {

struct Kind {
  const char* name;
  std::unique_ptr<Engine> (*make)();
  double dt;
};

class BothBox2dEngines : public testing::TestWithParam<Kind> {
 protected:
  std::unique_ptr<Engine> engine() const { return GetParam().make(); }

  Scene empty() const { return Scene{.law = box2dLaw(), .dt = GetParam().dt}; }
};

TEST_P(BothBox2dEngines, RestsOnAPlane_AndWeighsOnIt) {
  Scene scene = empty();
  scene.gravity = Vec2(0, -9.81);
  const double weight = smallMass * 9.81;
  const bool soft = GetParam().make == makeBox2dPenalty;
  const double height = smallRadius - (soft ? weight / scene.law.kn : 0.0);
  addDisk(scene, smallRadius, smallMass, Vec2(0.01, height), Vec2::Zero());
  scene.bodies = {planeWall(Vec2::Zero(), Vec2::UnitY())};
  const auto e = engine();
  const ContactReport report =
      e->capabilities().accumulatedContacts ? ContactReport::accumulated : ContactReport::instant;
  e->load(scene, {});
  e->advance(1.0);
  e->snapshot(report);
  e->advance(1.5);
  const Snapshot at = e->snapshot(report);
  // The soft disk starts in equilibrium. Box2D's solver may let the rigid one sink by its slop,
  // 4.9e-6 m at this unit of length, and hop from the speed e_n g dt, 1.6e-7 m high.
  const double still = soft ? 1e-12 : 5e-6;
  EXPECT_NEAR(at.position[0].y(), height, still);
  EXPECT_NEAR(at.position[0].x(), 0.01, still);
  // 1 %: an impulse engine hops, and half a second holds a whole number of hops only nearly.
  EXPECT_NEAR(at.bodies[0].force->y(), -weight, 0.01 * weight);
  EXPECT_NEAR(*at.bodies[0].torque, -0.01 * weight, 0.0001 * weight);
  ASSERT_EQ(at.contacts->size(), 1u);
  EXPECT_NEAR(at.contacts->normalForce[0], weight, 0.01 * weight);
  EXPECT_EQ(at.contacts->j[0], 1);  // no wall disks: the first plane follows the disks
}

/// Disks go each way on a floor without friction, far beyond the scene that they start in; and a
/// belt runs away under one that stays.
TEST_P(BothBox2dEngines, PlanesHaveNoEnd) {
  for (const double beltSpeed : {0.0, 3.0}) {
    Scene scene = empty();
    scene.law.mu = 0.0;
    scene.law.tangential = TangentialLaw::none;
    scene.law.kt = scene.law.gt = 0.0;
    scene.gravity = Vec2(0, -9.81);
    for (const double side : {1.0, -1.0})
      addDisk(scene, smallRadius, smallMass, Vec2(0.01 * side, smallRadius),
              Vec2(beltSpeed > 0.0 ? 0.0 : 2.0 * side, 0.0));
    scene.bodies = {planeWall(Vec2::Zero(), Vec2::UnitY())};
    if (beltSpeed > 0.0) {
      scene.bodies[0].motion.kind = Motion::Kind::translating;
      scene.bodies[0].motion.velocity = Vec2(beltSpeed, 0.0);
    }
    const auto e = engine();
    const Snapshot after = runTo(*e, scene, 1.0);
    for (const std::size_t k : {0u, 1u}) {
      EXPECT_NEAR(after.position[k].y(), smallRadius, 0.01 * smallRadius) << beltSpeed;
      const Vec2 way = after.position[k] - scene.disks.position[k];
      EXPECT_NEAR(way.x(), scene.disks.velocity[k].x(), 1e-3) << beltSpeed;
    }
    EXPECT_EQ(after.contacts->size(), 2u);
  }
}

/// In place of an assertion inside Box2D, or a mass that is taken for 1 where it is rounded to 0.
TEST_P(BothBox2dEngines, RefusesWhatBox2dsFloatsCannotHold) {
  const auto e = engine();
  const std::pair<const char*, std::function<void(Scene&)>> faults[] = {
      {"", [](Scene&) {}},
      {"mass of disk 1", [](Scene& scene) { scene.disks.mass[1] = 1e308; }},
      {"mass of disk 1", [](Scene& scene) { scene.disks.mass[1] = 1e-60; }},
      {"inertia of disk 0", [](Scene& scene) { scene.disks.inertia[0] = 1e300; }},
      {"radius of disk 1", [](Scene& scene) { scene.disks.radius[1] = 1e30; }},
      {"v_x of disk 0", [](Scene& scene) { scene.disks.velocity[0].x() = 1e100; }},
      {"y of disk 1", [](Scene& scene) { scene.disks.position[1].y() = -1e50; }},
      {"spin of disk 0", [](Scene& scene) { scene.disks.spin[0] = 1e40; }},
      {"gravity", [](Scene& scene) { scene.gravity.y() = -1e40; }}};
  for (const auto& [name, change] : faults) {
    Scene scene = empty();
    addDisk(scene, smallRadius, smallMass, Vec2::Zero(), Vec2::Zero());
    addDisk(scene, smallRadius, smallMass, Vec2(1.0, 0.0), Vec2::Zero());
    change(scene);
    const std::string refusal = refusalOf<UnsupportedScene>([&] { e->load(scene, {}); });
    EXPECT_EQ(refusal.empty(), std::string_view(name).empty()) << name;
    EXPECT_NE(refusal.find(name), std::string::npos) << refusal;
  }
}

TEST_P(BothBox2dEngines, BlockedSpinsStayAndRub) {
  Scene scene = empty();
  scene.rotation = false;
  addPair(scene, Vec2::Zero(), 0.1, 1.0, 1e-6);
  scene.disks.spin[1] *= 2.0;
  const auto one = engine();
  EXPECT_FALSE(one->load(scene, {}).effects.contains(Effect::rotation));
  one->advance(4.0 * smallContactTime);
  const Snapshot after = one->snapshot(ContactReport::none);
  for (std::size_t i : {0u, 1u})  // float32 holds seven digits
    EXPECT_NEAR((*after.spin)[i], scene.disks.spin[i], 1e-6 * std::abs(scene.disks.spin[i]));
  EXPECT_GT(after.velocity[0].x(), 0.0);             // they met,
  EXPECT_GT(std::abs(after.velocity[0].y()), 1e-3);  // and friction did its work
}

/// Declared limits let commands refuse a scene before anything starts.
TEST_P(BothBox2dEngines, DeclaresWhatWallsMayDo) {
  Scene scene = empty();
  scene.bodies = {diskWall(Vec2(0.1, 0), 1e-3)};
  const SceneLimits limits = engine()->capabilities().limits;
  using enum Motion::Kind;
  for (const Motion::Kind kind : {fixed, rotating, translating, oscillating, radial}) {
    scene.bodies[0].motion.kind = kind;
    EXPECT_EQ(beyondLimits(limits, scene, false).empty(), kind != radial);
    if (kind == radial) {
      EXPECT_THROW(engine()->load(scene, {}), UnsupportedScene);
    } else {
      EXPECT_NO_THROW(engine()->load(scene, {}));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Box2d, BothBox2dEngines,
                         testing::Values(Kind{"impulse", makeBox2dImpulse, 5e-4},
                                         Kind{"penalty", makeBox2dPenalty, 4e-5}),
                         [](const testing::TestParamInfo<Kind>& kind) {
                           return std::string(kind.param.name);
                         });

}  // namespace
}  // namespace crossgrain::test
