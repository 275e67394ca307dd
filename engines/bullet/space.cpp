#include "space.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace crossgrain_worker::bullet {
namespace {

btVector3 toBullet(Vector v) {
  return {v.x, v.y, 0.0};
}

btVector3 toBullet(Vector3 v) {
  return {v.x, v.y, v.z};
}

btVector3 toBullet(double spin) {
  return {0.0, 0.0, spin};
}

template <int D>
VectorOf<D> fromBullet(const btVector3& v) {
  if constexpr (D == 2)
    return {v.x(), v.y()};
  else
    return {v.x(), v.y(), v.z()};
}

btQuaternion turnOf(double angle) {
  return {{0.0, 0.0, 1.0}, angle};
}

btQuaternion turnOf(Vector3 angle) {
  const double size = norm(angle);
  return size > 0.0 ? btQuaternion(toBullet(angle), size) : btQuaternion::getIdentity();
}

btQuaternion turnOf(const std::array<double, 4>& turn) {
  return {turn[1], turn[2], turn[3], turn[0]};
}

/// Sharp boxes, cylinders and hulls have no margin: Bullet's own, 0.04 m, rounds their corners.
/// Polygons are prisms, which the plane cuts in the middle.
template <int D>
std::unique_ptr<btCollisionShape> shapeOf(const DiskOf<D>& disk) {
  if (!disk.shape) return std::make_unique<btSphereShape>(disk.radius);
  const ShapeOf<D>& shape = *disk.shape;
  if (shape.kind == "capsule") {
    const double length = 2.0 * shape.halfLength();
    if (D == 2) return std::make_unique<btCapsuleShapeX>(shape.rounding, length);
    return std::make_unique<btCapsuleShapeZ>(shape.rounding, length);
  }
  std::unique_ptr<btConvexInternalShape> sharp;
  if (shape.kind == "cylinder") {
    sharp = std::make_unique<btCylinderShapeZ>(
        btVector3(shape.rounding, shape.rounding, shape.halfLength()));
    sharp->setMargin(0.0);
    return sharp;
  }
  std::unique_ptr<btPolyhedralConvexShape> made;
  if (shape.isBox()) {
    btVector3 half = toBullet(shape.halfSides());
    if (D == 2) half.setZ(disk.radius);
    made = std::make_unique<btBoxShape>(half);
  } else {
    auto hull = std::make_unique<btConvexHullShape>();
    for (const Vector3& corner : shape.corners(disk.radius))
      hull->addPoint(toBullet(corner), false);
    hull->recalcLocalAabb();
    made = std::move(hull);
  }
  made->setMargin(shape.rounding);
  // Faces, which give two polyhedra several points; they would be without the rounding.
  if (shape.rounding == 0.0) made->initializePolyhedralFeatures();
  return made;
}

bool isSphere(const btCollisionObject* object) {
  return object->getCollisionShape()->getShapeType() == SPHERE_SHAPE_PROXYTYPE;
}

/// How far apart a disk and a plane may be and be in contact, in smallest radii: far below what a
/// disk moves in a step, and above rounding, by which Bullet would lose contacts that touch.
constexpr double contactMargin = 1e-6;

/// How far apart points of convex bodies are kept, in smallest radii: Bullet's own share of a size.
/// They act within the margin above.
constexpr double keptPoints = 0.02;

template <int D>
const Space<D>& spaceOf(const btCollisionObject* object) {
  return *static_cast<const Space<D>*>(object->getUserPointer());
}

}  // namespace

