#include "adapters/box2d_common.hpp"

#include <box2d/b2_common.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace crossgrain {
namespace {

box2d_granular::Vector toVector(const Vec2& v) {
  return {v.x(), v.y()};
}

double defaultLengthUnit(const Disks& disks) {
  if (disks.size() == 0) return 1.0;
  return std::exp2(std::round(std::log2(*std::ranges::min_element(disks.radius) / 5.0)));
}

box2d_granular::Wall box2dWall(const WallBody& body) {
  if (body.motion.kind == Motion::Kind::radial)
    throw UnsupportedScene(fmt::format(
        "has rigid walls only; '{}' moves radially (fixed, rotating, translating and oscillating "
        "walls are possible)",
        body.name));
  box2d_granular::Wall wall;
  for (const Vec2& position : body.diskPosition) wall.diskPosition.push_back(toVector(position));
  wall.diskRadius = body.diskRadius;
  for (const Plane& plane : body.planes)
    wall.planes.push_back({toVector(plane.point), toVector(plane.normal.normalized())});
  wall.moves = body.motion.kind != Motion::Kind::fixed;
  wall.pose = [motion = body.motion, centre = body.centre](double t) -> box2d_granular::Pose {
    const BodyState now = stateAt(motion, centre, t);
    return {toVector(now.centre), now.angle, toVector(now.velocity), now.angularVelocity};
  };
  return wall;
}

}  // namespace

std::string box2dVersion() {
  const std::string installed = CROSSGRAIN_BOX2D_VERSION;
  const std::string says =
      fmt::format("{}.{}.{}", b2_version.major, b2_version.minor, b2_version.revision);
  return says == installed ? installed : fmt::format("{}, b2_version {}", installed, says);
}

SceneLimits box2dLimits() {
  using enum Motion::Kind;
  const std::vector<Motion::Kind> rigid = {fixed, rotating, translating, oscillating};
  SceneLimits limits;
  limits.wallMotions = limits.planeMotions = rigid;
  return limits;
}

SettingSpec lengthUnitSetting() {
  return {"length_unit", 0.0, "m",
          "Box2D's unit of length, in which its constants are; 0: the power of two nearest to a "
          "fifth of the smallest radius"};
}

double numberSetting(const Settings& settings, const std::vector<SettingSpec>& specs,
                     const std::string& name) {
  for (const auto& [given, value] : settings) {
    if (std::ranges::find(specs, given, &SettingSpec::name) == specs.end())
      throw std::invalid_argument(fmt::format("no setting '{}'", given));
    if (!std::holds_alternative<double>(value))
      throw std::invalid_argument(fmt::format("setting '{}' must be a number", given));
  }
  const auto given = settings.find(name);
  if (given != settings.end()) return std::get<double>(given->second);
  return std::get<double>(std::ranges::find(specs, name, &SettingSpec::name)->defaultValue);
}

box2d_granular::Model box2dModel(const Scene& scene, double dt, double lengthUnit) {
  if (!(dt > 0.0)) throw std::invalid_argument(fmt::format("dt must be > 0 s, not {}", dt));
  // Box2D's bodies are of floats also where its own motion is not used.
  if (const std::string why = beyondSinglePrecision(scene); !why.empty())
    throw UnsupportedScene(why);
  box2d_granular::Model model;
  for (std::size_t i = 0; i < scene.disks.size(); ++i) {
    model.disks.push_back({scene.disks.radius[i], scene.disks.mass[i], scene.disks.inertia[i],
                           toVector(scene.disks.position[i]), toVector(scene.disks.velocity[i]),
                           scene.disks.spin[i]});
    if (!scene.isConvex(i)) continue;
    const ShapeOf<2>& shape = scene.shapeOf(i);
    box2d_granular::Disk& body = model.disks.back();
    for (const Vec2& vertex : shape.vertices) body.vertices.push_back(toVector(vertex));
    body.rounding = shape.rounding;
    body.turn = scene.disks.turn[i];
  }
  for (const WallBody& body : scene.bodies) model.walls.push_back(box2dWall(body));
  model.gravity = toVector(scene.gravity);
  model.rotation = effectsOf(scene).contains(Effect::rotation);
  model.dt = dt;
  model.lengthUnit = lengthUnit > 0.0 ? lengthUnit : defaultLengthUnit(scene.disks);
  // Far from a disk's size its constants, a slop of 0.005 units and no step longer than 2, mean
  // nothing, and floats leave their range.
  if (lengthUnit > 0.0 && scene.disks.size() > 0) {
    const double radius = std::ranges::min(scene.disks.radius);
    const double least = 1e-3 * radius, most = 1e3 * radius;
    if (lengthUnit < least || lengthUnit > most)
      throw UnsupportedScene(
          fmt::format("takes length_unit = 0, or from {:.3g} to {:.3g} m here (0.001 to 1000 of "
                      "the smallest radius), not {:g}",
                      least, most, lengthUnit));
  }
  return model;
}

Snapshot kinematicSnapshot(const box2d_granular::Members& members, double time, bool spins) {
  Snapshot snapshot;
  snapshot.positionTime = snapshot.velocityTime = snapshot.contactTime = time;
  for (std::size_t i = 0; i < members.disks; ++i) {
    snapshot.position.push_back(toVec2(members.position[i]));
    snapshot.velocity.push_back(toVec2(members.velocity[i]));
  }
  if (!members.turn.empty()) snapshot.turn = members.turn;
  if (spins) snapshot.spin.emplace(members.spin.begin(), members.spin.begin() + members.disks);
  for (std::size_t i = members.disks; i < members.position.size(); ++i)
    snapshot.wallPosition.push_back(toVec2(members.position[i]));
  for (const box2d_granular::Pose& pose : members.pose)
    snapshot.bodies.push_back({toVec2(pose.centre), pose.angle, toVec2(pose.velocity), pose.spin,
                               std::nullopt, std::nullopt});
  return snapshot;
}

}  // namespace crossgrain
