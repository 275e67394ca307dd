#pragma once

#include <box2d/box2d.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "engines/box2d/model.hpp"

namespace box2d_granular {

/// A Box2D world that holds a model: one dynamic body for each disk or convex body, with mass and
/// inertia set by hand, one body for each wall's disks and for each plane. Walls that move are
/// kinematic bodies; fixed ones are static, which spares Box2D to follow each of their fixtures.
/// Walls never touch each other.
///
/// Planes are infinite: each is one side of a box that stays before the disks that could touch it,
/// whatever the way that they or a wall go, and is as long as they are far apart.
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

  b2Vec2 toUnits(Vector v) const {
    return {static_cast<float>(v.x / unit_), static_cast<float>(v.y / unit_)};
  }
  Vector toMetres(b2Vec2 v) const {
    return {static_cast<double>(v.x) * unit_, static_cast<double>(v.y) * unit_};
  }

  /// Position and angle of a wall; the angle is wrapped so that float32 keeps resolving it.
  void placeWall(std::size_t w, const Pose& pose);
  /// Its velocities, for Box2D's next step; its place is that of the last placeWall().
  void moveWall(std::size_t w, Vector velocity, double spin);
  /// Before each step: planes are to reach as far as the disks do.
  void coverPlanes();

  /// The model's id of a shape.
  static std::int32_t id(b2Fixture* fixture) {
    return static_cast<std::int32_t>(fixture->GetUserData().pointer);
  }

 private:
  struct PlaneBody {
    b2Body* body;
    b2PolygonShape* shape;
    std::size_t wall;
    Plane start;  ///< at t = 0
    Plane now;    ///< its point is the middle of the box's face
    double half;  ///< length of the face [m]
  };
  void addWall(const Wall& wall, std::size_t firstDisk);
  void addPlane(const Plane& plane, std::size_t wall, bool moves, std::size_t id);
  void addDisk(const Disk& disk, const Model& model, std::size_t id);
  void addPolygon(b2Body& body, const std::vector<Vector>& vertices, double skin, std::size_t id);
  void addCircle(b2Body& body, Vector at, double radius, std::size_t id);
  b2Fixture* addFixture(b2Body& body, const b2Shape& shape, std::size_t id);
  void place(PlaneBody& plane);

  double unit_, skin_;
  double farthest_;  ///< extentOf() the model [m]
  b2World world_;
  std::vector<b2Body*> disks_, walls_;  // owned by world_
  std::vector<PlaneBody> planes_;
  std::vector<Vector> start_;   ///< centres of walls at t = 0
  std::vector<Pose> pose_;      ///< as placed last
  std::vector<double> radius_;  ///< of the disks' shapes [m]
};

/// The farthest coordinate that occurs in a model [m].
double extentOf(const Model& model);

/// Half the distance between neighbouring float32 at that coordinate: how far rounding moves a
/// position [m].
double roundingAt(double extent);

}  // namespace box2d_granular
