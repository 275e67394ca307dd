// Cylinders among the walls of a scene in space: ids, limits, starts and audits. Their physics is
// in grain_cylinder_test.cpp and, for all engines, in studies/conformance/cylinder_checks.cpp.
#include <gtest/gtest.h>

#include "adapters/audit.hpp"
#include "adapters/scene_limits.hpp"
#include "adapters/start_check.hpp"
#include "tests/support/refusal.hpp"

namespace crossgrain::test {
namespace {

constexpr double a = 0.005, bore = 0.05, depth = 1e-5;  // [m]

/// A sphere that overlaps a cylinder about the line x = 1 m, y = 2 m by `depth`, and one on
/// its axis. The body has a plane too; another body comes after it.
SpaceScene sceneWithCylinder() {
  SpaceScene scene;
  scene.name = "drum";
  scene.law.dimension = 3;
  scene.law.kn = 1e5;
  scene.dt = 1e-6;
  for (const Vec3& place : {Vec3(1.0, 2.0 - bore + a - depth, 0.1), Vec3(1.0, 2.0, 0.1)}) {
    scene.disks.radius.push_back(a);
    scene.disks.mass.push_back(1e-3);
    scene.disks.inertia.push_back(0.4 * 1e-3 * a * a);
    scene.disks.position.push_back(place);
    scene.disks.velocity.push_back(Vec3::Zero());
    scene.disks.spin.push_back(Vec3::Zero());
  }
  WallBodyOf<3> drum, other;
  drum.name = "drum";
  drum.centre = {1.0, 2.0, 7.0};
  drum.cylinders.push_back({{1.0, 2.0, -3.0}, {0.0, 0.0, 2.0}, bore});
  drum.planes.push_back({{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}});
  other.name = "other";
  other.diskPosition = {Vec3::Zero()};
  other.diskRadius = {a};
  other.planes.push_back({{0.0, 0.0, -1.0}, {0.0, 0.0, 1.0}});
  scene.bodies = {drum, other};
  return scene;
}

TEST(Cylinder, TangentPlane_TouchesWhereThePlaceIsNearest) {
  const Cylinder cylinder{{1.0, 2.0, -3.0}, {0.0, 0.0, 2.0}, 0.5};
  const PlaneOf<3> plane = tangentPlane(cylinder, {1.3, 2.4, 9.0});
  EXPECT_LT((plane.point - Vec3(1.3, 2.4, 9.0)).norm(), 1e-15);  // on the surface itself
  EXPECT_LT((plane.normal - Vec3(-0.6, -0.8, 0.0)).norm(), 1e-15);
  EXPECT_NEAR(tangentPlane(cylinder, {1.0, 2.0, 9.0}).normal.norm(), 1.0, 1e-15);  // on the axis
}

TEST(Cylinder, Ids_ComeAfterThePlanes) {
  SpaceScene scene = sceneWithCylinder();
  ASSERT_EQ(scene.idCount(), 6u);
  EXPECT_EQ(scene.cylinderCount(), 1u);
  EXPECT_EQ(nameOfId(scene, 2), "wall sphere 0");
  EXPECT_EQ(nameOfId(scene, 4), "plane 1");
  EXPECT_EQ(nameOfId(scene, 5), "cylinder 0");
  Materials materials{{"glass", "steel"}, {0, 0}, {1, 0}, std::vector<ContactLaw>(4, scene.law)};
  materials.laws[1].kn = materials.laws[2].kn = 7.0;
  scene.materials = materials;
  EXPECT_EQ(scene.lawOf(0, 5).kn, 7.0);  // of the first body, which is steel
  EXPECT_EQ(scene.lawOf(0, 4).kn, 1e5);
}

TEST(Cylinder, WhatCannotHoldIt_IsSaid) {
  SpaceScene scene = sceneWithCylinder();
  SceneLimits limits;
  const auto why = [&] { return beyondLimits(limits, scene, false); };
  using Reasons = std::vector<std::string>;
  EXPECT_EQ(why(), Reasons{"has no cylinders, as drum has"});
  limits.cylinders = true;
  EXPECT_EQ(why(), Reasons{});
  MotionOf<3>& motion = scene.bodies[0].motion;
  motion.kind = MotionKind::rotating;
  motion.angularVelocity = {0.0, 0.0, -3.0};
  EXPECT_EQ(why(), Reasons{});
  const Reasons moves{"has cylinders that stand still or turn about their axis, not as drum does"};
  scene.bodies[0].centre.x() = 1.001;  // it turns about another line
  EXPECT_EQ(why(), moves);
  scene.bodies[0].centre.x() = 1.0;
  motion.angularVelocity.x() = 1e-3;  // it tumbles
  EXPECT_EQ(why(), moves);
  motion.kind = MotionKind::translating;
  EXPECT_EQ(why(), moves);
}

TEST(Cylinder, SphereOutside_IsNoStart) {
  SpaceScene scene = sceneWithCylinder();
  scene.bodies[1] = {};
  EXPECT_EQ(startFault(scene), "");
  scene.disks.position[1].x() += bore + 0.1 * a;
  EXPECT_EQ(startFault(scene).find("sphere 1 and cylinder 0 overlap by 0.0055 m at the start"), 0u)
      << startFault(scene);
}

TEST(Cylinder, Contacts_AreAuditedWhereTheCylinderIs) {
  SpaceScene scene = sceneWithCylinder();
  scene.bodies[0].motion.kind = MotionKind::rotating;
  scene.bodies[0].motion.angularVelocity = {0.0, 0.0, 5.0};
  Capabilities can;
  can.lawOptions = {{"normal", {"linear"}}};
  EffectiveParameters effective{.dt = scene.dt, .precision = "double"};
  SpaceSnapshot shown;
  shown.position = scene.disks.position;
  shown.velocity = scene.disks.velocity;
  shown.wallPosition = {Vec3::Zero()};
  for (const WallBodyOf<3>& body : scene.bodies)
    shown.bodies.push_back(
        {body.centre, Vec3::Zero(), Vec3::Zero(), body.motion.angularVelocity, {}, {}});
  ContactsOf<3>& contacts = shown.contacts.emplace();
  contacts.i = {0};
  contacts.j = {5};
  contacts.normal = {Vec3(0.0, 1.0, 0.0)};
  contacts.overlap = {depth};
  contacts.normalForce = {1.0};
  contacts.tangentialForce = {Vec3(0.1, 0.0, 0.0)};
  const auto why = [&] { return auditFault(shown, auditBasis(scene, can, effective), 0.0); };
  EXPECT_EQ(why(), "");
  contacts.overlap[0] *= 1.1;
  EXPECT_EQ(why().find("contact 0 (sphere 0 with cylinder 0): overlaps by 1.1e-05 m"), 0u) << why();
  contacts.overlap[0] = depth;
  contacts.normal[0].y() = -1.0;
  test::expectSays(why(), {"its normal is (0.0000, -1.0000, 0.0000), from the positions"});
  shown.contacts = ContactsOf<3>{};
  EXPECT_EQ(why(), "no contact of sphere 0 with cylinder 0, which overlap by 1e-05 m");
}

}  // namespace
}  // namespace crossgrain::test
