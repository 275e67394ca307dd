#include "engines/box2d/world.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace box2d_granular {
namespace {

// A box whose upper face is the plane, through the body's centre. Its normals are written as they
// are, not through an angle, and its skin (b2_polygonRadius, twice the slop) is taken off: a disk
// touches at its radius.
b2PolygonShape halfPlane(b2Vec2 normal, float reach) {
  const b2Vec2 along(normal.y, -normal.x);
  const b2Vec2 depth = 2.0f * reach * normal;
  b2PolygonShape box;
  box.m_count = 4;
  box.m_vertices[0] = -reach * along - depth;
  box.m_vertices[1] = reach * along - depth;
  box.m_vertices[2] = reach * along;
  box.m_vertices[3] = -reach * along;
  box.m_normals[0] = -normal;
  box.m_normals[1] = along;
  box.m_normals[2] = normal;
  box.m_normals[3] = -along;
  box.m_centroid = -0.5f * depth;
  box.m_radius = 0.0f;
  return box;
}

b2Vec2 direction(Vector v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y)};
}

float wrapped(double angle) {
  return static_cast<float>(std::remainder(angle, 2.0 * std::numbers::pi));
}

}  // namespace

World::World(const Model& model, double skin)
    : unit_(model.lengthUnit),
      skin_(skin),
      farthest_(extentOf(model)),
      world_(toUnits(model.gravity)) {
  world_.SetAllowSleeping(false);
  world_.SetContinuousPhysics(false);

  std::size_t wallDisks = 0;
  for (const Wall& wall : model.walls) wallDisks += wall.diskRadius.size();
  std::size_t nextDisk = model.disks.size();
  std::size_t nextPlane = nextDisk + wallDisks;
  // Walls come first: of two shapes Box2D searches the contacts of the younger one's body, and a
  // wall has hundreds.
  for (std::size_t w = 0; w < model.walls.size(); ++w) {
    const Wall& wall = model.walls[w];
    addWall(wall, nextDisk);
    nextDisk += wall.diskRadius.size();
    for (const Plane& plane : wall.planes) addPlane(plane, w, wall.moves, nextPlane++);
  }
  for (std::size_t i = 0; i < model.disks.size(); ++i) addDisk(model.disks[i], model, i);
  coverPlanes();
}

void World::addWall(const Wall& wall, std::size_t firstDisk) {
  pose_.push_back(wall.pose(0.0));
  const Vector centre = pose_.back().centre;
  start_.push_back(centre);
  b2BodyDef def;
  def.type = wall.moves ? b2_kinematicBody : b2_staticBody;
  def.position = toUnits(centre);
  def.allowSleep = false;
  b2Body& body = *world_.CreateBody(&def);
  walls_.push_back(&body);
  for (std::size_t k = 0; k < wall.diskRadius.size(); ++k)
    addCircle(body, wall.diskPosition[k] - centre, wall.diskRadius[k] + skin_, firstDisk + k);
}

void World::addPlane(const Plane& plane, std::size_t wall, bool moves, std::size_t id) {
  b2BodyDef def;
  def.type = moves ? b2_kinematicBody : b2_staticBody;
  def.position = toUnits(plane.point);
  def.allowSleep = false;
  b2Body& body = *world_.CreateBody(&def);
  const double half = 2.0 * farthest_;
  b2Fixture* const fixture =
      addFixture(body, halfPlane(direction(plane.normal), static_cast<float>(half / unit_)), id);
  planes_.push_back(
      {&body, static_cast<b2PolygonShape*>(fixture->GetShape()), wall, plane, plane, half});
}

void World::addDisk(const Disk& disk, const Model& model, std::size_t id) {
  b2BodyDef def;
  def.type = b2_dynamicBody;
  def.position = toUnits(disk.position);
  def.linearVelocity = toUnits(disk.velocity);
  def.angle = wrapped(disk.turn);
  def.angularVelocity = static_cast<float>(disk.spin);
  def.fixedRotation = !model.rotation;
  def.allowSleep = false;
  b2Body& body = *world_.CreateBody(&def);
  disks_.push_back(&body);
  radius_.push_back(disk.radius + skin_);

  if (disk.vertices.empty()) {
    addCircle(body, {}, disk.radius + skin_, id);
  } else if (disk.rounding > 0.0) {
    // A capsule is what its ends and the rectangle between them cover, whose corners stand out
    // nowhere; Box2D 2.4 has none of its own.
    const Vector middle = 0.5 * (disk.vertices[1] - disk.vertices[0]);
    const double length = std::hypot(middle.x, middle.y);
    const Vector aside = (disk.rounding / length) * turned(middle);
    for (const Vector& end : disk.vertices) addCircle(body, end, disk.rounding, id);
    const Vector a = disk.vertices[0], b = disk.vertices[1];
    addPolygon(body, {a - aside, b - aside, b + aside, a + aside}, 0.0, id);
  } else {
    addPolygon(body, disk.vertices, model.skin, id);
  }

  b2MassData data;
  data.mass = static_cast<float>(disk.mass);
  data.center.SetZero();
  data.I = static_cast<float>(disk.inertia / (unit_ * unit_));
  body.SetMassData(&data);
}

