// What both Box2D engines must do alike.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "tests/box2d/scenes.hpp"

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

  Scene empty() const {
    Scene scene;
    scene.law = box2dLaw();
    scene.dt = GetParam().dt;
    return scene;
  }
};

/// Disks thrown into a turning wheel's way, on a floor.
Scene busyScene(Scene scene) {
  scene.gravity = Vec2(0, -9.81);
  for (int k = 0; k < 12; ++k)
    addDisk(scene, k % 3 ? smallRadius : largeRadius, k % 3 ? smallMass : largeMass,
            Vec2(9.5e-3 * (k % 4), 6e-3 + 9.5e-3 * (k / 4)), Vec2(0.05 * (k % 5) - 0.1, -0.1), k);
  WallBody wheel = diskWall(Vec2(0.04, 0.02), 2e-3);
  wheel.centre = Vec2(0.05, 0.02);
  wheel.motion = rotating(20.0);
  scene.bodies = {planeWall(Vec2::Zero(), Vec2::UnitY()), planeWall(Vec2(-6e-3, 0), Vec2::UnitX()),
                  planeWall(Vec2(0.05, 0), -Vec2::UnitX()), wheel};
  return scene;
}

void expectSameBits(const Snapshot& a, const Snapshot& b) {
  ASSERT_EQ(a.position.size(), b.position.size());
  for (std::size_t i = 0; i < a.position.size(); ++i) {
    EXPECT_EQ(a.position[i], b.position[i]);
    EXPECT_EQ(a.velocity[i], b.velocity[i]);
    EXPECT_EQ((*a.spin)[i], (*b.spin)[i]);
  }
  EXPECT_EQ(*a.bodies[3].torque, *b.bodies[3].torque);
  EXPECT_EQ(a.contacts->normalForce, b.contacts->normalForce);
}

TEST_P(BothBox2dEngines, LookingChangesNothingAndLoadStartsAfresh) {
  const Scene scene = busyScene(empty());
  const auto looked = engine();
  const ContactReport most = looked->capabilities().accumulatedContacts ? ContactReport::accumulated
                                                                        : ContactReport::instant;
  looked->load(scene, {});
  for (int k = 1; k <= 100; ++k) {
    looked->advance(2e-3 * k);
    looked->snapshot(most);
    looked->snapshot(ContactReport::instant);
  }
  const auto other = engine();
  const Snapshot undisturbed = runTo(*other, scene, 0.2);
  EXPECT_GT(undisturbed.contacts->size(), 5u);
  expectSameBits(looked->snapshot(ContactReport::instant), undisturbed);
  expectSameBits(runTo(*looked, scene, 0.2), undisturbed);
}

TEST_P(BothBox2dEngines, RestsOnAPlane) {
  Scene scene = empty();
  scene.gravity = Vec2(0, -9.81);
  const bool soft = GetParam().make == makeBox2dPenalty;
  const double height = smallRadius - (soft ? smallMass * 9.81 / scene.law.kn : 0.0);
  addDisk(scene, smallRadius, smallMass, Vec2(0.01, height), Vec2::Zero());
  scene.bodies = {planeWall(Vec2::Zero(), Vec2::UnitY())};
  const auto e = engine();
  const Snapshot after = runTo(*e, scene, 1.0);
  // The soft disk starts in equilibrium. Box2D's solver may let the rigid one sink by its slop,
  // 4.9e-6 m at this unit of length, and hop from the speed e_n g dt, 1.6e-7 m high.
  const double still = soft ? 1e-12 : 5e-6;
  EXPECT_NEAR(after.position[0].y(), height, still);
  EXPECT_NEAR(after.position[0].x(), 0.01, still);
}

TEST_P(BothBox2dEngines, ForceOfARestingDiskIsItsWeight) {
  Scene scene = empty();
  scene.gravity = Vec2(0, -9.81);
  addDisk(scene, smallRadius, smallMass, Vec2(0.01, smallRadius), Vec2::Zero());
  scene.bodies = {planeWall(Vec2::Zero(), Vec2::UnitY())};
  const auto e = engine();
  e->load(scene, {});
  e->advance(1.0);
  const bool impulses = e->capabilities().accumulatedContacts;
  if (impulses) {
    e->snapshot(ContactReport::accumulated);
    e->advance(1.5);
  }
  const Snapshot at = e->snapshot(impulses ? ContactReport::accumulated : ContactReport::instant);
  const double weight = smallMass * 9.81;
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
    std::string refusal;
    try {
      e->load(scene, {});
    } catch (const UnsupportedScene& refused) {
      refusal = refused.what();
    }
    EXPECT_EQ(refusal.empty(), std::string_view(name).empty()) << name;
    EXPECT_NE(refusal.find(name), std::string::npos) << refusal;
  }
}

