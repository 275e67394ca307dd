#include "space.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "crossgrain_worker.hpp"

namespace crossgrain_worker::ode {
namespace {

constexpr unsigned long diskBit = 1, wallBit = 2;

template <int D>
VectorOf<D> fromOde(const dReal* v) {
  if constexpr (D == 2)
    return {v[0], v[1]};
  else
    return {v[0], v[1], v[2]};
}

Vector3 inSpace(Vector v) {
  return {v.x, v.y, 0.0};
}
Vector3 inSpace(Vector3 v) {
  return v;
}
Vector3 inSpace(double spin) {
  return {0.0, 0.0, spin};
}

void toOde(Vector3 v, dReal* to) {
  to[0] = v.x;
  to[1] = v.y;
  to[2] = v.z;
}

std::int32_t idOf(dGeomID shape) {
  return static_cast<std::int32_t>(reinterpret_cast<std::intptr_t>(dGeomGetData(shape)));
}

void setId(dGeomID shape, std::size_t id) {
  dGeomSetData(shape, reinterpret_cast<void*>(static_cast<std::intptr_t>(id)));
}

/// Turns ODE's capsules, which are along z, to x.
constexpr dMatrix3 alongX{0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0};

dQuaternion* toOde(double angle, dQuaternion* turn) {
  dQFromAxisAndAngle(*turn, 0.0, 0.0, 1.0, angle);
  return turn;
}
dQuaternion* toOde(const std::array<double, 4>& from, dQuaternion* turn) {
  std::copy(from.begin(), from.end(), *turn);
  return turn;
}

// Hollow cylinders, a class of shapes beside ODE's own, which are solid.

using Cylinder = CylinderOf<3>;

/// A sphere meets the plane that touches there, as dCollideSpherePlane has it; the normal is for
/// the cylinder.
int collideWithSphere(dGeomID cylinder, dGeomID sphere, int, dContactGeom* contact, int) {
  const dReal* const at = dGeomGetPosition(sphere);
  const Vector3 centre{at[0], at[1], at[2]};
  const auto [normal, distance] =
      static_cast<const Cylinder*>(dGeomGetClassData(cylinder))->facing(centre);
  const double radius = dGeomSphereGetRadius(sphere);
  contact->depth = radius - distance;
  if (contact->depth < 0.0) return 0;
  toOde(centre - radius * normal, contact->pos);
  toOde(-1.0 * normal, contact->normal);
  contact->g1 = cylinder;
  contact->g2 = sphere;
  contact->side1 = contact->side2 = -1;
  return 1;
}

dColliderFn* colliderOf(int other) {
  return other == dSphereClass ? collideWithSphere : nullptr;
}

dGeomID createCylinder(const Cylinder& cylinder) {
  static const dGeomClass about{sizeof(Cylinder), colliderOf, dInfiniteAABB, nullptr, nullptr};
  static const int number = dCreateGeomClass(&about);
  const dGeomID shape = dCreateGeom(number);
  new (dGeomGetClassData(shape)) Cylinder(cylinder);
  return shape;
}

/// ODE's rows against rolling bring spins to rest, not to that of a wall.
template <int D>
const ImpulseSceneOf<D>& withoutTurningWalls(const ImpulseSceneOf<D>& scene) {
  for (const BodyOf<D>& wall : scene.walls)
    if (scene.rolling && !isZero(wall.spin))
      throw crossgrain_worker::Unsupported("resists no rolling on walls that turn");
  return scene;
}

}  // namespace

template <int D>
Space<D>::Space(const ImpulseSceneOf<D>& scene)
    : scene_(withoutTurningWalls(scene)),
      iterations_(static_cast<int>(scene.setting("iterations"))),
      erp_(scene.setting("erp")),
      alongSlip_(scene.setting("friction_along_slip") != 0.0),
      bounceThreshold_(scene.setting("restitution_threshold")),
      world_(dWorldCreate()),
      shapes_(dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ)),
      contacts_(dJointGroupCreate(0)) {
  dRandSetSeed(0);  // QuickStep changes the order of its rows by chance
  const Vector3 gravity = inSpace(scene.gravity);
  dWorldSetGravity(world_, gravity.x, gravity.y, gravity.z);
  dWorldSetQuickStepNumIterations(world_, std::max(iterations_, 1));
  dWorldSetQuickStepW(world_, scene.setting("relaxation"));
  if (scene.setting("correcting_speed") > 0.0)
    dWorldSetContactMaxCorrectingVel(world_, scene.setting("correcting_speed"));
  // CFM / dt stands beside 1/m: ODE's own 1e-10 would make heavy disks soft.
  double lightest = 1.0;
  for (const DiskOf<D>& disk : scene.disks)
    lightest = &disk == scene.disks.data() ? disk.mass : std::min(lightest, disk.mass);
  dWorldSetCFM(world_, 1e-10 * scene.dt / lightest);
  for (const DiskOf<D>& disk : scene.disks) addDisk(disk);
  for (const BodyOf<D>& wall : scene_.walls)
    for (std::size_t k = 0; k < wall.radius.size(); ++k) {
      wallParts_.emplace_back(&wall, k);
      addWall(dCreateSphere(shapes_, wall.radius[k]));
    }
  wallDisks_ = wallParts_.size();
  for (const BodyOf<D>& wall : scene_.walls)
    for (std::size_t p = 0; p < wall.planes.size(); ++p) {
      wallParts_.emplace_back(&wall, p);
      addWall(dCreatePlane(shapes_, 0.0, 1.0, 0.0, 0.0));
    }
  planesEnd_ = wallParts_.size();
  if constexpr (D == 3)
    for (const BodyOf<D>& wall : scene_.walls)
      for (std::size_t c = 0; c < wall.cylinders.size(); ++c) {
        wallParts_.emplace_back(&wall, c);
        addWall(createCylinder(wall.cylinders[c]));
        dSpaceAdd(shapes_, wallShapes_.back());
      }
  placeWalls();
}

