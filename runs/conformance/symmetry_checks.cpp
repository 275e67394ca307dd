// Space has no preferred place, direction or handedness.
#include "runs/conformance/check_list.hpp"
#include "runs/conformance/exam.hpp"

namespace crossgrain::conformance::symmetry {
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
void expectImage(Exam& it, const Snapshot& image, const Isometry& map, const Scene& scene,
                 const Snapshot& original, const Tolerance& relative) {
  const auto in = [&](double unit) {
    return Tolerance{relative.relative * unit, 0.0, relative.why};
  };
  for (std::size_t i = 0; i < scene.disks.size(); ++i) {
    it.expect(close(image.position[i], map.point(original.position[i]), in(smallRadius)),
              "a position [m]");
    it.expect(close(image.velocity[i], map.vector(original.velocity[i]), in(Encounter::speed)),
              "a velocity [m/s]");
    it.expect(close(spinsOf(mapped(scene, map), image)[i], map.spin(spinsOf(scene, original)[i]),
                    in(Encounter::speed / smallRadius)),
              "a spin [rad/s]");
  }
}

const Isometry shifted{{0.0213, -0.0171}, Eigen::Matrix2d::Identity()};
const Isometry mirrored{Vec2::Zero(), Eigen::Vector2d(-1.0, 1.0).asDiagonal()};
const Isometry rotated{Vec2::Zero(), (Eigen::Matrix2d() << 0.0, -1.0, 1.0, 0.0).finished()};

constexpr const char* rounding = "rounding of the positions, which the stiff contact magnifies";

void shiftedSceneGivesTheShiftedResult(Exam& it) {
  const Scene scene = encounterScene(crookedEncounter(), it.law(), 50.0);
  it.load(scene);
  const Snapshot original = it.at(Encounter::end);
  it.load(mapped(scene, shifted));
  expectImage(it, it.at(Encounter::end), shifted, scene, original,
              it.byPrecision(1e-9, 1e-4, rounding));
}

void mirroredSceneGivesTheMirroredResult(Exam& it) {
  const Scene scene = encounterScene(crookedEncounter(), it.law(), 50.0);
  it.load(scene);
  const Snapshot original = it.at(Encounter::end);
  it.load(mapped(scene, mirrored));
  expectImage(it, it.at(Encounter::end), mirrored, scene, original,
              it.byPrecision(1e-9, 1e-4, rounding));
}

void rotatedSceneGivesTheRotatedResult(Exam& it) {
  const Scene scene = encounterScene(crookedEncounter(), it.law(), 50.0);
  it.load(scene);
  const Snapshot original = it.at(Encounter::end);
  it.load(mapped(scene, rotated));
  expectImage(it, it.at(Encounter::end), rotated, scene, original,
              it.byPrecision(1e-9, 1e-4, rounding));
}

}  // namespace
std::span<const Check> checks() {
  static constexpr std::array list = {
      Check{"ShiftedSceneGivesTheShiftedResult", "a shifted scene gives the shifted result",
            shiftedSceneGivesTheShiftedResult},
      Check{"MirroredSceneGivesTheMirroredResult", "a mirrored scene gives the mirrored result",
            mirroredSceneGivesTheMirroredResult},
      Check{"RotatedSceneGivesTheRotatedResult", "a turned scene gives the turned result",
            rotatedSceneGivesTheRotatedResult},
  };
  return list;
}

}  // namespace crossgrain::conformance::symmetry
