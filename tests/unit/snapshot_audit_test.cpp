// Snapshots made by hand: a sound one, and each fault once.
#include <gsl/gsl_rng.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "adapters/audit.hpp"
#include "adapters/near_pairs.hpp"
#include "support/random.hpp"
#include "tests/support/laws.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/scenes.hpp"

namespace {

using namespace crossgrain;
using test::smallMass;
using test::smallRadius;

constexpr double dt = 1e-5;
constexpr double depth = 1e-5;  // of both contacts [m]

/// Disk 0 lies between disk 1 and a wall disk on a turning wheel, pressed into both; disk 2 is far
/// off.
class Audit : public testing::Test {
 protected:
  Audit() {
    scene_.law = test::thesisLaw();
    scene_.dt = dt;
    const double reach = 2.0 * smallRadius - depth;
    test::addDisk(scene_, smallRadius, smallMass, {0.0, 0.0}, Vec2::Zero());
    test::addDisk(scene_, smallRadius, smallMass, {reach, 0.0}, Vec2::Zero());
    test::addDisk(scene_, smallRadius, smallMass, {0.05, 0.05}, {0.1, 0.0});
    scene_.bodies = {test::diskWall({-reach, 0.0}, smallRadius)};
    scene_.bodies[0].centre = {-0.05, 0.0};
    scene_.bodies[0].motion = test::rotating(1.0);
    can_.lawOptions = {{"normal", {"linear"}}};
    effective_.dt = dt;
    effective_.precision = "double";

    shown_.position = scene_.disks.position;
    shown_.velocity = scene_.disks.velocity;
    shown_.spin = {{0.0, 0.0, 0.0}};
    shown_.wallPosition = scene_.bodies[0].diskPosition;
    shown_.bodies.resize(1);
    shown_.bodies[0].centre = scene_.bodies[0].centre;
    shown_.bodies[0].angularVelocity = 1.0;
    Contacts& contacts = shown_.contacts.emplace();
    contacts.i = {0, 0};
    contacts.j = {1, 3};
    contacts.normal = {Vec2(-1.0, 0.0), Vec2(1.0, 0.0)};
    contacts.overlap = {depth, depth};
    const double fn = scene_.law.kn * depth;
    contacts.normalForce = {fn, fn};
    contacts.tangentialForce = {0.5 * scene_.law.mu * fn, 0.0};
  }

  AuditBasis basis() const { return auditBasis(scene_, can_, effective_); }
  std::string why() const { return auditFault(shown_, basis(), 0.0); }
  std::string lawFaultOf() const { return lawFault(shown_, basis(), scene_.law); }
  Contacts& contacts() { return *shown_.contacts; }