template <int D>
Space<D>::~Space() {
  dJointGroupDestroy(contacts_);
  dSpaceDestroy(shapes_);
  dWorldDestroy(world_);
}

template <int D>
void Space<D>::addDisk(const DiskOf<D>& disk) {
  const dBodyID body = dBodyCreate(world_);
  // ODE inverts the inertia, and has none that is infinite: 1e30 times a disk's is none to it.
  turns_.push_back(std::isfinite(disk.inertia));
  const double inertia =
      turns_.back() ? disk.inertia : 1e30 * disk.mass * disk.radius * disk.radius;
  const bool hasAxes = D == 3 && disk.shape && turns_.back();
  const Vector3 moments = hasAxes ? disk.moments : Vector3{inertia, inertia, inertia};
  dMass mass;
  dMassSetParameters(&mass, disk.mass, 0.0, 0.0, 0.0, moments.x, moments.y, moments.z, 0.0, 0.0,
                     0.0);
  dBodySetMass(body, &mass);
  dBodySetGyroscopicMode(body, hasAxes);
  const Vector3 place = inSpace(disk.position), velocity = inSpace(disk.velocity),
                spin = inSpace(disk.spin);
  dBodySetPosition(body, place.x, place.y, place.z);
  dBodySetLinearVel(body, velocity.x, velocity.y, velocity.z);
  dBodySetAngularVel(body, spin.x, spin.y, spin.z);
  if (scene_.convex) {
    dQuaternion turn;
    dBodySetQuaternion(body, *toOde(disk.turn, &turn));
  }
  const dGeomID shape = createShape(disk);
  dGeomSetBody(shape, body);
  if (D == 2 && disk.shape && disk.shape->kind == "capsule") dGeomSetOffsetRotation(shape, alongX);
  dGeomSetCategoryBits(shape, diskBit);
  dGeomSetCollideBits(shape, diskBit | wallBit);
  setId(shape, disks_.size());
  disks_.push_back(body);
}

