#include "space.hpp"

#include <algorithm>
#include <cmath>
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

/// How far apart a disk and a plane may be and be in contact, in smallest radii: far below what a
/// disk moves in a step, and above rounding, by which Bullet would lose contacts that touch.
constexpr double contactMargin = 1e-6;

template <int D>
const Space<D>& spaceOf(const btCollisionObject* object) {
  return *static_cast<const Space<D>*>(object->getUserPointer());
}

}  // namespace

template <int D>
Space<D>::Space(const ImpulseSceneOf<D>& scene) : scene_(scene) {
  // Globals of Bullet. The margins are 0.02 m and 0.05 m otherwise: planes would act from afar, and
  // all disks of a small scene be neighbours.
  gContactBreakingThreshold = contactMargin * scene.smallest;
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
btRigidBody& Space<D>::add(std::unique_ptr<btCollisionShape> shape, double mass, double inertia,
                           Vector place) {
  btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shape.get(),
                                                {inertia, inertia, inertia});
  info.m_startWorldTransform.setOrigin(toBullet(place));
  shapes_.push_back(std::move(shape));
  btRigidBody& body = *bodies_.emplace_back(std::make_unique<btRigidBody>(info));
  body.setUserIndex(static_cast<int>(bodies_.size()) - 1);
  body.setUserPointer(this);
  return body;
}

template <int D>
void Space<D>::addDisk(const DiskOf<D>& disk) {
  const double inertia =
      std::isinf(disk.inertia) ? 0.0 : disk.inertia;  // Bullet's 0: none turns it
  btRigidBody& body =
      add(std::make_unique<btSphereShape>(disk.radius), disk.mass, inertia, disk.position);
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
  btRigidBody& body = add(std::move(shape), 0.0, 0.0, place);
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
  for (int k = 0; k < dispatcher_.getNumManifolds(); ++k)
    dispatcher_.getManifoldByIndexInternal(k)->clearManifold();
  world_.stepSimulation(scene_.dt, 0);
  for (BodyOf<D>& wall : scene_.walls) wall.at(next);
  takeImpulses();
}

template <int D>
void Space<D>::takeImpulses() {
  auto& impulses = this->impulses_;
  impulses.clear();
  for (int k = 0; k < dispatcher_.getNumManifolds(); ++k) {
    const btPersistentManifold& manifold = *dispatcher_.getManifoldByIndexInternal(k);
    const int a = manifold.getBody0()->getUserIndex(), b = manifold.getBody1()->getUserIndex();
    for (int c = 0; c < manifold.getNumContacts(); ++c) {
      const btManifoldPoint& contact = manifold.getContactPoint(c);
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
      impulses.push_back(
          PairImpulseOf<D>::between(a, b, normal, contact.m_appliedImpulse, tangential,
                                    fromBullet<D>(contact.getPositionWorldOnA()),
                                    fromBullet<D>(contact.getPositionWorldOnB()), rolling));
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

template class Space<2>;
template class Space<3>;

}  // namespace crossgrain_worker::bullet