  Scene scene_;
  Capabilities can_;
  EffectiveParameters effective_;
  Snapshot shown_;
};

TEST_F(Audit, ForcesOfMaterials_AreThoseOfTheirPair) {
  Materials& materials = scene_.materials.emplace();
  materials = {{"glass", "steel"}, {0, 0, 0}, {1}, std::vector<ContactLaw>(4, scene_.law)};
  for (const std::size_t mixed : {1u, 2u}) {
    materials.laws[mixed].kn *= 3.0;
    materials.laws[mixed].mu = 0.0;
  }
  test::expectSays(lawFaultOf(), {"contact 1 (disk 0 with wall disk 0): f_n is"});
  contacts().normalForce[1] *= 3.0;
  EXPECT_EQ(lawFaultOf(), "");
  contacts().tangentialForce[1] = 0.1 * contacts().normalForce[1];  // within [law]'s mu
  test::expectSays(lawFaultOf(), {"contact 1 (disk 0 with wall disk 0): |f_t| is"});
}

TEST_F(Audit, SoundSnapshotsPass) {
  EXPECT_EQ(why(), "");
  EXPECT_EQ(lawFaultOf(), "");
  shown_.contacts.reset();
  EXPECT_EQ(why(), "") << "what is not shown is not asked for";
}

TEST_F(Audit, Times) {
  shown_.positionTime = -5.0;
  test::expectSays(why(), {"positions are of t = -5 s, before the start"});
  shown_.positionTime = 3.5 * dt;
  test::expectSays(why(), {"3.500 steps of 1e-05 s: not a whole number"});
  shown_.positionTime = 3.0 * dt;
  test::expectSays(why(), {"not of 0 s that advance reached"});
  shown_.positionTime = 0.0;
  shown_.velocityTime = 2.0 * dt;
  test::expectSays(why(), {"velocities are of t = 2e-05 s, more than a step"});
  shown_.velocityTime = 0.0;
  shown_.contactTime = -3.0 * dt;
  test::expectSays(why(), {"contacts are of t = -3e-05 s"});
  shown_.contactTime = 0.0;
  shown_.contactInterval = -1.0;
  test::expectSays(why(), {"which is no interval"});
  shown_.contactInterval = 1.0;
  test::expectSays(why(), {"longer than the 0 s since the start"});
}

TEST_F(Audit, Places) {
  shown_.position[2] = {1e300, 0.0};
  test::expectSays(why(), {"disk 2 is at (1e+300, 0) m, outside of the scene"});
  shown_.position[2] = {0.05, std::nan("")};
  test::expectSays(why(), {"disk 2 is at"});
  shown_.position[2] = {0.05, 0.05};
  shown_.velocity[2] = {0.0, 1e9};
  test::expectSays(why(), {"disk 2 moves at 1e+09 m/s"});
  scene_.disks.velocity[2] = {0.0, 1e9};
  EXPECT_EQ(why(), "") << "a scene that starts so, with a step as long as an engine's own";
  scene_.disks.velocity[2] = shown_.velocity[2] = {0.1, 0.0};
  shown_.wallPosition[0].y() = 1e-4;
  test::expectSays(why(), {"wall disk 0 is at"});
  shown_.wallPosition[0].y() = 0.0;
  shown_.bodies[0].angle = 1.0;
  test::expectSays(why(), {"has turned by 1 rad, not by 0 rad"});
}

TEST_F(Audit, IdsAndNumbersOfDisks) {
  contacts().i[1] = 3;
  contacts().j[1] = 3;
  test::expectSays(why(), {"contact 1 is of 3 and 3"});
  contacts().i[1] = -1;
  test::expectSays(why(), {"contact 1 is of -1 and 3"});
  contacts().i[1] = 0;
  contacts().j[1] = 4;
  test::expectSays(why(), {"a later id below 4"});
  contacts().j[1] = 1;
  test::expectSays(why(), {"(disk 0 with disk 1) is listed twice"});
  shown_.position.pop_back();
  test::expectSays(why(), {"2 positions are shown, not 3"});
}

TEST_F(Audit, NormalsAndOverlaps) {
  contacts().normal[1] *= 2.0;
  test::expectSays(why(), {"contact 1 (disk 0 with wall disk 0): its normal has length 2, not 1"});
  contacts().normal[1] = {-1.0, 0.0};
  test::expectSays(why(), {"its normal is (-1.0000, 0.0000), from the positions (1.0000, 0.0000)"});
  contacts().overlap[0] = -1.0;
  test::expectSays(
      why(), {"contact 0 (disk 0 with disk 1): overlaps by -1 m, from the positions by 1e-05"});
}

TEST_F(Audit, MissingContacts) {
  for (std::vector<double>* each :
       {&contacts().overlap, &contacts().normalForce, &contacts().tangentialForce})
    each->pop_back();
  contacts().i.pop_back();
  contacts().j.pop_back();
  contacts().normal.pop_back();
  test::expectSays(why(), {"no contact of disk 0 with wall disk 0, which overlap by 1e-05 m"});
}

TEST_F(Audit, InventedContacts) {
  const Vec2 apart = scene_.disks.position[0] - scene_.disks.position[2];
  contacts().i.push_back(0);
  contacts().j.push_back(2);
  contacts().normal.push_back(apart.normalized());
  contacts().overlap.push_back(2.0 * smallRadius - apart.norm());
  contacts().normalForce.push_back(0.0);
  contacts().tangentialForce.push_back(0.0);
  EXPECT_EQ(why(), "") << "a pair that was looked at, without a force";
  contacts().normalForce.back() = 1.0;
  test::expectSays(why(), {"contact 2 (disk 0 with disk 2): a force of 1 N passes a gap"});
}

/// No two that touch are passed over, wherever a far one puts the squares, and none comes twice.
TEST(NearPairs, AreAllThatTouch) {
  const Random random = randomStream(1, 0);
  const auto number = [&](double most) { return most * gsl_rng_uniform(random.get()); };
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Vec2> place;
    std::vector<double> radius;
    const double width = number(20.0), height = trial % 5 == 0 ? 0.0 : number(20.0);
    for (int k = 0; k < 1 + trial % 60; ++k) {
      place.emplace_back(number(width) - 5.0, number(height));
      radius.push_back(0.1 + number(1.0));
    }
    if (trial % 7 == 0) place.front() = {1e9, 0.0};
    const std::size_t moving = place.size() / 2 + 1;
    std::multiset<std::pair<std::size_t, std::size_t>> found, wanted;
    const auto touch = [&](std::size_t i, std::size_t j) {
      return (place[i] - place[j]).norm() < radius[i] + radius[j];
    };
    nearPairs(place, radius, moving, [&](std::size_t i, std::size_t j) {
      if (touch(i, j)) found.emplace(i, j);
    });
    for (std::size_t i = 0; i < moving; ++i)
      for (std::size_t j = i + 1; j < place.size(); ++j)
        if (touch(i, j)) wanted.emplace(i, j);
    EXPECT_EQ(found, wanted) << "trial " << trial;
  }
}

