#include "space.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "crossgrain_worker.hpp"

namespace crossgrain_worker::ode {
namespace {

constexpr unsigned long diskBit = 1, wallBit = 2;

Vector fromOde(const dReal* v) {
  return {v[0], v[1]};
}

std::int32_t idOf(dGeomID shape) {
  return static_cast<std::int32_t>(reinterpret_cast<std::intptr_t>(dGeomGetData(shape)));
}

void setId(dGeomID shape, std::size_t id) {
  dGeomSetData(shape, reinterpret_cast<void*>(static_cast<std::intptr_t>(id)));
}

/// ODE's rows against rolling bring spins to rest, not to that of a wall.
const ImpulseScene& withoutTurningWalls(const ImpulseScene& scene) {
  for (const Body& wall : scene.walls)
    if (scene.rolling && wall.spin != 0.0)
      throw crossgrain_worker::Unsupported("resists no rolling on walls that turn");
  return scene;
}

}  // namespace

Space::Space(const ImpulseScene& scene)
    : scene_(withoutTurningWalls(scene)),
      iterations_(static_cast<int>(scene.setting("iterations"))),
      erp_(scene.setting("erp")),
      bounceThreshold_(scene.setting("restitution_threshold")),
      world_(dWorldCreate()),
      shapes_(dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ)),
      contacts_(dJointGroupCreate(0)) {
  dRandSetSeed(0);  // QuickStep changes the order of its rows by chance
  dWorldSetGravity(world_, scene.gravity.x, scene.gravity.y, 0.0);
  dWorldSetQuickStepNumIterations(world_, std::max(iterations_, 1));
  dWorldSetQuickStepW(world_, scene.setting("relaxation"));
  if (scene.setting("correcting_speed") > 0.0)
    dWorldSetContactMaxCorrectingVel(world_, scene.setting("correcting_speed"));
  // CFM / dt stands beside 1/m: ODE's own 1e-10 would make heavy disks soft.
  double lightest = 1.0;
  for (const Disk& disk : scene.disks)
    lightest = &disk == scene.disks.data() ? disk.mass : std::min(lightest, disk.mass);
  dWorldSetCFM(world_, 1e-10 * scene.dt / lightest);
  for (const Disk& disk : scene.disks) addDisk(disk);
  for (const Body& wall : scene_.walls)
    for (std::size_t k = 0; k < wall.radius.size(); ++k) {
      wallParts_.emplace_back(&wall, k);
      addWall(dCreateSphere(shapes_, wall.radius[k]));
    }
  wallDisks_ = wallParts_.size();
  for (const Body& wall : scene_.walls)
    for (std::size_t p = 0; p < wall.planes.size(); ++p) {
      wallParts_.emplace_back(&wall, p);
      addWall(dCreatePlane(shapes_, 0.0, 1.0, 0.0, 0.0));
    }
  placeWalls();
}

Space::~Space() {
  dJointGroupDestroy(contacts_);
  dSpaceDestroy(shapes_);
  dWorldDestroy(world_);
}

void Space::addDisk(const Disk& disk) {
  const dBodyID body = dBodyCreate(world_);
  // ODE inverts the inertia, and has none that is infinite: 1e30 times a disk's is none to it.
  turns_.push_back(std::isfinite(disk.inertia));
  const double inertia =
      turns_.back() ? disk.inertia : 1e30 * disk.mass * disk.radius * disk.radius;
  dMass mass;
  dMassSetParameters(&mass, disk.mass, 0.0, 0.0, 0.0, inertia, inertia, inertia, 0.0, 0.0, 0.0);
  dBodySetMass(body, &mass);
  dBodySetGyroscopicMode(body, 0);
  dBodySetPosition(body, disk.position.x, disk.position.y, 0.0);
  dBodySetLinearVel(body, disk.velocity.x, disk.velocity.y, 0.0);
  dBodySetAngularVel(body, 0.0, 0.0, disk.spin);
  const dGeomID shape = dCreateSphere(shapes_, disk.radius);
  dGeomSetBody(shape, body);
  dGeomSetCategoryBits(shape, diskBit);
  dGeomSetCollideBits(shape, diskBit | wallBit);
  setId(shape, disks_.size());
  disks_.push_back(body);
}

/// Walls are shapes without bodies, which are put where they are; contacts have their velocity.
void Space::addWall(dGeomID shape) {
  dGeomSetCategoryBits(shape, wallBit);
  dGeomSetCollideBits(shape, diskBit);
  setId(shape, disks_.size() + wallShapes_.size());
  wallShapes_.push_back(shape);
}

