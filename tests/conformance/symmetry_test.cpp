// Space has no preferred place, direction or handedness.
#include "tests/conformance/conformance.hpp"

namespace crossgrain::test {
namespace {

/// A map of the plane onto itself that keeps lengths.
struct Isometry {
  Vec2 shift = Vec2::Zero();
  Eigen::Matrix2d turn = Eigen::Matrix2d::Identity();

  Vec2 point(const Vec2& x) const { return turn * x + shift; }
  Vec2 vector(const Vec2& v) const { return turn * v; }
  double spin(double omega) const { return cross(turn.col(0), turn.col(1)) * omega; }
};

Scene mapped(Scene scene, const Isometry& map) {
  for (std::size_t i = 0; i < scene.disks.size(); ++i) {
    scene.disks.position[i] = map.point(scene.disks.position[i]);
    scene.disks.velocity[i] = map.vector(scene.disks.velocity[i]);
    scene.disks.spin[i] = map.spin(scene.disks.spin[i]);
  }
  return scene;
}

/// What became of the mapped scene is the image of what became of the scene.
void expectImage(const Snapshot& image, const Isometry& map, const Scene& scene,
                 const Snapshot& original, const Tolerance& relative) {
  const auto in = [&](double unit) {
    return Tolerance{relative.relative * unit, 0.0, relative.why};
  };
  for (std::size_t i = 0; i < scene.disks.size(); ++i) {
    EXPECT_TRUE(close(image.position[i], map.point(original.position[i]), in(smallRadius)));
    EXPECT_TRUE(close(image.velocity[i], map.vector(original.velocity[i]), in(Encounter::speed)));
    EXPECT_TRUE(close(spinsOf(mapped(scene, map), image)[i], map.spin(spinsOf(scene, original)[i]),
                      in(Encounter::speed / smallRadius)));
  }
}

const Isometry shifted{{0.0213, -0.0171}, Eigen::Matrix2d::Identity()};
const Isometry mirrored{Vec2::Zero(), Eigen::Vector2d(-1.0, 1.0).asDiagonal()};
const Isometry rotated{Vec2::Zero(), (Eigen::Matrix2d() << 0.0, -1.0, 1.0, 0.0).finished()};

constexpr const char* rounding = "rounding of the positions, which the stiff contact magnifies";

TEST_P(Conformance, ShiftedSceneGivesTheShiftedResult) {
  const Scene scene = encounterScene(crookedEncounter(), law(), 50.0);
  if (const auto why = refused(scene)) GTEST_SKIP() << *why;
  const Snapshot original = at(Encounter::end);
  ASSERT_FALSE(refused(mapped(scene, shifted)));
  expectImage(at(Encounter::end), shifted, scene, original, byPrecision(1e-9, 1e-4, rounding));
}

TEST_P(Conformance, MirroredSceneGivesTheMirroredResult) {
  const Scene scene = encounterScene(crookedEncounter(), law(), 50.0);
  if (const auto why = refused(scene)) GTEST_SKIP() << *why;
  const Snapshot original = at(Encounter::end);
  ASSERT_FALSE(refused(mapped(scene, mirrored)));
  expectImage(at(Encounter::end), mirrored, scene, original, byPrecision(1e-9, 1e-4, rounding));
}

TEST_P(Conformance, RotatedSceneGivesTheRotatedResult) {
  const Scene scene = encounterScene(crookedEncounter(), law(), 50.0);
  if (const auto why = refused(scene)) GTEST_SKIP() << *why;
  const Snapshot original = at(Encounter::end);
  ASSERT_FALSE(refused(mapped(scene, rotated)));
  expectImage(at(Encounter::end), rotated, scene, original, byPrecision(1e-9, 1e-4, rounding));
}

}  // namespace
}  // namespace crossgrain::test
