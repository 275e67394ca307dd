#pragma once

#include <box2d/box2d.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "engines/box2d/model.hpp"

namespace box2d_granular {

/// A Box2D world that holds a model: one dynamic body for each disk, with mass and inertia set by
/// hand, one body for each wall. Walls that move are kinematic bodies; fixed ones are static, which
/// spares Box2D to follow each of their fixtures. Walls never touch each other.
///
/// Box2D's constants are in its length unit (b2_linearSlop 0.005, b2_aabbExtension 0.1,
/// b2_maxTranslation 2 a step), so the model says how long that unit is. Sleep and continuous
/// collision are off.
class World {
 public:
  /// @param skin  added to the radius of every disk's shape [m]
  World(const Model& model, double skin);

  b2World& box2d() { return world_; }
  b2Body& disk(std::size_t i) { return *disks_[i]; }
  const b2Body& disk(std::size_t i) const { return *disks_[i]; }
  b2Body& wall(std::size_t w) { return *walls_[w]; }

  b2Vec2 toUnits(Vector v) const {
    return {static_cast<float>(v.x / unit_), static_cast<float>(v.y / unit_)};
  }
  Vector toMetres(b2Vec2 v) const {
    return {static_cast<double>(v.x) * unit_, static_cast<double>(v.y) * unit_};
  }

  /// Position and angle of a wall; the angle is wrapped so that float32 keeps resolving it.
  void placeWall(std::size_t w, const Pose& pose);

  /// The model's id of a shape.
  static std::int32_t id(b2Fixture* fixture) {
    return static_cast<std::int32_t>(fixture->GetUserData().pointer);
  }

 private:
  void addWall(const Wall& wall, double extent, std::size_t firstDisk, std::size_t firstPlane);
  void addDisk(const Disk& disk, bool rotation, std::size_t id);
  void addFixture(b2Body& body, const b2Shape& shape, std::size_t id);

  double unit_, skin_;
  b2World world_;
  std::vector<b2Body*> disks_, walls_;  // owned by world_
};

/// The farthest coordinate that occurs in a model [m].
double extentOf(const Model& model);

/// Half the distance between neighbouring float32 at that coordinate: how far rounding moves a
/// position [m].
double roundingAt(double extent);

}  // namespace box2d_granular
