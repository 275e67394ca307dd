#include "engines/box2d/world.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace box2d_granular {
namespace {

// A box whose upper face is the plane. Its normals are written as they are, not through an angle,
// and its skin (b2_polygonRadius, twice the slop) is taken off: a disk touches at its radius.
b2PolygonShape halfPlane(b2Vec2 point, b2Vec2 normal, float reach) {
  const b2Vec2 along(normal.y, -normal.x);
  const b2Vec2 depth = 2.0f * reach * normal;
  b2PolygonShape box;
  box.m_count = 4;
  box.m_vertices[0] = point - reach * along - depth;
  box.m_vertices[1] = point + reach * along - depth;
  box.m_vertices[2] = point + reach * along;
  box.m_vertices[3] = point - reach * along;
  box.m_normals[0] = -normal;
  box.m_normals[1] = along;
  box.m_normals[2] = normal;
  box.m_normals[3] = -along;
  box.m_centroid = point - 0.5f * depth;
  box.m_radius = 0.0f;
  return box;
}

}  // namespace

World::World(const Model& model, double skin)
    : unit_(model.lengthUnit), skin_(skin), world_(toUnits(model.gravity)) {
  world_.SetAllowSleeping(false);
  world_.SetContinuousPhysics(false);

  std::size_t wallDisks = 0;
  for (const Wall& wall : model.walls) wallDisks += wall.diskRadius.size();
  std::size_t nextDisk = model.disks.size();
  std::size_t nextPlane = nextDisk + wallDisks;
  // Walls come first: of two shapes Box2D searches the contacts of the younger one's body, and a
  // wall has hundreds.
  for (const Wall& wall : model.walls) {
    addWall(wall, extentOf(model), nextDisk, nextPlane);
    nextDisk += wall.diskRadius.size();
    nextPlane += wall.planes.size();
  }
  for (std::size_t i = 0; i < model.disks.size(); ++i) addDisk(model.disks[i], model.rotation, i);
}

void World::addWall(const Wall& wall, double extent, std::size_t firstDisk,
                    std::size_t firstPlane) {
  const Vector centre = wall.pose(0.0).centre;
  b2BodyDef def;
  def.type = wall.moves ? b2_kinematicBody : b2_staticBody;
  def.position = toUnits(centre);
  def.allowSleep = false;
  b2Body& body = *world_.CreateBody(&def);
  walls_.push_back(&body);
  for (std::size_t k = 0; k < wall.diskRadius.size(); ++k) {
    b2CircleShape shape;
    shape.m_p = toUnits(wall.diskPosition[k] - centre);
    shape.m_radius = static_cast<float>((wall.diskRadius[k] + skin_) / unit_);
    addFixture(body, shape, firstDisk + k);
  }
  for (std::size_t k = 0; k < wall.planes.size(); ++k) {
    const Plane& plane = wall.planes[k];
    const b2Vec2 normal(static_cast<float>(plane.normal.x), static_cast<float>(plane.normal.y));
    const auto reach = static_cast<float>(16.0 * extent / unit_);
    addFixture(body, halfPlane(toUnits(plane.point - centre), normal, reach), firstPlane + k);
  }
}

void World::addDisk(const Disk& disk, bool rotation, std::size_t id) {
  b2BodyDef def;
  def.type = b2_dynamicBody;
  def.position = toUnits(disk.position);
  def.linearVelocity = toUnits(disk.velocity);
  def.angularVelocity = static_cast<float>(disk.spin);
  def.fixedRotation = !rotation;
  def.allowSleep = false;
  b2Body& body = *world_.CreateBody(&def);
  disks_.push_back(&body);

  b2CircleShape shape;
  shape.m_radius = static_cast<float>((disk.radius + skin_) / unit_);
  addFixture(body, shape, id);

  b2MassData data;
  data.mass = static_cast<float>(disk.mass);
  data.center.SetZero();
  data.I = static_cast<float>(disk.inertia / (unit_ * unit_));
  body.SetMassData(&data);
}

void World::addFixture(b2Body& body, const b2Shape& shape, std::size_t id) {
  b2FixtureDef def;
  def.shape = &shape;
  def.userData.pointer = id;
  body.CreateFixture(&def);
}

void World::placeWall(std::size_t w, const Pose& pose) {
  const double angle = std::remainder(pose.angle, 2.0 * std::numbers::pi);
  walls_[w]->SetTransform(toUnits(pose.centre), static_cast<float>(angle));
}

double extentOf(const Model& model) {
  double extent = 0.0;
  const auto include = [&](Vector v, double radius) {
    extent = std::max({extent, std::abs(v.x) + radius, std::abs(v.y) + radius});
  };
  for (const Disk& disk : model.disks) include(disk.position, disk.radius);
  for (const Wall& wall : model.walls) {
    for (std::size_t k = 0; k < wall.diskRadius.size(); ++k)
      include(wall.diskPosition[k], wall.diskRadius[k]);
    for (const Plane& plane : wall.planes) include(plane.point, 0.0);
  }
  return extent;
}

double roundingAt(double extent) {
  return std::ldexp(1.0, std::ilogb(extent) - 24);
}

}  // namespace box2d_granular