template <int D>
Space<D>::Space(const ImpulseSceneOf<D>& scene) : scene_(scene) {
  // Globals of Bullet. The margins are 0.02 m and 0.05 m otherwise: planes would act from afar, and
  // all disks of a small scene be neighbours.
  gContactBreakingThreshold = (scene.convex ? keptPoints : contactMargin) * scene.smallest;
  gDbvtMargin = 0.1 * scene.smallest;
  gCalculateCombinedRestitutionCallback = pairRestitution;
  gCalculateCombinedFrictionCallback = pairFriction;
  gCalculateCombinedRollingFrictionCallback = pairRolling;
  dispatcher_.setDispatcherFlags(
      dispatcher_.getDispatcherFlags() &
      ~btCollisionDispatcher::CD_USE_RELATIVE_CONTACT_BREAKING_THRESHOLD);
  for (const auto& [one, other] : {std::pair(SPHERE_SHAPE_PROXYTYPE, CUSTOM_CONCAVE_SHAPE_TYPE),
                                   {CUSTOM_CONCAVE_SHAPE_TYPE, SPHERE_SHAPE_PROXYTYPE}})
    dispatcher_.registerCollisionCreateFunc(one, other, &sphereInCylinder_);
  world_.getDispatchInfo().m_deterministicOverlappingPairs = true;
  world_.setForceUpdateAllAabbs(false);  // not of walls that rest
  btContactSolverInfo& solver = world_.getSolverInfo();
  solver.m_numIterations = static_cast<int>(scene.setting("iterations"));
  solver.m_erp2 = scene.setting("erp");
  solver.m_restitutionVelocityThreshold = scene.setting("restitution_threshold");
  // Overlaps of any depth are pushed apart by velocities that are forgotten after the step. By
  // Bullet's own threshold, 0.04 m, shallower ones would add to the velocities that stay.
  solver.m_splitImpulsePenetrationThreshold = 0.0;
  if (D == 3 && scene.setting("friction_directions") == 2.0)
    solver.m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
  world_.setGravity(toBullet(scene.gravity));
  if (scene.convex) {
    // Bullet asks for the lowest corner alone; of boxes that is one of those they stand on.
    constexpr int directions = 8, mostPoints = 4;
    configuration_.setPlaneConvexMultipointIterations(directions, mostPoints);
    // Bullet takes a product of three moments below 2e-16 for 0, and leaves out Euler's term.
    double least = std::numeric_limits<double>::infinity();
    for (const DiskOf<D>& disk : scene.disks) least = std::min(least, disk.moments.z);
    if (least > 0.0 && std::isfinite(least)) mass_ = least;
  }
  for (const DiskOf<D>& disk : scene.disks) addDisk(disk);
  for (const BodyOf<D>& wall : scene.walls)
    for (std::size_t k = 0; k < wall.radius.size(); ++k)
      addWall(std::make_unique<btSphereShape>(wall.radius[k]), wall.position[k], wall.moves());
  for (const BodyOf<D>& wall : scene.walls)
    for (const auto& plane : wall.planes)
      addWall(std::make_unique<btStaticPlaneShape>(toBullet(plane.normal), 0.0), plane.point,
              wall.moves());
  if constexpr (D == 3)
    for (const BodyOf<D>& wall : scene.walls)
      for (const auto& cylinder : wall.cylinders)
        addWall(std::make_unique<HollowCylinderShape>(cylinder.axis, cylinder.radius),
                cylinder.point, wall.moves());
}

template <int D>
Space<D>::~Space() {
  for (auto& body : bodies_) world_.removeRigidBody(body.get());
}

template <int D>
btRigidBody& Space<D>::add(std::unique_ptr<btCollisionShape> shape, double mass,
                           const btVector3& inertia, const btTransform& pose) {
  btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shape.get(), inertia);
  info.m_startWorldTransform = pose;
  shapes_.push_back(std::move(shape));
  btRigidBody& body = *bodies_.emplace_back(std::make_unique<btRigidBody>(info));
  body.setUserIndex(static_cast<int>(bodies_.size()) - 1);
  body.setUserPointer(this);
  if (scene_.convex) body.setContactProcessingThreshold(contactMargin * scene_.smallest);
  return body;
}

