// Space has no preferred place, direction or handedness, and no disk is another for its number.
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

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

/// Disks that each meet a wall disk of their own: whoever resolves contacts one after the other,
/// or several at once, has nothing to choose.
Scene landings(const ContactLaw& law) {
  constexpr int count = 12;
  constexpr double apart = 6.0 * smallRadius;
  Scene scene = emptyScene(law, 50.0);
  std::vector<Vec2> posts;
  for (int k = 0; k < count; ++k) {
    const Vec2 post = {apart * (k % 4), apart * (k / 4)};
    const double angle = 0.4 + 0.15 * k;
    posts.push_back(post);
    addDisk(scene, smallRadius, smallMass,
            post + (2.0 * smallRadius + Encounter::gap) * Vec2(std::cos(angle), std::sin(angle)),
            Encounter::speed * Vec2(-std::cos(angle), -std::sin(angle)), 3.0 * k - 15.0);
  }
  scene.bodies = {wallOf("posts", Vec2::Zero(), posts)};
  return scene;
}

Scene backwards(Scene scene) {
  for (auto* const each :
       {&scene.disks.radius, &scene.disks.mass, &scene.disks.inertia, &scene.disks.spin})
    std::ranges::reverse(*each);
  std::ranges::reverse(scene.disks.position);
  std::ranges::reverse(scene.disks.velocity);
  return scene;
}

/// Force of the one contact that each disk has, by its number: n f_n, f_t and no more.
std::map<std::size_t, Vec2> forces(const Snapshot& now) {
  std::map<std::size_t, Vec2> force;
  for (std::size_t c = 0; now.contacts && c < now.contacts->size(); ++c)
    force[static_cast<std::size_t>(now.contacts->i[c])] =
        now.contacts->normalForce[c] * now.contacts->normal[c] +
        now.contacts->tangentialForce[c] * perpendicular(now.contacts->normal[c]);
  return force;
}

void renumberedSceneGivesTheRenumberedResult(Exam& it) {
  const Scene scene = landings(it.law()), other = backwards(scene);
  it.load(scene);
  const std::vector<Snapshot> original = it.watch(Encounter::end);
  it.load(other);
  const std::vector<Snapshot> renumbered = it.watch(Encounter::end);
  it.requireEqual(renumbered.size(), original.size(), "the number of steps");
  const Tolerance relative = it.byPrecision(1e-9, 1e-4, rounding);
  const std::size_t last = scene.disks.size() - 1;
  double largest = 0.0;
  for (const Snapshot& now : original)
    for (const auto& [disk, force] : forces(now)) largest = std::max(largest, force.norm());
  const auto in = [&](double unit) {
    return Tolerance{relative.relative * unit, 0.0, relative.why};
  };
  for (std::size_t k = 0; k < original.size(); ++k) {
    const Snapshot &one = original[k], &two = renumbered[k];
    const std::vector<double> spins = spinsOf(scene, one), otherSpins = spinsOf(other, two);
    std::map<std::size_t, Vec2> force = forces(one), otherForce = forces(two);
    it.requireEqual(otherForce.size(), force.size(), "the number of contacts");
    for (std::size_t i = 0; i <= last; ++i) {
      const std::string disk = said(" of disk ", i, " numbered ", last - i);
      it.expect(close(two.position[last - i], one.position[i], in(smallRadius)),
                "the position [m]" + disk);
      it.expect(close(two.velocity[last - i], one.velocity[i], in(Encounter::speed)),
                "the velocity [m/s]" + disk);
      it.expect(close(otherSpins[last - i], spins[i], in(Encounter::speed / smallRadius)),
                "the spin [rad/s]" + disk);
      if (force.contains(i))
        it.expect(close(otherForce[last - i], force[i], in(largest)), "the force [N]" + disk);
    }
  }
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
      Check{"RenumberedSceneGivesTheRenumberedResult",
            "disks numbered otherwise do the same: none is another for its number",
            renumberedSceneGivesTheRenumberedResult},
  };
  return list;
}

}  // namespace crossgrain::conformance::symmetry