/// Polygons are prisms, which the plane cuts in the middle.
template <int D>
dGeomID Space<D>::createShape(const DiskOf<D>& disk) {
  if (!disk.shape) return dCreateSphere(shapes_, disk.radius);
  const ShapeOf<D>& shape = *disk.shape;
  const double length = 2.0 * shape.halfLength();
  if (shape.kind == "capsule") return dCreateCapsule(shapes_, shape.rounding, length);
  if (shape.kind == "cylinder") return dCreateCylinder(shapes_, shape.rounding, length);
  if (shape.isBox()) {
    const Vector3 half = inSpace(shape.halfSides());
    return dCreateBox(shapes_, 2.0 * half.x, 2.0 * half.y, 2.0 * (D == 2 ? disk.radius : half.z));
  }
  std::vector<double>& corners = corners_.emplace_back();
  for (const Vector3& corner : shape.corners(disk.radius)) append(corners, corner);
  // libccd and planes ask for corners alone, and no faces.
  static const dReal noPlanes[4]{};
  static const unsigned noFaces[1]{};
  return dCreateConvex(shapes_, noPlanes, 0, corners.data(),
                       static_cast<unsigned>(corners.size() / 3), noFaces);
}

/// Walls are shapes without bodies, which are put where they are; contacts have their velocity.
template <int D>
void Space<D>::addWall(dGeomID shape) {
  dGeomSetCategoryBits(shape, wallBit);
  dGeomSetCollideBits(shape, diskBit);
  setId(shape, disks_.size() + wallShapes_.size());
  wallShapes_.push_back(shape);
}

template <int D>
void Space<D>::placeWalls() {
  for (std::size_t w = 0; w < planesEnd_; ++w) {  // cylinders stay where they are
    const auto [wall, part] = wallParts_[w];
    if (w < wallDisks_) {
      const Vector3 at = inSpace(wall->position[part]);
      dGeomSetPosition(wallShapes_[w], at.x, at.y, at.z);
    } else {
      const auto& plane = wall->planes[part];
      const Vector3 normal = inSpace(plane.normal);
      dGeomPlaneSetParams(wallShapes_[w], normal.x, normal.y, normal.z,
                          dot(plane.normal, plane.point));
    }
  }
}

template <int D>
void Space<D>::near(void* space, dGeomID a, dGeomID b) {
  if (idOf(a) > idOf(b)) std::swap(a, b);
  Space& self = *static_cast<Space*>(space);
  if (self.scene_.convex) return self.addConvex(a, b);
  Touch touch{idOf(a), idOf(b), {}};
  if (dCollide(a, b, 1, &touch.geometry, sizeof(dContactGeom)) > 0) self.touches_.push_back(touch);
}

/// All points of a pair. In the plane each is where the plane cuts what two prisms have along z.
template <int D>
void Space<D>::addConvex(dGeomID a, dGeomID b) {
  dContactGeom found[64];
  const int count = dCollide(a, b, 64, found, sizeof(dContactGeom));
  const std::size_t first = touches_.size();
  for (int k = 0; k < count; ++k) {
    dContactGeom& point = found[k];
    if (D == 2) {
      point.pos[2] = 0.0;
      const double length = std::hypot(point.normal[0], point.normal[1]);
      toOde({point.normal[0] / length, point.normal[1] / length, 0.0}, point.normal);
    }
    const auto same = [&](const Touch& touch) {
      return norm(fromOde<D>(touch.geometry.pos) - fromOde<D>(point.pos)) < 1e-6 * scene_.smallest;
    };
    if (std::none_of(touches_.begin() + static_cast<long>(first), touches_.end(), same))
      touches_.push_back({idOf(a), idOf(b), point});
  }
}