/// The same in space, in boxes with periodic directions: against the nearest image of every pair.
TEST(NearPairs, AreAllThatTouchAcrossBorders) {
  const Random random = randomStream(2, 0);
  const auto number = [&](double most) { return most * gsl_rng_uniform(random.get()); };
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 low(-1.0, 2.0, 0.5), wide(4.5 + number(3.0), 4.5 + number(9.0), 5.0);
    std::optional<BoxOf<3>> box = BoxOf<3>{low, low + wide, {}};
    for (std::size_t k = 0; k < 3; ++k) box->periodic[k] = (trial >> k) % 2 == 1;
    if (trial % 8 == 0) box.reset();
    std::vector<Vec3> place;
    std::vector<double> radius;
    for (int k = 0; k < 1 + trial % 60; ++k) {
      place.push_back(low + Vec3(number(1.0), number(1.0), number(1.0)).cwiseProduct(2.0 * wide));
      radius.push_back(0.1 + number(0.9));
    }
    const std::size_t moving = place.size() / 2 + 1;
    std::set<std::pair<std::size_t, std::size_t>> found, wanted;
    const auto touch = [&](std::size_t i, std::size_t j) {
      const Vec3 apart = place[i] - place[j];
      return (box ? box->nearest(apart) : apart).norm() < radius[i] + radius[j];
    };
    nearPairs<3>(place, radius, moving, box, [&](std::size_t i, std::size_t j) {
      EXPECT_LT(i, j);
      if (touch(i, j)) found.emplace(i, j);
    });
    for (std::size_t i = 0; i < moving; ++i)
      for (std::size_t j = i + 1; j < place.size(); ++j)
        if (touch(i, j)) wanted.emplace(i, j);
    EXPECT_EQ(found, wanted) << "trial " << trial;
  }
}

/// Disk 1 is seen one box to the right, and the wall disk one box down: contacts stay as they are.
TEST_F(Audit, PeriodicBox_PositionsOfAnyImage) {
  const Vec2 wide(0.2, 0.3);
  shown_.position[1].x() += wide.x();
  shown_.wallPosition[0].y() -= wide.y();
  test::expectSays(why(), {"wall disk 0 is at"});
  scene_.box = BoxOf<2>{{-0.1, -0.1}, Vec2(-0.1, -0.1) + wide, {true, true}};
  EXPECT_EQ(why(), "");
  EXPECT_EQ(lawFaultOf(), "");
  contacts().normal[0] = {1.0, 0.0};  // of the long way round
  test::expectSays(why(), {"contact 0 (disk 0 with disk 1): its normal is (1.0000, 0.0000)"});
  contacts().i.pop_back();
  contacts().j.pop_back();
  contacts().normal = {Vec2(-1.0, 0.0)};
  contacts().overlap.pop_back();
  contacts().normalForce.pop_back();
  contacts().tangentialForce.pop_back();
  test::expectSays(why(), {"no contact of disk 0 with wall disk 0, which overlap by 1e-05 m"});
}

