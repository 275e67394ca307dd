#include "space.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace chipmunk_worker {
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

Space::Space(const std::vector<Disk>& disks, std::vector<Body>& walls, SpaceOptions options)
    : options_(std::move(options)), walls_(walls), space_(cpSpaceNew()) {
  cpSpaceSetIterations(space_, options_.iterations);
  cpSpaceSetGravity(space_, toChipmunk(options_.gravity));
  cpSpaceSetCollisionSlop(space_, options_.slop);
  cpSpaceSetCollisionBias(space_, options_.bias);
  // Of two that part and meet again Chipmunk takes up the old impulse as the sum of the new one,
  // without applying it; so it is to forget them at once.
  cpSpaceSetCollisionPersistence(space_, 1);
  cpCollisionHandler* const handler = cpSpaceAddDefaultCollisionHandler(space_);
  handler->preSolveFunc = beforeSolving;
  handler->postSolveFunc = afterSolving;
  handler->userData = this;
  for (const Disk& disk : disks) addDisk(disk);
  const double reach = 16.0 * extentOf(disks, walls);
  for (Body& wall : walls) addWall(wall, reach);
  for (cpShape* plane : planes_)
    cpShapeSetUserData(plane, reinterpret_cast<cpDataPointer>(nextId_++));
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
  cpShapeSetFriction(shape, options_.friction);
  if (wall)
    cpShapeSetFilter(shape, cpShapeFilterNew(allWalls, CP_ALL_CATEGORIES, CP_ALL_CATEGORIES));
  allShapes_.push_back(cpSpaceAddShape(space_, shape));
}

void Space::addDisk(const Disk& disk) {
  cpBody* const body = cpSpaceAddBody(space_, cpBodyNew(disk.mass, disk.inertia));
  cpBodySetPosition(body, toChipmunk(disk.position));
  cpBodySetVelocity(body, toChipmunk(disk.velocity));
  cpBodySetAngularVelocity(body, disk.spin);
  allBodies_.push_back(body);
  disks_.push_back(body);
  cpShape* const shape = cpCircleShapeNew(body, disk.radius, cpvzero);
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

void Space::addWall(Body& wall, double reach) {
  WallShapes& shapes = shapes_.emplace_back();
  for (std::size_t k = 0; k < wall.radius.size(); ++k) {
    cpBody* const body = newWallBody(wall.moves(), wall.position[k]);
    shapes.disks.push_back(body);
    cpShape* const shape = cpCircleShapeNew(body, wall.radius[k], cpvzero);
    cpShapeSetUserData(shape, reinterpret_cast<cpDataPointer>(nextId_++));
    add(shape, true);
  }
  if (wall.planes.empty()) return;
  shapes.planes = newWallBody(wall.moves(), wall.centre);
  for (const auto& plane : wall.planes) {
    // A segment as thick as the scene is large: nothing gets behind it.
    const double thick = reach / 16.0;
    const Vector middle = plane.point - wall.centre - thick * plane.normal;
    const Vector along = reach * crossgrain_worker::turned(plane.normal);
    planes_.push_back(cpSegmentShapeNew(shapes.planes, toChipmunk(middle - along),
                                        toChipmunk(middle + along), thick));
    add(planes_.back(), true);
  }
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
    if (!wall.moves()) continue;
    const WallShapes& shapes = shapes_[b];
    for (std::size_t k = 0; k < shapes.disks.size(); ++k)
      setPose(shapes.disks[k], wall.position[k], wall.angle, wall.diskVelocity[k], wall.spin);
    if (shapes.planes) setPose(shapes.planes, wall.centre, wall.angle, wall.velocity, wall.spin);
  }
}

void Space::step(double next) {
  for (Body& wall : walls_) wall.at(next);
  placeWalls();
  impulses_.clear();
  cpSpaceStep(space_, options_.dt);
  std::sort(impulses_.begin(), impulses_.end(), [](const PairImpulse& a, const PairImpulse& b) {
    return std::pair(a.i, a.j) < std::pair(b.i, b.j);
  });
}

/// Chipmunk multiplies the coefficients of two shapes; these are the pair's own.
cpBool Space::beforeSolving(cpArbiter* arbiter, cpSpace*, cpDataPointer self) {
  CP_ARBITER_GET_SHAPES(arbiter, a, b);
  const SpaceOptions& options = static_cast<Space*>(self)->options_;
  cpArbiterSetRestitution(arbiter, options.restitution(idOf(a), idOf(b)));
  cpArbiterSetFriction(arbiter, options.friction);
  return cpTrue;
}

void Space::afterSolving(cpArbiter* arbiter, cpSpace*, cpDataPointer self) {
  static_cast<Space*>(self)->take(arbiter);
}

void Space::take(const cpArbiter* arbiter) {
  CP_ARBITER_GET_SHAPES(arbiter, a, b);
  const std::int32_t i = idOf(a), j = idOf(b);
  const Vector onA = fromChipmunk(cpArbiterTotalImpulse(arbiter));
  impulses_.push_back(i < j ? PairImpulse{i, j, onA} : PairImpulse{j, i, -1.0 * onA});
}

Vector Space::position(std::size_t disk) const {
  return fromChipmunk(cpBodyGetPosition(disks_[disk]));
}

Vector Space::velocity(std::size_t disk) const {
  return fromChipmunk(cpBodyGetVelocity(disks_[disk]));
}

double Space::spin(std::size_t disk) const {
  return cpBodyGetAngularVelocity(disks_[disk]);
}

}  // namespace chipmunk_worker
