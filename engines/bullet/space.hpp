#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "crossgrain_impulse_space.hpp"
#include "cylinder.hpp"

namespace crossgrain_worker::bullet {

/// Bullet's world of spheres, in the plane their centres stay at z = 0; SI units, walls moved as
/// prescribed. A step solves for new velocities where disks are, then moves them. Bullet keeps
/// mixing rules and margins in globals, which the last space that was made has set.
template <int D>
class Space : public ImpulseSpaceOf<D> {
 public:
  explicit Space(const ImpulseSceneOf<D>& scene);
  ~Space() override;

  void step(double next) override;
  VectorOf<D> position(std::size_t disk) const override;
  VectorOf<D> velocity(std::size_t disk) const override;
  SpinOf<D> spin(std::size_t disk) const override;
  OrientationOf<D> turn(std::size_t disk) const override;

 private:
  using Vector = VectorOf<D>;

  /// Bullet works the velocity of a wall out from its poses; here it is prescribed, too.
  class World : public btDiscreteDynamicsWorld {
   public:
    using btDiscreteDynamicsWorld::btDiscreteDynamicsWorld;

   private:
    void saveKinematicState(btScalar) override {}
  };

  /// Keeps what acted against rolling in the plane, too, which Bullet forgets.
  class Solver : public btSequentialImpulseConstraintSolver {
    btScalar solveGroupCacheFriendlyFinish(btCollisionObject** bodies, int count,
                                           const btContactSolverInfo& info) override;
  };

  void addDisk(const DiskOf<D>& disk);
  void addWall(std::unique_ptr<btCollisionShape> shape, Vector place, bool moves);
  btRigidBody& add(std::unique_ptr<btCollisionShape> shape, double mass, const btVector3& inertia,
                   const btTransform& pose);
  /// @param visit  (body, wall, place, velocity) of each wall disk, plane and cylinder that moves
  template <typename Visit>
  void forMovingWalls(const Visit& visit);
  void takeImpulses();

  static btScalar pairRestitution(const btCollisionObject* a, const btCollisionObject* b);
  static btScalar pairFriction(const btCollisionObject* a, const btCollisionObject* b);
  static btScalar pairRolling(const btCollisionObject* a, const btCollisionObject* b);

  ImpulseSceneOf<D> scene_;
  double mass_ = 1.0;  ///< Bullet's unit [kg]
  btDefaultCollisionConfiguration configuration_;
  SphereInCylinder::Create sphereInCylinder_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  Solver solver_;
  World world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;  ///< by id: disks, then walls
};

}  // namespace crossgrain_worker::bullet