template <int D>
void Space<D>::addDisk(const DiskOf<D>& disk) {
  const double round = disk.inertia;
  btVector3 inertia = disk.shape ? toBullet(disk.moments) : btVector3(round, round, round);
  for (int k = 0; k < 3; ++k)  // Bullet's 0: nothing turns it
    inertia[k] = std::isinf(inertia[k]) ? 0.0 : inertia[k] / mass_;
  btRigidBody& body = add(shapeOf(disk), disk.mass / mass_, inertia,
                          btTransform(turnOf(disk.turn), toBullet(disk.position)));
  if (D == 2) {
    body.setLinearFactor({1.0, 1.0, 0.0});
    body.setAngularFactor({0.0, 0.0, 1.0});
  }
  body.setLinearVelocity(toBullet(disk.velocity));
  body.setAngularVelocity(toBullet(disk.spin));
  body.setActivationState(DISABLE_DEACTIVATION);
  world_.addRigidBody(&body);
}

template <int D>
void Space<D>::addWall(std::unique_ptr<btCollisionShape> shape, Vector place, bool moves) {
  btRigidBody& body = add(std::move(shape), 0.0, {0.0, 0.0, 0.0},
                          btTransform(btQuaternion::getIdentity(), toBullet(place)));
  if (moves) {
    body.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
    body.setActivationState(DISABLE_DEACTIVATION);
  }
  world_.addRigidBody(&body);
}

template <int D>
template <typename Visit>
void Space<D>::forMovingWalls(const Visit& visit) {
  auto body = bodies_.begin() + static_cast<long>(scene_.disks.size());
  for (const BodyOf<D>& wall : scene_.walls)
    for (std::size_t k = 0; k < wall.position.size(); ++k, ++body)
      if (wall.moves()) visit(**body, wall, wall.position[k], wall.diskVelocity[k]);
  for (const BodyOf<D>& wall : scene_.walls)
    for (const auto& plane : wall.planes) {
      if (wall.moves()) visit(**body, wall, plane.point, wall.velocityAt(plane.point));
      ++body;
    }
  for (const BodyOf<D>& wall : scene_.walls)
    for (const auto& cylinder : wall.cylinders) {
      if (wall.moves()) visit(**body, wall, cylinder.point, wall.velocityAt(cylinder.point));
      ++body;
    }
}

template <int D>
void Space<D>::step(double next) {
  // Walls: where they are as the step begins, at the velocity of its middle, which takes them to
  // where they are at its end.
  forMovingWalls([](btRigidBody& body, const BodyOf<D>& wall, Vector place, Vector) {
    body.setWorldTransform(btTransform(turnOf(wall.angle), toBullet(place)));
  });
  for (BodyOf<D>& wall : scene_.walls) wall.at(next - 0.5 * scene_.dt);
  forMovingWalls([](btRigidBody& body, const BodyOf<D>& wall, Vector, Vector velocity) {
    body.setLinearVelocity(toBullet(velocity));
    body.setAngularVelocity(toBullet(wall.spin));
  });
  // Bullet forgets the contact points of two spheres before it looks for new ones, and keeps those
  // of a plane for a warm start; up to four then stand for one contact.
  for (int k = 0; k < dispatcher_.getNumManifolds(); ++k) {
    btPersistentManifold& manifold = *dispatcher_.getManifoldByIndexInternal(k);
    if (isSphere(manifold.getBody0()) || isSphere(manifold.getBody1())) manifold.clearManifold();
  }
  world_.stepSimulation(scene_.dt, 0);
  for (BodyOf<D>& wall : scene_.walls) wall.at(next);
  takeImpulses();
}

