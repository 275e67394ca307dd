// Convex bodies: their masses against closed forms and against points at random, overlaps and
// faults by hand.
#include "adapters/shape.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "adapters/audit.hpp"
#include "adapters/scene.hpp"
#include "adapters/start_check.hpp"

namespace crossgrain {
namespace {

using std::numbers::pi;

ShapeOf<2> regular(int n, double radius, double rounding = 0.0) {
  ShapeOf<2> shape{ShapeKind::polygon, {}, rounding};
  for (int k = 0; k < n; ++k)
    shape.vertices.emplace_back(radius * std::cos(2.0 * pi * k / n),
                                radius * std::sin(2.0 * pi * k / n));
  return shape;
}

ShapeOf<3> boxOf(const Vec3& half) {
  ShapeOf<3> shape{ShapeKind::box, {}, 0.0};
  for (int k = 0; k < 8; ++k)
    shape.vertices.push_back(
        half.cwiseProduct(Vec3(k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0)));
  return shape;
}

TEST(ShapeMass, ClosedFormsInThePlane) {
  // Regular n-gon: J = m R² (2 + cos 2π/n)/6.
  for (const int n : {3, 4, 6, 17}) {
    const ShapeMassOf<2> mass = massOf(regular(n, 0.3));
    EXPECT_NEAR(mass.measure, n / 2.0 * 0.09 * std::sin(2.0 * pi / n), 1e-15);
    EXPECT_NEAR(momentsPerMass(mass), 0.09 * (2.0 + std::cos(2.0 * pi / n)) / 6.0, 1e-15);
    EXPECT_NEAR(mass.centre.norm(), 0.0, 1e-15);
  }
  // Off the origin: a right triangle has its centre at a third of its legs.
  const ShapeMassOf<2> triangle = massOf<2>({ShapeKind::polygon, {{1, 1}, {4, 1}, {1, 3}}, 0.0});
  EXPECT_NEAR(triangle.measure, 3.0, 1e-14);
  EXPECT_NEAR((triangle.centre - Vec2(2.0, 5.0 / 3.0)).norm(), 0.0, 1e-14);
  EXPECT_NEAR(momentsPerMass(triangle), (9.0 + 4.0) / 18.0, 1e-14);
  // A disk is a rounded point, a capsule a rectangle and two halves of a disk.
  const ShapeMassOf<2> disk = massOf<2>({ShapeKind::capsule, {{0, 0}}, 0.5});
  EXPECT_NEAR(momentsPerMass(disk), 0.125, 1e-15);
  const double l = 0.7, r = 0.2, A = 4.0 * l * r, B = pi * r * r;
  const ShapeMassOf<2> capsule = massOf<2>({ShapeKind::capsule, {{-l, 0}, {l, 0}}, r});
  EXPECT_NEAR(capsule.measure, A + B, 1e-14);
  const double halves = B * (r * r / 2.0 + l * l + 2.0 * l * 4.0 * r / (3.0 * pi));
  const double expected = (A * (4.0 * l * l + 4.0 * r * r) / 12.0 + halves) / (A + B);
  EXPECT_NEAR(momentsPerMass(capsule), expected, 1e-14);
}

TEST(ShapeMass, ClosedFormsInSpace) {
  const Vec3 half(0.1, 0.2, 0.3);
  const ShapeMassOf<3> box = massOf(boxOf(half));
  EXPECT_NEAR(box.measure, 0.048, 1e-15);
  const Vec3 moments = momentsPerMass(box);
  EXPECT_NEAR(moments.x(), (0.04 + 0.09) / 3.0, 1e-15);
  EXPECT_NEAR(moments.z(), (0.01 + 0.04) / 3.0, 1e-15);
  const ShapeMassOf<3> cylinder = massOf<3>({ShapeKind::cylinder, {{0, 0, -1}, {0, 0, 1}}, 0.5});
  EXPECT_NEAR(cylinder.measure, pi / 2.0, 1e-14);
  EXPECT_NEAR(momentsPerMass(cylinder).x(), 0.25 / 4.0 + 4.0 / 12.0, 1e-14);
  EXPECT_NEAR(momentsPerMass(cylinder).z(), 0.125, 1e-14);
  const ShapeMassOf<3> ball = massOf<3>({ShapeKind::capsule, {{0, 0, 0}}, 0.5});
  EXPECT_NEAR(momentsPerMass(ball).y(), 0.1, 1e-15);
  // A regular tetrahedron with edge a has a³/(6√2) and a²/20 about any axis.
  const ShapeMassOf<3> tetrahedron =
      massOf<3>({ShapeKind::polyhedron, {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, 0.0});
  EXPECT_NEAR(tetrahedron.measure, 8.0 / 3.0, 1e-14);
  EXPECT_NEAR(momentsPerMass(tetrahedron).x(), 8.0 / 20.0, 1e-14);
}

TEST(ShapeMass, RoundedBodiesAsPointsAtRandomHaveThem) {
  const ShapeOf<2> shape = regular(5, 0.4, 0.15);
  const ShapeMassOf<2> mass = massOf(shape);
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> unit(-0.55, 0.55);
  const ShapeOf<2> point{ShapeKind::capsule, {{0, 0}}, 0.0};
  double inside = 0.0, square = 0.0;
  constexpr int samples = 200'000;
  for (int k = 0; k < samples; ++k) {
    const Vec2 at(unit(generator), unit(generator));
    if (overlapOf<2>({&shape}, {&point, at}) < 0.0) continue;
    inside += 1.0;
    square += at.squaredNorm();
  }
  const double area = inside / samples * 1.21;
  EXPECT_NEAR(mass.measure, area, 4.0 * 1.21 * std::sqrt(0.25 / samples));
  EXPECT_NEAR(momentsPerMass(mass), square / inside, 0.002);
  // Its outline is chords of all that.
  double chords = 0.0;
  const std::vector<Vec2> outline = outlineOf(shape);
  for (std::size_t k = 0; k < outline.size(); ++k)
    chords += cross(outline[k], outline[(k + 1) % outline.size()]) / 2.0;
  EXPECT_NEAR(chords / mass.measure, 1.0, 5e-4);
  EXPECT_LT(chords, mass.measure);
}

TEST(ShapeFrame, OfAPolyhedronItsCentreAndPrincipalAxes) {
  // A box, turned and shifted, given by its corners.
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
  ShapeOf<3> shape = boxOf({0.1, 0.2, 0.35});
  shape.kind = ShapeKind::polyhedron;
  for (Vec3& vertex : shape.vertices) vertex = Vec3(3.0, -1.0, 2.0) + turn * vertex;
  const std::vector<Vec3> given = shape.vertices;
  const FrameOf<3> frame = intoOwnFrame(shape);
  EXPECT_NEAR((frame.centre - Vec3(3.0, -1.0, 2.0)).norm(), 0.0, 1e-14);
  EXPECT_NEAR(frame.axes.determinant(), 1.0, 1e-14);
  const ShapeMassOf<3> mass = massOf(shape);
  EXPECT_NEAR(mass.centre.norm(), 0.0, 1e-14);
  const Eigen::Matrix3d diagonal = mass.second.diagonal().asDiagonal();
  EXPECT_NEAR((mass.second - diagonal).norm(), 0.0, 1e-15);
  for (std::size_t k = 0; k < given.size(); ++k)
    EXPECT_NEAR((frame.centre + frame.axes * shape.vertices[k] - given[k]).norm(), 0.0, 1e-14);
}

TEST(ShapeOverlap, ByHand) {
  const ShapeOf<2> square{ShapeKind::polygon, {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, 0.0};
  EXPECT_NEAR(overlapOf<2>({&square}, {&square, {1.9, 0.3}}), 0.1, 1e-15);
  EXPECT_NEAR(overlapOf<2>({&square}, {&square, {2.3, 0.3}}), -0.3, 1e-15);
  EXPECT_NEAR(overlapOf<2>({&square}, {&square, {2.3, 2.4}}), -0.5, 1e-15);  // corner to corner
  // Turned by 45° its corner is √2 away.
  EXPECT_NEAR(overlapOf<2>({&square}, {&square, {2.5, 0.0}, pi / 4.0}), 1.0 + std::sqrt(2.0) - 2.5,
              1e-15);
  const ShapeOf<2> rounded{ShapeKind::polygon, square.vertices, 0.25};
  EXPECT_NEAR(overlapOf<2>({&rounded}, {&square, {2.3, 2.4}}), -0.25, 1e-15);
  EXPECT_NEAR(depthBehind<2>({&rounded, {0.0, 1.2}}, Vec2::Zero(), Vec2::UnitY()), 0.05, 1e-15);
  EXPECT_NEAR(depthBehind<2>({&square, {0.0, 1.5}, pi / 4.0}, Vec2::Zero(), Vec2::UnitY()),
              std::sqrt(2.0) - 1.5, 1e-15);
  const ShapeOf<3> box = boxOf({0.5, 0.5, 0.5});
  EXPECT_NEAR(overlapOf<3>({&box}, {&box, {0.1, 0.2, 0.9}}), 0.1, 1e-14);
  EXPECT_NEAR(overlapOf<3>({&box}, {&box, {1.3, 1.4, 0.2}}), -0.5, 1e-14);
  const ShapeOf<3> can{ShapeKind::cylinder, {{0, 0, -0.5}, {0, 0, 0.5}}, 0.5};
  const TurnOf<3> lying(std::sqrt(0.5), 0.0, std::sqrt(0.5), 0.0);  // its axis along x
  EXPECT_NEAR(depthBehind<3>({&can, {0.0, 0.0, 0.4}, lying}, Vec3::Zero(), Vec3::UnitZ()), 0.1,
              1e-15);
  EXPECT_NEAR(overlapOf<3>({&box}, {&can, {0.0, 0.0, 0.9}, lying}), 0.1, 0.0025);
  // A capsule's end beyond a corner of a box, and its middle across an edge.
  const ShapeOf<3> rod{ShapeKind::capsule, {{0, 0, -1}, {0, 0, 1}}, 0.25};
  EXPECT_NEAR(overlapOf<3>({&box}, {&rod, {0.8, 0.9, 1.9}}), 0.25 - std::sqrt(0.09 + 0.16 + 0.16),
              1e-14);
  EXPECT_NEAR(overlapOf<3>({&box}, {&rod, {0.8, 0.9, 0.3}}), 0.25 - 0.5, 1e-14);
  EXPECT_NEAR(overlapOf<3>({&box}, {&rod, {0.45, 0.0, 0.3}}), 0.25 + 0.05, 1e-14);  // through it
  const ShapeOf<3> ball{ShapeKind::capsule, {{0, 0, 0}}, 0.2};
  EXPECT_NEAR(overlapOf<3>({&ball, {0.0, 0.0, 0.6}}, {&box}), 0.1, 1e-14);
  ShapeOf<3> hull = box;
  hull.kind = ShapeKind::polyhedron;
  EXPECT_NEAR(overlapOf<3>({&hull}, {&can, {0.0, 0.0, 1.2}, lying}), -0.2, 0.0025);
}

TEST(ShapeFault, NamesWhatIsNoConvexBody) {
  const auto fault = [](std::vector<Vec2> vertices) {
    return shapeFault<2>({ShapeKind::polygon, std::move(vertices), 0.0});
  };
  EXPECT_EQ(fault({{0, 0}, {1, 0}, {1, 1}, {0, 1}}), "");
  EXPECT_EQ(fault({{0, 0}, {1, 0}}), "has 2 vertices; a polygon has three or more");
  EXPECT_EQ(fault({{0, 0}, {0, 1}, {1, 1}, {1, 0}}),
            "has its vertices clockwise; they are to be counter-clockwise");
  EXPECT_EQ(fault({{0, 0}, {1, 0}, {1, 0}, {0, 1}}), "has vertices 1 and 2 at one place");
  EXPECT_EQ(fault({{0, 0}, {1, 0}, {2, 0}}), "has no area");
  EXPECT_EQ(fault({{0, 0}, {2, 0}, {1, 0.5}, {2, 2}, {0, 2}}), "is not convex at vertex 2");
  EXPECT_EQ(fault({{0, 0}, {1, 0}, {2, 0}, {2, 2}}),
            "is straight at vertex 1, which is no corner: leave it out");
  std::vector<Vec2> star;
  for (int k = 0; k < 5; ++k) star.emplace_back(std::cos(0.8 * pi * k), std::sin(0.8 * pi * k));
  EXPECT_EQ(fault(star), "has an outline that crosses itself");
  const auto solid = [](std::vector<Vec3> vertices) {
    return shapeFault<3>({ShapeKind::polyhedron, std::move(vertices), 0.0});
  };
  EXPECT_EQ(solid(boxOf({1, 1, 1}).vertices), "");
  EXPECT_EQ(solid({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}), "has no volume");
  std::vector<Vec3> inner = boxOf({1, 1, 1}).vertices;
  inner.push_back({0.2, 0.1, 0.0});
  EXPECT_EQ(solid(inner), "is not convex, or flat, at vertex 8, which is no corner: leave it out");
  inner.back() = {0.0, 1.0, 1.0};  // on an edge
  EXPECT_EQ(solid(inner), "is not convex, or flat, at vertex 8, which is no corner: leave it out");
}

/// A square of side 1 on a plane, and one above it by a gap.
Scene twoSquares(double gap) {
  Scene scene;
  scene.shapes = {{ShapeKind::polygon, {{-.5, -.5}, {.5, -.5}, {.5, .5}, {-.5, .5}}, 0.0}};
  scene.disks.radius = {std::sqrt(0.5), std::sqrt(0.5)};
  scene.disks.mass = {1.0, 1.0};
  scene.disks.inertia = {1.0 / 6.0, 1.0 / 6.0};
  scene.disks.position = {{0.0, 0.5}, {0.0, 1.5 + gap}};
  scene.disks.velocity = {Vec2::Zero(), Vec2::Zero()};
  scene.disks.spin = {0.0, 0.0};
  scene.disks.shape = {0, 0};
  scene.disks.turn = {0.0, 0.0};
  scene.bodies.resize(1);
  scene.bodies[0].planes = {{Vec2::Zero(), Vec2::UnitY()}};
  scene.dt = 1e-3;
  return scene;
}

TEST(ConvexScene, StartsOverlapByTheirShapesAndNotByTheCirclesAround) {
  const auto limit = [](double, double) { return 0.0; };
  EXPECT_FALSE(deepStart<2>(twoSquares(1e-9), limit));
  const auto deep = deepStart<2>(twoSquares(-0.01), limit);
  ASSERT_TRUE(deep);
  EXPECT_NEAR(deep->overlap, 0.01, 1e-12);
  Scene sunk = twoSquares(0.3);
  sunk.disks.turn[0] = pi / 4.0;  // a corner below
  EXPECT_NEAR(deepStart<2>(sunk, limit)->overlap, std::sqrt(0.5) - 0.5, 1e-12);
  EXPECT_EQ(nameOfId(sunk, 1), "polygon 1");
}

/// Of a body that is thin and long, the length says nothing of how deep it may be.
TEST(ConvexScene, StartsAreMeasuredByTheThinnestOfTheirBodies) {
  Scene thin = twoSquares(0.3);
  thin.shapes[0].vertices = {{-0.5, -0.01}, {0.5, -0.01}, {0.5, 0.01}, {-0.5, 0.01}};
  thin.disks.position[0] = {0.0, -0.02};  // its centre is behind the plane
  const auto deep = deepStart<2>(thin, [](double a, double b) { return 0.2 * std::min(a, b); });
  ASSERT_TRUE(deep);
  EXPECT_NEAR(deep->overlap, 0.03, 1e-12);
  EXPECT_NEAR(deep->allowed, 0.2 * 0.01, 1e-12);
  EXPECT_NE(startFault<2>(thin).find("a centre lies inside"), std::string::npos);
}

TEST(ConvexScene, ContactsOutsideOfTheirBodiesAreFaults) {
  const Scene scene = twoSquares(0.0);
  AuditBasis basis = auditBasis(scene);
  basis.dt = 1e-3;
  basis.byOverlap = false;
  Snapshot now;
  now.contactInterval = 1e-3;
  now.position = scene.disks.position;
  now.velocity = scene.disks.velocity;
  now.spin = scene.disks.spin;
  now.turn = scene.disks.turn;
  now.bodies.resize(1);
  Contacts& contacts = now.contacts.emplace();
  contacts.i = {0};
  contacts.j = {1};
  contacts.normal = {-Vec2::UnitY()};
  contacts.overlap = {0.0};
  contacts.normalForce = {10.0};
  contacts.tangentialForce = {0.0};
  EXPECT_EQ(auditFault(now, basis), "its contacts have no points");
  contacts.point = {{0.4, 1.0}};
  EXPECT_EQ(auditFault(now, basis), "");
  contacts.point = {{0.7, 1.0}};  // the circles around hold it
  EXPECT_EQ(auditFault(now, basis),
            "contact 0 (polygon 0 with polygon 1): its point is 0.2 m outside of polygon 0");
  now.turn.reset();
  EXPECT_EQ(auditFault(now, basis), "0 orientations are shown, not 2");
}

}  // namespace
}  // namespace crossgrain