/// A sphere between another, seen one box along z, and a wall sphere.
TEST(AuditInSpace, ContactsThroughNearestImages) {
  const double a = smallRadius, reach = 2.0 * a - depth;
  SpaceScene scene;
  scene.law = test::thesisLaw();
  scene.law.dimension = 3;
  scene.dt = dt;
  for (const Vec3& place : {Vec3(0.0, 0.0, 0.0), Vec3(0.0, 0.0, reach)}) {
    scene.disks.radius.push_back(a);
    scene.disks.mass.push_back(smallMass);
    scene.disks.inertia.push_back(0.4 * smallMass * a * a);
    scene.disks.position.push_back(place);
    scene.disks.velocity.push_back(Vec3::Zero());
    scene.disks.spin.push_back(Vec3::Zero());
  }
  WallBodyOf<3> wall;
  wall.name = "wall";
  wall.diskPosition = {Vec3(0.0, -reach, 0.0)};
  wall.diskRadius = {a};
  scene.bodies = {wall};
  scene.box = BoxOf<3>{Vec3::Constant(-0.05), Vec3::Constant(0.05), {true, false, true}};
  Capabilities can;
  can.lawOptions = {{"normal", {"linear"}}};
  EffectiveParameters effective{.dt = dt, .precision = "double"};
  SpaceSnapshot shown;
  shown.position = scene.disks.position;
  shown.position[1].z() -= 0.1;
  shown.velocity = scene.disks.velocity;
  shown.wallPosition = wall.diskPosition;
  shown.bodies.resize(1);
  ContactsOf<3>& contacts = shown.contacts.emplace();
  contacts.i = {0, 0};
  contacts.j = {1, 2};
  contacts.normal = {Vec3(0.0, 0.0, -1.0), Vec3(0.0, 1.0, 0.0)};
  contacts.overlap = {depth, depth};
  contacts.normalForce = {0.1, 0.1};
  contacts.tangentialForce = {Vec3::Zero(), Vec3::Zero()};
  const auto why = [&] { return auditFault(shown, auditBasis(scene, can, effective), 0.0); };
  EXPECT_EQ(why(), "");

  // A tangential force along the normal changes σ_zz, as if it were a part of f_n.
  contacts.tangentialForce[0] = Vec3(0.0, 0.0, 0.01);
  test::expectSays(
      why(), {"contact 0 (sphere 0 with sphere 1): -0.01 N of its tangential force of 0.01 N are "
              "along the normal"});
  contacts.tangentialForce[0] = Vec3(0.01, 0.0, 1e-5);
  EXPECT_EQ(why(), "") << "a thousandth, as normals turn in a step";
  const auto untouched = contacts;
  contacts.normalForce[0] = 0.0;
  contacts.tangentialForce[0] = Vec3(0.0, 0.0, 5e-17);
  scene.disks.velocity[0].z() = 0.05;
  EXPECT_EQ(why(), "") << "what roundings of velocities leave of contacts that just touch";
  scene.disks.velocity[0].z() = 0.0;
  contacts = untouched;
  contacts.tangentialForce[0] = Vec3::Zero();
  contacts.normalForce[1] = 1e308;
  test::expectSays(why(), {"a force of 1e+308 N would throw all disks out of the scene in a step"});
  contacts.normalForce[1] = 0.1;

  // Forces: f_n = k_n δ of what rests; f_t and M are vectors within their bounds.
  const auto byLaw = [&] { return lawFault(shown, auditBasis(scene, can, effective), scene.law); };
  test::expectSays(byLaw(), {"contact 0 (sphere 0 with sphere 1): f_n is 0.1 N"});
  scene.law.gn = 0.0;
  scene.law.rolling = RollingLaw::constantTorque;
  scene.law.muR = 0.2;
  const double fn = scene.law.kn * depth, bound = scene.law.muR * 0.5 * a * fn;
  contacts.normalForce = {fn, fn};
  const Vec3 across = Vec3(0.6, 0.0, 0.8);  // to the normal of contact 1
  contacts.tangentialForce[1] = 0.999 * scene.law.mu * fn * across;
  contacts.rollingTorque = {Vec3::Zero(), -bound * across};
  EXPECT_EQ(byLaw(), "");
  contacts.rollingTorque[1] *= 1.001;
  test::expectSays(byLaw(),
                   {"contact 1 (sphere 0 with wall sphere 0): the torque against rolling is"});
  contacts.tangentialForce[1] *= 1.002;
  test::expectSays(byLaw(), {"|f_t| is"});

  contacts.overlap[1] *= 0.9;
  test::expectSays(why(), {"contact 1 (sphere 0 with wall sphere 0): overlaps by 9e-06 m"});
  contacts.overlap[1] = depth;
  contacts.normal[0].z() = 1.0;
  test::expectSays(
      why(), {"its normal is (0.0000, 0.0000, 1.0000), from the positions (0.0000, 0.0000, -1"});
  contacts.normal[0].z() = -1.0;
  contacts.j[0] = 2;
  test::expectSays(why(), {"is listed twice"});
  shown.wallPosition[0].x() += 1e-3;
  test::expectSays(why(), {"wall sphere 0 is at"});
}

