#include "space.hpp"

#include <chipmunk/chipmunk_structs.h>
#include <chipmunk/chipmunk_unsafe.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace crossgrain_worker::chipmunk {
namespace {

constexpr cpGroup allWalls = 1;  // shapes of one group do not meet

cpVect toChipmunk(Vector v) {
  return cpv(v.x, v.y);
}

Vector fromChipmunk(cpVect v) {
  return {v.x, v.y};
}

std::int32_t idOf(const cpShape* shape) {
  return static_cast<std::int32_t>(reinterpret_cast<std::intptr_t>(cpShapeGetUserData(shape)));
}

void staysAsPlaced(cpBody*, cpFloat) {}

cpShape* newShape(cpBody* body, const Disk& disk) {
  if (!disk.shape) return cpCircleShapeNew(body, disk.radius, cpvzero);
  std::vector<cpVect> vertices;
  for (const Vector& vertex : disk.shape->vertices) vertices.push_back(toChipmunk(vertex));
  const double rounding = disk.shape->rounding;
  if (disk.shape->kind == "capsule")
    return cpSegmentShapeNew(body, vertices[0], vertices[1], rounding);
  return cpPolyShapeNewRaw(body, static_cast<int>(vertices.size()), vertices.data(), rounding);
}

/// How far anything reaches from the origin at the start [m].
double extentOf(const std::vector<Disk>& disks, const std::vector<Body>& walls) {
  double extent = 0.0;
  const auto include = [&](Vector v, double radius) {
    extent = std::max(extent, std::hypot(v.x, v.y) + radius);
  };
  for (const Disk& disk : disks) include(disk.position, disk.radius);
  for (const Body& wall : walls) {
    for (std::size_t k = 0; k < wall.radius.size(); ++k) include(wall.position[k], wall.radius[k]);
    for (const auto& plane : wall.planes) include(plane.point, 0.0);
  }
  return extent;
}

}  // namespace

Space::Space(const ImpulseScene& scene)
    : scene_(scene),
      walls_(scene.walls),
      slop_(scene.setting("slop") > 0.0 ? scene.setting("slop") : 1e-3 * scene.smallest),
      space_(cpSpaceNew()),
      extent_(extentOf(scene.disks, scene.walls)) {
  cpSpaceSetIterations(space_, static_cast<int>(scene.setting("iterations")));
  cpSpaceSetGravity(space_, toChipmunk(scene.gravity));
  cpSpaceSetCollisionSlop(space_, slop_);
  cpSpaceSetCollisionBias(space_, scene.setting("bias"));
  // Of two that part and meet again Chipmunk takes up the old impulse as the sum of the new one,
  // without applying it; so it is to forget them at once.
  cpSpaceSetCollisionPersistence(space_, 1);
  cpCollisionHandler* const handler = cpSpaceAddDefaultCollisionHandler(space_);
  handler->preSolveFunc = beforeSolving;
  handler->postSolveFunc = afterSolving;
  handler->userData = this;
  for (const Disk& disk : scene.disks) addDisk(disk);
  for (Body& wall : walls_) addWall(wall);
  for (const WallShapes& shapes : shapes_)
    for (const PlaneShape& plane : shapes.planes)
      cpShapeSetUserData(plane.shape, reinterpret_cast<cpDataPointer>(nextId_++));
}

Space::~Space() {
  for (cpShape* shape : allShapes_) {
    cpSpaceRemoveShape(space_, shape);
    cpShapeFree(shape);
  }
  for (cpBody* body : allBodies_) {
    cpSpaceRemoveBody(space_, body);
    cpBodyFree(body);
  }
  cpSpaceFree(space_);
}

void Space::add(cpShape* shape, bool wall) {
  cpShapeSetFriction(shape, scene_.friction);
  if (wall)
    cpShapeSetFilter(shape, cpShapeFilterNew(allWalls, CP_ALL_CATEGORIES, CP_ALL_CATEGORIES));
  allShapes_.push_back(cpSpaceAddShape(space_, shape));
}

void Space::addDisk(const Disk& disk) {
  cpBody* const body = cpSpaceAddBody(space_, cpBodyNew(disk.mass, disk.inertia));
  cpBodySetPosition(body, toChipmunk(disk.position));
  cpBodySetVelocity(body, toChipmunk(disk.velocity));
  cpBodySetAngularVelocity(body, disk.spin);
  if (disk.shape) cpBodySetAngle(body, disk.turn);
  allBodies_.push_back(body);
  disks_.push_back(body);
  radius_.push_back(disk.radius);
  cpShape* const shape = newShape(body, disk);
  cpShapeSetUserData(shape, reinterpret_cast<cpDataPointer>(nextId_++));
  add(shape, false);
}

cpBody* Space::newWallBody(bool moves, Vector place) {
  cpBody* const body = cpSpaceAddBody(space_, moves ? cpBodyNewKinematic() : cpBodyNewStatic());
  if (moves) cpBodySetPositionUpdateFunc(body, staysAsPlaced);
  cpBodySetPosition(body, toChipmunk(place));
  allBodies_.push_back(body);
  return body;
}

void Space::addWall(Body& wall) {
  WallShapes& shapes = shapes_.emplace_back();
  for (std::size_t k = 0; k < wall.radius.size(); ++k) {
    cpBody* const body = newWallBody(wall.moves(), wall.position[k]);
    shapes.disks.push_back(body);
    cpShape* const shape = cpCircleShapeNew(body, wall.radius[k], cpvzero);
    cpShapeSetUserData(shape, reinterpret_cast<cpDataPointer>(nextId_++));
    add(shape, true);
  }
  for (const auto& plane : wall.planes) {
    cpBody* const body = newWallBody(true, plane.point);
    // As thick as the scene is large: nothing gets behind it.
    cpShape* const shape = cpSegmentShapeNew(body, cpvzero, cpvzero, extent_);
    shapes.planes.push_back({body, shape, plane.normal, plane.point, 2.0 * extent_});
    setEnds(shapes.planes.back());
    add(shape, true);
  }
}