template <int D>
void Space<D>::takeImpulses() {
  auto& impulses = this->impulses_;
  impulses.clear();
  for (int k = 0; k < dispatcher_.getNumManifolds(); ++k) {
    btPersistentManifold& manifold = *dispatcher_.getManifoldByIndexInternal(k);
    const int a = manifold.getBody0()->getUserIndex(), b = manifold.getBody1()->getUserIndex();
    for (int c = 0; c < manifold.getNumContacts(); ++c) {
      btManifoldPoint& contact = manifold.getContactPoint(c);
      if (contact.getDistance() > manifold.getContactProcessingThreshold()) {
        contact.m_appliedImpulse = 0.0;  // of when it last acted
        continue;
      }
      const Vector normal = fromBullet<D>(contact.m_normalWorldOnB),
                   along = fromBullet<D>(contact.m_lateralFrictionDir1);
      TangentOf<D> tangential;
      SpinOf<D> rolling{};
      if constexpr (D == 2) {
        tangential = contact.m_appliedImpulseLateral1 * dot(along, turned(normal));
        rolling = contact.m_appliedImpulseLateral2;
      } else {
        tangential =
            contact.m_appliedImpulseLateral1 * along +
            contact.m_appliedImpulseLateral2 * fromBullet<D>(contact.m_lateralFrictionDir2);
      }
      impulses.push_back(PairImpulseOf<D>::between(
          a, b, normal, mass_ * contact.m_appliedImpulse, mass_ * tangential,
          fromBullet<D>(contact.getPositionWorldOnA()),
          fromBullet<D>(contact.getPositionWorldOnB()), rolling));
      impulses.back().depth = -contact.getDistance();
    }
  }
  std::sort(impulses.begin(), impulses.end(),
            [](const auto& a, const auto& b) { return std::pair(a.i, a.j) < std::pair(b.i, b.j); });
}

/// In the place of the impulse along a second direction of friction, which there is none of.
template <int D>
btScalar Space<D>::Solver::solveGroupCacheFriendlyFinish(btCollisionObject** bodies, int count,
                                                         const btContactSolverInfo& info) {
  for (int k = 0; D == 2 && k < m_tmpSolverContactRollingFrictionConstraintPool.size(); ++k) {
    const btSolverConstraint& row = m_tmpSolverContactRollingFrictionConstraintPool[k];
    void* const point =
        m_tmpSolverContactConstraintPool[row.m_frictionIndex].m_originalContactPoint;
    static_cast<btManifoldPoint*>(point)->m_appliedImpulseLateral2 +=
        row.m_appliedImpulse * row.m_relpos1CrossNormal.z();
  }
  return btSequentialImpulseConstraintSolver::solveGroupCacheFriendlyFinish(bodies, count, info);
}

/// Bullet multiplies the coefficients of two bodies; these are the pair's own.
template <int D>
btScalar Space<D>::pairRestitution(const btCollisionObject* a, const btCollisionObject* b) {
  return spaceOf<D>(a).scene_.restitution(a->getUserIndex(), b->getUserIndex());
}

template <int D>
btScalar Space<D>::pairFriction(const btCollisionObject* a, const btCollisionObject*) {
  return spaceOf<D>(a).scene_.friction;
}

template <int D>
btScalar Space<D>::pairRolling(const btCollisionObject* a, const btCollisionObject* b) {
  const auto& rolling = spaceOf<D>(a).scene_.rolling;
  return rolling ? rolling(a->getUserIndex(), b->getUserIndex()) : 0.0;
}

template <int D>
VectorOf<D> Space<D>::position(std::size_t disk) const {
  return fromBullet<D>(bodies_[disk]->getWorldTransform().getOrigin());
}

template <int D>
VectorOf<D> Space<D>::velocity(std::size_t disk) const {
  return fromBullet<D>(bodies_[disk]->getLinearVelocity());
}

template <int D>
SpinOf<D> Space<D>::spin(std::size_t disk) const {
  const btVector3& spin = bodies_[disk]->getAngularVelocity();
  if constexpr (D == 2)
    return spin.z();
  else
    return fromBullet<D>(spin);
}

template <int D>
OrientationOf<D> Space<D>::turn(std::size_t disk) const {
  const btQuaternion turn = bodies_[disk]->getWorldTransform().getRotation();
  if constexpr (D == 2)
    return 2.0 * std::atan2(turn.z(), turn.w());
  else
    return {turn.w(), turn.x(), turn.y(), turn.z()};
}

template class Space<2>;
template class Space<3>;

}  // namespace crossgrain_worker::bullet