/// Planes are followed where they do not turn.
TEST_F(Audit, Planes) {
  scene_.bodies.push_back(test::planeWall({0.0, -smallRadius + depth}, {0.0, 1.0}));
  scene_.disks.position[1].y() = shown_.position[1].y() = 0.0;
  shown_.bodies.emplace_back();
  shown_.position[1].y() += 1e-3;  // off the plane, and off disk 0
  shown_.contacts->i = {0, 0};
  shown_.contacts->j = {3, 4};
  shown_.contacts->normal = {Vec2(1.0, 0.0), Vec2(0.0, 1.0)};
  EXPECT_EQ(why(), "");
  shown_.contacts->j[1] = 3;
  shown_.contacts->i[1] = 1;
  EXPECT_NE(why(), "");
}

/// A plane that has turned by 0.3 rad about a point 2 cm along it, half way into a step.
TEST_F(Audit, TurningPlanes) {
  const double angle = 0.3, omega = 3.0, t = 1e4 * dt;
  WallBody wall = test::planeWall({0.0, 0.0}, {0.0, 1.0});
  wall.centre = {-0.02, 0.0};
  wall.motion = test::rotating(omega);
  scene_.bodies = {wall};
  const Vec2 along(std::cos(angle), std::sin(angle)), normal(-std::sin(angle), std::cos(angle));
  const double arm = 0.04;  // of the foot
  shown_.positionTime = shown_.velocityTime = shown_.contactTime = t;
  shown_.position[0] = wall.centre + arm * along + (smallRadius - depth) * normal;
  shown_.position[1] = shown_.position[0] + 3.0 * smallRadius * normal;
  shown_.velocity[0] = omega * arm * normal;  // with the plane
  shown_.wallPosition.clear();
  shown_.bodies = {{wall.centre, omega * t, Vec2::Zero(), omega, {}, {}}};
  Contacts& contacts = shown_.contacts.emplace();
  contacts.i = {0};
  contacts.j = {3};
  contacts.normal = {normal};
  contacts.overlap = {depth};
  contacts.normalForce = {scene_.law.kn * depth};
  contacts.tangentialForce = {0.0};
  const auto why = [&] { return auditFault(shown_, basis(), t); };
  EXPECT_EQ(why(), "");
  EXPECT_EQ(lawFaultOf(), "");
  shown_.velocity[0] *= 2.0;  // leaves it at Ω·arm
  test::expectSays(lawFaultOf(), {"contact 0 (disk 0 with plane 0): f_n is"});
  contacts.normalForce[0] -= scene_.law.gn * omega * arm;
  EXPECT_EQ(lawFaultOf(), "");
  contacts.normal = {Vec2(0.0, 1.0)};
  test::expectSays(why(),
                   {"(disk 0 with plane 0): its normal is (0.0000, 1.0000), from the positions "
                    "(-0.2955, 0.9553)"});
  contacts = {};
  test::expectSays(why(), {"no contact of disk 0 with plane 0, which overlap by 1e-05 m"});
  scene_.bodies[0].motion.angularVelocity = -omega;
  shown_.bodies[0].angle = -omega * t;
  EXPECT_EQ(why(), "") << "the disk is not on the plane that turned the other way";
}