template <int D>
void Space<D>::findTouches() {
  touches_.clear();
  dSpaceCollide(shapes_, this, near);
  // In one order, however the shapes' list came about.
  const auto key = [](const Touch& touch) {
    const dReal* const at = touch.geometry.pos;
    return std::tuple(touch.i, touch.j, at[0], at[1], at[2]);
  };
  std::sort(touches_.begin(), touches_.end(),
            [&](const Touch& a, const Touch& b) { return key(a) < key(b); });
}

template <int D>
VectorOf<D> Space<D>::wallVelocity(std::int32_t id, Vector place) const {
  const std::size_t w = static_cast<std::size_t>(id) - disks_.size();
  const auto [wall, part] = wallParts_[w];
  if (w >= wallDisks_) return wall->velocityAt(place);
  return wall->diskVelocity[part] + cross(wall->spin, place - wall->position[part]);
}

/// Of friction in space, each bounded by itself: along the slip that the step finds, and across it;
/// where there is none, or `friction_along_slip` is 0, as ODE chooses them, by the normal alone.
template <int D>
void Space<D>::setDirections(const Touch& touch, dContact& contact) const {
  const dReal* const n = touch.geometry.normal;
  const Vector normal = fromOde<D>(n);
  if constexpr (D == 2) {
    toOde(inSpace(turned(normal)), contact.fdir1);
  } else {
    dVector3 across;
    dPlaneSpace(n, contact.fdir1, across);
    if (!alongSlip_) return;
    const Vector place = fromOde<D>(touch.geometry.pos);
    const auto velocityAt = [&](std::int32_t id) {
      if (static_cast<std::size_t>(id) >= disks_.size()) return wallVelocity(id, place);
      dVector3 velocity;
      dBodyGetPointVel(disks_[static_cast<std::size_t>(id)], place.x, place.y, place.z, velocity);
      return fromOde<D>(velocity);
    };
    const Vector relative = velocityAt(touch.i) - velocityAt(touch.j),
                 slip = relative - dot(relative, normal) * normal;
    const double speed = norm(slip);
    if (speed > 1e-9 * norm(relative)) toOde((1.0 / speed) * slip, contact.fdir1);
  }
}

template <int D>
dContact Space<D>::contactOf(const Touch& touch) const {
  dContact contact{};
  contact.geom = touch.geometry;
  dSurfaceParameters& surface = contact.surface;
  // Friction bounded by µ times the normal force, in the plane along one direction; without Approx1
  // µ would be a force.
  surface.mode = dContactFDir1 | dContactMu2 | dContactApprox1_1 | dContactBounce | dContactSoftERP;
  if (D == 3) surface.mode |= dContactApprox1_2;
  surface.mu = scene_.friction;
  surface.mu2 = D == 2 ? 0.0 : scene_.friction;
  setDirections(touch, contact);
  surface.bounce = scene_.restitution(touch.i, touch.j);
  surface.bounce_vel = bounceThreshold_;
  surface.soft_erp = erp_;
  if (scene_.rolling) {
    // About all axes alike, of which the plane has one: with a coefficient of 0 for the others
    // (dContactAxisDep) ODE 0.16 counts rows that it does not fill. A second direction of friction,
    // across the plane, comes with it.
    surface.mode = (surface.mode & ~dContactMu2) | dContactRolling | dContactApprox1;
    surface.rho = scene_.rolling(touch.i, touch.j);
  }
  if (static_cast<std::size_t>(touch.j) >= disks_.size()) {
    const Vector velocity = wallVelocity(touch.j, fromOde<D>(touch.geometry.pos));
    const Vector normal = fromOde<D>(touch.geometry.normal), along = fromOde<D>(contact.fdir1);
    surface.mode |= dContactMotionN | dContactMotion1;
    surface.motionN = dot(velocity, normal);
    surface.motion1 = dot(velocity, along);
    if constexpr (D == 3) {
      surface.mode |= dContactMotion2;
      surface.motion2 = dot(velocity, cross(normal, along));
    }
  }
  return contact;
}