/// Vertices are written as they are: b2PolygonShape::Set() would weld those nearer than half a slop
/// and turn their order.
/// @param skin  of b2_polygonRadius
void World::addPolygon(b2Body& body, const std::vector<Vector>& vertices, double skin,
                       std::size_t id) {
  b2PolygonShape shape;
  shape.m_count = static_cast<int32>(vertices.size());
  for (int32 k = 0; k < shape.m_count; ++k)
    shape.m_vertices[k] = toUnits(vertices[static_cast<std::size_t>(k)]);
  for (int32 k = 0; k < shape.m_count; ++k) {
    const b2Vec2 along = shape.m_vertices[(k + 1) % shape.m_count] - shape.m_vertices[k];
    shape.m_normals[k] = b2Cross(along, 1.0f);
    shape.m_normals[k].Normalize();
  }
  shape.m_radius = static_cast<float>(skin) * b2_polygonRadius;
  addFixture(body, shape, id);
}

void World::addCircle(b2Body& body, Vector at, double radius, std::size_t id) {
  b2CircleShape shape;
  shape.m_p = toUnits(at);
  shape.m_radius = static_cast<float>(radius / unit_);
  addFixture(body, shape, id);
}

b2Fixture* World::addFixture(b2Body& body, const b2Shape& shape, std::size_t id) {
  b2FixtureDef def;
  def.shape = &shape;
  def.userData.pointer = id;
  return body.CreateFixture(&def);
}

void World::placeWall(std::size_t w, const Pose& pose) {
  pose_[w] = pose;
  walls_[w]->SetTransform(toUnits(pose.centre), wrapped(pose.angle));
  for (PlaneBody& plane : planes_) {
    if (plane.wall != w) continue;
    const Vector point = pose.centre + turned(pose.angle, plane.start.point - start_[w]);
    plane.now.normal = turned(pose.angle, plane.start.normal);
    const Vector aside = plane.now.point - point;
    plane.now.point = plane.now.point - dot(aside, plane.now.normal) * plane.now.normal;
    place(plane);
  }
}

void World::place(PlaneBody& plane) {
  plane.body->SetTransform(toUnits(plane.now.point), wrapped(pose_[plane.wall].angle));
}

void World::moveWall(std::size_t w, Vector velocity, double spin) {
  const auto move = [&](b2Body& body, Vector at) {
    body.SetLinearVelocity(toUnits(velocity + spin * turned(at - pose_[w].centre)));
    body.SetAngularVelocity(static_cast<float>(spin));
  };
  move(*walls_[w], pose_[w].centre);
  for (const PlaneBody& plane : planes_)
    if (plane.wall == w) move(*plane.body, plane.now.point);
}

void World::coverPlanes() {
  for (PlaneBody& plane : planes_) {
    const Vector along{plane.now.normal.y, -plane.now.normal.x};
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (std::size_t i = 0; i < disks_.size(); ++i) {
      const Vector from = toMetres(disks_[i]->GetPosition()) - plane.now.point;
      if (dot(from, plane.now.normal) > 2.0 * radius_[i]) continue;
      lowest = std::min(lowest, dot(from, along) - 2.0 * radius_[i]);
      highest = std::max(highest, dot(from, along) + 2.0 * radius_[i]);
    }
    if (!(std::max(-lowest, highest) > plane.half)) continue;
    plane.now.point = plane.now.point + 0.5 * (lowest + highest) * along;
    plane.half = std::max(plane.half, highest - lowest);
    *plane.shape = halfPlane(direction(plane.start.normal), static_cast<float>(plane.half / unit_));
    place(plane);
  }
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