/// Contacts a step older than positions are looked for where disks were then.
TEST_F(Audit, StaggeredContacts) {
  shown_.bodies[0].angularVelocity = scene_.bodies[0].motion.angularVelocity = 0.0;
  for (Vec2& velocity : shown_.velocity) velocity = {0.3, -0.2};
  shown_.velocity[0] = Vec2::Zero();
  shown_.velocity[1] = {1.5 * depth / dt, 0.0};  // has left since
  for (std::size_t i = 0; i < 3; ++i) shown_.position[i] += dt * shown_.velocity[i];
  shown_.positionTime = dt;
  shown_.velocityTime = 0.5 * dt;
  EXPECT_EQ(auditFault(shown_, basis(), dt), "");
  shown_.contactTime = dt;
  test::expectSays(auditFault(shown_, basis(), dt),
                   {"overlaps by 1e-05 m, from the positions by -5e-06"});
}

/// Rigid disks have moved on since their impulse, and no pair is asked for.
TEST_F(Audit, RigidContacts) {
  can_.lawOptions["normal"] = {"rigid"};
  shown_.velocity[1] = {20.0 * depth / dt, 0.0};
  shown_.position[1] += dt * shown_.velocity[1];
  shown_.positionTime = shown_.velocityTime = shown_.contactTime = dt;
  shown_.bodies[0].angle = dt;
  EXPECT_EQ(contactFault(shown_, basis()), "");
  shown_.velocity[1].setZero();
  test::expectSays(contactFault(shown_, basis()),
                   {"overlaps by 1e-05 m, from the positions by -0.00019"});
  shown_.position[1].x() -= 19.0 * depth;
  EXPECT_EQ(contactFault(shown_, basis()), "")
      << "moved out of another as deep as disk 0 lies in the wall";
}

TEST_F(Audit, SinglePrecisionIsRounded) {
  contacts().overlap[0] += 1e-9;
  EXPECT_NE(why(), "");
  effective_.precision = "float";
  EXPECT_EQ(why(), "");
}

/// Hundreds of extents from the origin a place has fewer digits than a millionth of the extent.
TEST_F(Audit, SinglePrecisionFarFromTheOrigin_RoundsWalls) {
  const Vec2 far(30.0, -20.0);
  for (auto* places : {&scene_.disks.position, &shown_.position, &shown_.wallPosition})
    for (Vec2& place : *places) place += far;
  WallBody& wall = scene_.bodies[0];
  wall.diskPosition[0] += far;
  wall.centre += far;
  shown_.bodies[0].centre = wall.centre;
  shown_.contacts.reset();
  shown_.wallPosition[0] = shown_.wallPosition[0].cast<float>().cast<double>();
  EXPECT_NE(why(), "");
  effective_.precision = "float";
  EXPECT_EQ(why(), "");
}

TEST_F(Audit, NormalForces) {
  contacts().normalForce[1] *= 1.02;
  test::expectSays(lawFaultOf(), {"contact 1 (disk 0 with wall disk 0): f_n is"});
  EXPECT_EQ(why(), "") << "the law is the expensive part";
}

TEST_F(Audit, DashpotsAreHeldToTheVelocitiesShown) {
  shown_.velocity[1] = {-0.5, 0.0};
  EXPECT_NE(lawFaultOf(), "");
  contacts().normalForce[0] += 0.5 * scene_.law.gn;
  EXPECT_EQ(lawFaultOf(), "");
}