void Space::placeWalls() {
  for (std::size_t w = 0; w < wallShapes_.size(); ++w) {
    const auto [wall, part] = wallParts_[w];
    if (w < wallDisks_) {
      const Vector at = wall->position[part];
      dGeomSetPosition(wallShapes_[w], at.x, at.y, 0.0);
    } else {
      const auto& plane = wall->planes[part];
      dGeomPlaneSetParams(wallShapes_[w], plane.normal.x, plane.normal.y, 0.0,
                          dot(plane.normal, plane.point));
    }
  }
}

void Space::near(void* space, dGeomID a, dGeomID b) {
  if (idOf(a) > idOf(b)) std::swap(a, b);
  Touch touch{idOf(a), idOf(b), {}};
  if (dCollide(a, b, 1, &touch.geometry, sizeof(dContactGeom)) > 0)
    static_cast<Space*>(space)->touches_.push_back(touch);
}

void Space::findTouches() {
  touches_.clear();
  dSpaceCollide(shapes_, this, near);
  // In one order, however the shapes' list came about.
  std::sort(touches_.begin(), touches_.end(), [](const Touch& a, const Touch& b) {
    return std::pair(a.i, a.j) < std::pair(b.i, b.j);
  });
}

Vector Space::wallVelocity(std::int32_t id, Vector place) const {
  const std::size_t w = static_cast<std::size_t>(id) - disks_.size();
  const auto [wall, part] = wallParts_[w];
  if (w >= wallDisks_) return wall->velocityAt(place);
  return wall->diskVelocity[part] + wall->spin * turned(place - wall->position[part]);
}

dContact Space::contactOf(const Touch& touch) const {
  dContact contact{};
  contact.geom = touch.geometry;
  const Vector normal = fromOde(touch.geometry.normal), along = turned(normal);
  contact.fdir1[0] = along.x;
  contact.fdir1[1] = along.y;
  dSurfaceParameters& surface = contact.surface;
  // Friction along one direction, bounded by µ times the normal force; without Approx1 µ would be
  // a force.
  surface.mode = dContactFDir1 | dContactMu2 | dContactApprox1_1 | dContactBounce | dContactSoftERP;
  surface.mu = scene_.friction;
  surface.mu2 = 0.0;
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
    const Vector velocity = wallVelocity(touch.j, fromOde(touch.geometry.pos));
    surface.mode |= dContactMotionN | dContactMotion1;
    surface.motionN = dot(velocity, normal);
    surface.motion1 = dot(velocity, along);
  }
  return contact;
}

void Space::step(double next) {
  findTouches();
  // Walls stand where the step began, and have the velocity of its middle, which takes them to
  // where they are at its end.
  for (Body& wall : scene_.walls) wall.at(next - 0.5 * scene_.dt);
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
  impulses_.clear();
  for (std::size_t k = 0; k < touches_.size(); ++k) {
    const Vector normal = fromOde(touches_[k].geometry.normal), force = fromOde(forces_[k].f1);
    const Vector place = fromOde(touches_[k].geometry.pos), arm = place - centres[k];
    // The solver's normal force is not negative; a product of rounded numbers could be.
    impulses_.push_back(
        {touches_[k].i, touches_[k].j, normal, std::max(0.0, scene_.dt * dot(force, normal)),
         scene_.dt * dot(force, turned(normal)), place,
         scene_.rolling ? scene_.dt * (forces_[k].t1[2] - cross(arm, force)) : 0.0});
  }
  dJointGroupEmpty(contacts_);
  requirePlane();
  for (Body& wall : scene_.walls) wall.at(next);
  placeWalls();
}

/// No constraint holds disks in the plane; nothing pushes them out of it, to the bit.
void Space::requirePlane() const {
  for (const dBodyID body : disks_) {
    const dReal* const spin = dBodyGetAngularVel(body);
    if (dBodyGetPosition(body)[2] != 0.0 || spin[0] != 0.0 || spin[1] != 0.0)
      throw std::runtime_error("a disk left the plane");
  }
}

Vector Space::position(std::size_t disk) const {
  return fromOde(dBodyGetPosition(disks_[disk]));
}

Vector Space::velocity(std::size_t disk) const {
  return fromOde(dBodyGetLinearVel(disks_[disk]));
}

double Space::spin(std::size_t disk) const {
  return turns_[disk] ? dBodyGetAngularVel(disks_[disk])[2] : 0.0;
}

}  // namespace crossgrain_worker::ode