void Space::setEnds(const PlaneShape& plane) const {
  const Vector middle = -extent_ * plane.normal;
  const Vector along = plane.half * crossgrain_worker::turned(plane.normal);
  cpSegmentShapeSetEndpoints(plane.shape, toChipmunk(middle - along), toChipmunk(middle + along));
}

/// As far as disks reach that could touch it after their next move.
void Space::cover(PlaneShape& shape, const Plane& plane) const {
  shape.at = shape.at - dot(shape.at - plane.point, plane.normal) * plane.normal;
  const Vector along = crossgrain_worker::turned(plane.normal);
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (std::size_t i = 0; i < disks_.size(); ++i) {
    const Vector from = position(i) + scene_.dt * velocity(i) - shape.at;
    if (dot(from, plane.normal) > 2.0 * radius_[i]) continue;
    lowest = std::min(lowest, dot(from, along) - 2.0 * radius_[i]);
    highest = std::max(highest, dot(from, along) + 2.0 * radius_[i]);
  }
  if (!(std::max(-lowest, highest) > shape.half)) return;
  shape.at = shape.at + 0.5 * (lowest + highest) * along;
  shape.half = std::max(shape.half, highest - lowest);
  setEnds(shape);
}

void Space::setPose(cpBody* body, Vector place, double angle, Vector velocity, double spin) {
  cpBodySetPosition(body, toChipmunk(place));
  cpBodySetAngle(body, angle);
  cpBodySetVelocity(body, toChipmunk(velocity));
  cpBodySetAngularVelocity(body, spin);
}

void Space::placeWalls() {
  for (std::size_t b = 0; b < walls_.size(); ++b) {
    const Body& wall = walls_[b];
    WallShapes& shapes = shapes_[b];
    for (std::size_t p = 0; p < shapes.planes.size(); ++p) {
      PlaneShape& plane = shapes.planes[p];
      cover(plane, wall.planes[p]);
      setPose(plane.body, plane.at, wall.angle, wall.velocityAt(plane.at), wall.spin);
    }
    if (!wall.moves()) continue;
    for (std::size_t k = 0; k < shapes.disks.size(); ++k)
      setPose(shapes.disks[k], wall.position[k], wall.angle, wall.diskVelocity[k], wall.spin);
  }
}

void Space::step(double next) {
  for (Body& wall : walls_) wall.at(next);
  placeWalls();
  impulses_.clear();
  cpSpaceStep(space_, scene_.dt);
  std::sort(impulses_.begin(), impulses_.end(), [](const PairImpulse& a, const PairImpulse& b) {
    return std::pair(a.i, a.j) < std::pair(b.i, b.j);
  });
}

/// Chipmunk multiplies the coefficients of two shapes; these are the pair's own.
cpBool Space::beforeSolving(cpArbiter* arbiter, cpSpace*, cpDataPointer self) {
  CP_ARBITER_GET_SHAPES(arbiter, a, b);
  const ImpulseScene& scene = static_cast<Space*>(self)->scene_;
  cpArbiterSetRestitution(arbiter, scene.restitution(idOf(a), idOf(b)));
  cpArbiterSetFriction(arbiter, scene.friction);
  return cpTrue;
}

void Space::afterSolving(cpArbiter* arbiter, cpSpace*, cpDataPointer self) {
  static_cast<Space*>(self)->take(arbiter);
}

void Space::take(const cpArbiter* arbiter) {
  CP_ARBITER_GET_SHAPES(arbiter, a, b);
  const Vector normal = -1.0 * fromChipmunk(cpArbiterGetNormal(arbiter));
  for (int k = 0; scene_.convex && k < cpArbiterGetCount(arbiter); ++k) {
    // Impulses on a, along −n and its turn, have the signs of those on b along n and its turn.
    // Points on a plane may be mirrored along it, those on the body that meets it are right.
    const cpContact& contact = arbiter->contacts[k];
    const Vector point = fromChipmunk(idOf(a) < idOf(b) ? cpArbiterGetPointA(arbiter, k)
                                                        : cpArbiterGetPointB(arbiter, k));
    impulses_.push_back(
        PairImpulse::between(idOf(a), idOf(b), normal, contact.jnAcc, contact.jtAcc, point, point));
    impulses_.back().depth = -cpArbiterGetDepth(arbiter, k);
  }
  if (scene_.convex) return;
  const Vector onA = fromChipmunk(cpArbiterTotalImpulse(arbiter));
  impulses_.push_back(PairImpulse::between(
      idOf(a), idOf(b), normal, dot(onA, normal), dot(onA, turned(normal)),
      fromChipmunk(cpArbiterGetPointA(arbiter, 0)), fromChipmunk(cpArbiterGetPointB(arbiter, 0))));
}

Vector Space::position(std::size_t disk) const {
  return fromChipmunk(cpBodyGetPosition(disks_[disk]));
}

Vector Space::velocity(std::size_t disk) const {
  return fromChipmunk(cpBodyGetVelocity(disks_[disk]));
}

Json Space::deviations() const {
  return {{{"name", "slop"},
           {"value", slop_},
           {"unit", "m"},
           {"note", "largest overlap that is left standing"}}};
}

double Space::turn(std::size_t disk) const {
  return cpBodyGetAngle(disks_[disk]);
}

double Space::spin(std::size_t disk) const {
  return cpBodyGetAngularVelocity(disks_[disk]);
}

}  // namespace crossgrain_worker::chipmunk