/// 0.8 m/s cover the overlap in 1.25 steps: the dashpot may have seen disk 0 without its forces,
/// which are balanced now. 0.4 m/s take 2.5 steps.
TEST_F(Audit, ForcesThatBeganWithinAStepAndAHalf_MayBeOfTheVelocitiesBefore) {
  const auto beganAt = [this](double speed) {
    shown_.velocity[0] = {-speed, 0.0};
    shown_.velocity[1] = {-2.0 * speed, 0.0};
    const double fn = scene_.law.kn * depth + scene_.law.gn * speed;
    contacts().normalForce = {fn, fn + 1e-3};
  };
  beganAt(0.8);
  EXPECT_EQ(lawFaultOf(), "");
  beganAt(0.4);
  test::expectSays(lawFaultOf(), {"contact 1 (disk 0 with wall disk 0): f_n is"});
}

/// Disk 2 leaves disk 0 at 0.5 m/s, where its dashpot pulled by 0.1 N and a bond by 0.1 N.
TEST_F(Audit, ForcesThatEndedWithinAStepAndAHalf_MayBeOfTheVelocitiesBefore) {
  shown_.velocity[2] = {0.0, 0.5};
  contacts().normalForce[1] += 5e-4;
  const auto gap = [this](double way) { shown_.position[2] = {0.0, 2.0 * smallRadius + way}; };
  gap(1e-6);
  EXPECT_EQ(lawFaultOf(), "");
  gap(1e-5);
  EXPECT_NE(lawFaultOf(), "") << "two steps ago";
  gap(1e-6);
  scene_.law.conventions.tension = Tension::cut;
  EXPECT_NE(lawFaultOf(), "") << "that dashpot does not pull";
  scene_.law.cohesion = CohesionLaw::dmt;
  scene_.law.w = 0.1 / (std::numbers::pi * smallRadius);  // F_po = 2π w R₁₂ = 0.1 N
  for (double& force : contacts().normalForce) force -= 0.1;
  EXPECT_EQ(lawFaultOf(), "");
}

TEST_F(Audit, TangentialForces) {
  contacts().tangentialForce[1] = 1.01 * scene_.law.mu * contacts().normalForce[1];
  test::expectSays(lawFaultOf(), {"|f_t| is"});
  scene_.law.conventions.dashpot = Dashpot::outside;
  shown_.spin = {{1e3, 0.0, 0.0}};
  EXPECT_EQ(lawFaultOf(), "") << "the dashpot's part is not bounded";
}

TEST_F(Audit, RigidDisksDoNotPull) {
  can_.lawOptions["normal"] = {"rigid"};
  scene_.law.normal = NormalLaw::rigid;
  contacts().normalForce[1] = -1e-3;
  test::expectSays(lawFaultOf(), {"rigid disks do not pull"});
}

TEST_F(Audit, Costs) {
  Stats stats{100, 3, 0.1, 0.1, {}};
  EXPECT_EQ(statsFault(stats, dt, 100.0 * dt), "");
  stats.steps = static_cast<std::uint64_t>(-1);
  test::expectSays(statsFault(stats, dt, 100.0 * dt), {"18446744073709551615 steps are counted"});
  stats.steps = 100;
  stats.cpuSeconds = -1.0;
  test::expectSays(statsFault(stats, dt, 100.0 * dt), {"which cannot be"});
}