TEST_P(BothBox2dEngines, WheelIsWhereItShouldBe) {
  // A wall disk at 0.1 m turns at 2 /s towards a disk at rest 6 rad ahead.
  Scene scene = empty();
  WallBody wheel = diskWall(Vec2(0.1, 0), wallRadius);
  wheel.motion = rotating(2.0);
  scene.bodies = {wheel};
  const double ahead = 6.0;
  addDisk(scene, smallRadius, smallMass, 0.1 * Vec2(std::cos(ahead), std::sin(ahead)),
          Vec2::Zero());
  const double between = 2.0 * std::asin(0.5 * (smallRadius + wallRadius) / 0.1);
  const double hit = (ahead - between) / 2.0;

  const auto e = engine();
  const double dt = e->load(scene, {}).dt;
  const double before = e->advance(hit - 2.0 * dt);
  Snapshot at = e->snapshot(ContactReport::none);
  EXPECT_EQ(at.velocity[0].norm(), 0.0);
  EXPECT_EQ(at.bodies[0].angle, 2.0 * before);
  EXPECT_NEAR((at.wallPosition[0] - 0.1 * Vec2(std::cos(2 * before), std::sin(2 * before))).norm(),
              0.0, 1e-16);
  e->advance(hit + 3.0 * dt);
  at = e->snapshot(ContactReport::none);
  EXPECT_GT(at.velocity[0].norm(), 1e-3);
}

TEST_P(BothBox2dEngines, MovingPlanePushes) {
  Scene scene = empty();
  scene.law.tangential = TangentialLaw::none;
  addDisk(scene, smallRadius, smallMass, Vec2(smallRadius + 1e-3, 0), Vec2::Zero());
  scene.bodies = {planeWall(Vec2::Zero(), Vec2::UnitX())};
  scene.bodies[0].motion.kind = Motion::Kind::translating;
  scene.bodies[0].motion.velocity = Vec2(0.1, 0);
  const auto e = engine();
  const Snapshot after = runTo(*e, scene, 0.05);
  // (1 + e_n) v with e_n = 0.365 of a small disk on a wall; 1 %: first-order scheme at t_c/80.
  EXPECT_NEAR(after.velocity[0].x(), 0.1365, 0.0015);
  EXPECT_FALSE(after.spin);
  EXPECT_EQ(after.bodies[0].centre, Vec2(0.1 * after.positionTime, 0));
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

TEST_P(BothBox2dEngines, RefusesAShrinkingRing) {
  Scene scene = empty();
  addDisk(scene, smallRadius, smallMass, Vec2::Zero(), Vec2::Zero());
  scene.bodies = {diskWall(Vec2(0.1, 0), 1e-3)};
  scene.bodies[0].motion.kind = Motion::Kind::radial;
  try {
    engine()->load(scene, {});
    FAIL() << "loaded a shrinking ring";
  } catch (const UnsupportedScene& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("post"), std::string::npos);
  }
}

/// What it declares, so that commands refuse before anything starts.
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

/// It declares no limit of J = q m a²: what friction takes of a disk's momentum, m Δv_t, turns it
/// by a m Δv_t/J. The impulse engine's arm ends half way into the overlap.
TEST_P(BothBox2dEngines, HasAnyMomentOfInertia) {
  EXPECT_FALSE(engine()->capabilities().limits.inertia);
  for (const double q : {0.1, 0.4, 1.0}) {
    Scene scene = empty();
    addPair(scene, Vec2::Zero(), 0.1, 2.0, 1.3e-4);
    for (double& inertia : scene.disks.inertia) inertia = q * smallMass * smallRadius * smallRadius;
    const auto one = engine();
    const Snapshot after = runTo(*one, scene, 0.02);
    for (const std::size_t i : {0u, 1u}) {
      const Vec2 gained = after.velocity[i] - scene.disks.velocity[i];
      const double turned = (*after.spin)[i] - scene.disks.spin[i];
      EXPECT_GT(std::abs(gained.y()), 1e-3);
      EXPECT_NEAR(std::abs(turned) * q * smallRadius / std::abs(gained.y()), 1.0, 0.01) << q;
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