template <int D>
void Space<D>::step(double next) {
  findTouches();
  // Walls stand where the step began, and have the velocity of its middle, which takes them to
  // where they are at its end.
  for (BodyOf<D>& wall : scene_.walls) wall.at(next - 0.5 * scene_.dt);
  forces_.assign(touches_.size(), {});
  std::vector<Vector> centres;  // of the first of each contact, before they move
  for (std::size_t k = 0; k < touches_.size(); ++k) {
    const dContact contact = contactOf(touches_[k]);
    const dJointID joint = dJointCreateContact(world_, contacts_, &contact);
    const auto j = static_cast<std::size_t>(touches_[k].j);
    dJointAttach(joint, disks_[static_cast<std::size_t>(touches_[k].i)],
                 j < disks_.size() ? disks_[j] : nullptr);
    dJointSetFeedback(joint, &forces_[k]);
    centres.push_back(position(static_cast<std::size_t>(touches_[k].i)));
  }
  if (!(iterations_ > 0 ? dWorldQuickStep(world_, scene_.dt) : dWorldStep(world_, scene_.dt)))
    throw std::runtime_error("ODE has no memory for its step");
  auto& impulses = this->impulses_;
  impulses.clear();
  for (std::size_t k = 0; k < touches_.size(); ++k) {
    const Vector normal = fromOde<D>(touches_[k].geometry.normal),
                 force = fromOde<D>(forces_[k].f1), place = fromOde<D>(touches_[k].geometry.pos);
    const double pressing = dot(force, normal);
    TangentOf<D> along;
    SpinOf<D> rolling{};
    if constexpr (D == 2) {
      along = scene_.dt * dot(force, turned(normal));
      if (scene_.rolling)
        rolling = scene_.dt * (forces_[k].t1[2] - cross(place - centres[k], force));
    } else {
      along = scene_.dt * (force - pressing * normal);
    }
    // The solver's normal force is not negative; a product of rounded numbers could be.
    impulses.push_back({touches_[k].i, touches_[k].j, normal, std::max(0.0, scene_.dt * pressing),
                        along, place, rolling, touches_[k].geometry.depth});
  }
  dJointGroupEmpty(contacts_);
  if (D == 2) requirePlane();
  for (BodyOf<D>& wall : scene_.walls) wall.at(next);
  placeWalls();
}

/// No constraint holds disks in the plane; nothing pushes them out of it, to the bit.
template <int D>
void Space<D>::requirePlane() const {
  for (const dBodyID body : disks_) {
    const dReal* const spin = dBodyGetAngularVel(body);
    if (dBodyGetPosition(body)[2] != 0.0 || spin[0] != 0.0 || spin[1] != 0.0)
      throw std::runtime_error("a disk left the plane");
  }
}

template <int D>
VectorOf<D> Space<D>::position(std::size_t disk) const {
  return fromOde<D>(dBodyGetPosition(disks_[disk]));
}

template <int D>
VectorOf<D> Space<D>::velocity(std::size_t disk) const {
  return fromOde<D>(dBodyGetLinearVel(disks_[disk]));
}

template <int D>
SpinOf<D> Space<D>::spin(std::size_t disk) const {
  if (!turns_[disk]) return {};
  const dReal* const spin = dBodyGetAngularVel(disks_[disk]);
  if constexpr (D == 2)
    return spin[2];
  else
    return fromOde<D>(spin);
}

template <int D>
OrientationOf<D> Space<D>::turn(std::size_t disk) const {
  const dReal* const turn = dBodyGetQuaternion(disks_[disk]);
  if constexpr (D == 2)
    return 2.0 * std::atan2(turn[3], turn[0]);
  else
    return {turn[0], turn[1], turn[2], turn[3]};
}

template class Space<2>;
template class Space<3>;

}  // namespace crossgrain_worker::ode