/// Two equal disks under JKR, at the places of the facts that LAMMPS was run for: R* = 0.25 m,
/// E* = 5·10⁴ Pa, γ = 100 J/m², so w = 2 γ.
TEST_F(Audit, BondOfJkr_ReachesBeyondTheContact) {
  scene_.bodies.clear();
  shown_.bodies.clear();
  shown_.wallPosition.clear();
  ContactLaw& law = scene_.law = {};
  law.normal = NormalLaw::hertz;
  law.tangential = TangentialLaw::none;
  law.kn = 4.0 / 3.0 * 5e4;
  law.cohesion = CohesionLaw::jkr;
  law.w = 200.0;
  scene_.disks.radius = {0.5, 0.5, 0.1};
  const auto at = [&](double overlap, double force) {
    scene_.disks.position = {{0.0, 0.0}, {1.0 - overlap, 0.0}, {5.0, 5.0}};
    shown_.position = scene_.disks.position;
    shown_.velocity.assign(3, Vec2::Zero());
    contacts() = {{0}, {1}, {Vec2(-1.0, 0.0)}, {overlap}, {force}, {0.0}, {}, {}, {}};
  };
  for (const auto& [overlap, force] :
       {std::pair(0.002, -201.2221), {0.0, -209.4395}, {-0.012, -235.6027}}) {
    at(overlap, force);
    EXPECT_EQ(why(), "");
    at(overlap, force + 1e-3);
    test::expectSays(lawFaultOf(), {"by the law " + std::to_string(force).substr(0, 6)});
  }
  at(-0.01229, -235.0);  // the pull ends at −0.012277 m
  test::expectSays(why(), {"passes a gap of 0.0123 m"});
  law.conventions.jkrEnd = JkrEnd::branch;
  EXPECT_EQ(why(), "");
  at(-0.0256, -131.0);  // and here at −0.02554 m
  test::expectSays(why(), {"passes a gap"});
}

TEST_F(Audit, ForcesOfCohesiveLaws) {
  ContactLaw& law = scene_.law;
  law.gn = 0.0;
  const double fn = law.kn * depth;
  contacts().tangentialForce = {0.0, 0.0};
  law.cohesion = CohesionLaw::dmt;
  law.w = 0.1 * fn / (std::numbers::pi * smallRadius);  // F_po = 0.1 f_el, R₁₂ = a/2
  contacts().normalForce = {0.9 * fn, 0.9 * fn};
  EXPECT_EQ(lawFaultOf(), "");
  contacts().normalForce[1] = fn;
  test::expectSays(lawFaultOf(), {"f_n is"});
  // Without the pull sliding is bounded by µ f_el; with it by less.
  contacts().normalForce[1] = 0.9 * fn;
  contacts().tangentialForce[0] = 0.99 * law.mu * fn;
  EXPECT_EQ(lawFaultOf(), "");
  law.conventions.cohesionLoad = CohesionLoad::net;
  test::expectSays(lawFaultOf(), {"|f_t|"});
  law.conventions.cohesionLoad = CohesionLoad::plusTwicePullOff;
  contacts().tangentialForce[0] = 1.09 * law.mu * fn;
  EXPECT_EQ(lawFaultOf(), "");
  contacts().tangentialForce[0] = 0.0;

  // δ_max is not visible: any force between loading and the largest pull passes.
  law.cohesion = CohesionLaw::elastoPlastic;
  law.kc = 0.5 * law.kn;
  law.kUnload = 3.0 * law.kn;
  for (const double share : {1.0, 0.1, -0.5}) {
    contacts().normalForce = {share * fn, share * fn};
    EXPECT_EQ(lawFaultOf(), "") << share;
  }
  for (const double share : {1.001, -0.501}) {
    contacts().normalForce[0] = share * fn;
    test::expectSays(lawFaultOf(), {"f_n is"});
  }
}

TEST_F(Audit, TorqueAgainstRolling_IsWithinItsBound) {
  ContactLaw& law = scene_.law;
  law.gn = 0.0;
  law.rolling = RollingLaw::constantTorque;
  law.muR = 0.2;
  const double bound = law.muR * 0.5 * smallRadius * law.kn * depth;
  contacts().rollingTorque = {bound, -bound};
  EXPECT_EQ(lawFaultOf(), "");
  contacts().rollingTorque[1] *= 1.001;
  test::expectSays(lawFaultOf(), {"the torque against rolling"});
  law.conventions.rollingLength = RollingLength::smallerRadius;
  EXPECT_EQ(lawFaultOf(), "");
  law.rolling = RollingLaw::none;
  test::expectSays(lawFaultOf(), {"the law allows 0 N m"});
}

}  // namespace
