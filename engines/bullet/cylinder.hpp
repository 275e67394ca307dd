#pragma once

#include <btBulletDynamicsCommon.h>

#include "crossgrain_walls.hpp"

namespace crossgrain_worker::bullet {

/// A hollow cylinder about an axis through its body's origin, which may turn about that axis.
/// Bullet's own cylinders are solid.
class HollowCylinderShape : public btConcaveShape {
 public:
  /// @param axis  of length 1
  HollowCylinderShape(Vector3 axis, double radius);

  /// @param place  from the body's origin
  CylinderOf<3>::Facing facing(const btVector3& place) const;

  void getAabb(const btTransform& body, btVector3& low, btVector3& high) const override;
  /// It has none: spheres meet it by the algorithm below, and nothing else moves.
  void processAllTriangles(btTriangleCallback*, const btVector3&, const btVector3&) const override {
  }
  void setLocalScaling(const btVector3&) override {}
  const btVector3& getLocalScaling() const override { return scaling_; }
  void calculateLocalInertia(btScalar, btVector3& inertia) const override { inertia.setZero(); }
  const char* getName() const override { return "HollowCylinder"; }

 private:
  CylinderOf<3> cylinder_;
  btVector3 scaling_{1.0, 1.0, 1.0};
};

/// A sphere meets a hollow cylinder as the plane that touches there, which is how
/// btConvexPlaneCollisionAlgorithm has it.
class SphereInCylinder : public btCollisionAlgorithm {
 public:
  SphereInCylinder(const btCollisionAlgorithmConstructionInfo& info,
                   const btCollisionObjectWrapper* first, const btCollisionObjectWrapper* second);
  ~SphereInCylinder() override;
  SphereInCylinder(const SphereInCylinder&) = delete;
  SphereInCylinder& operator=(const SphereInCylinder&) = delete;

  void processCollision(const btCollisionObjectWrapper* first,
                        const btCollisionObjectWrapper* second, const btDispatcherInfo& how,
                        btManifoldResult* result) override;
  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&,
                                 btManifoldResult*) override {
    return 1.0;  // as of planes: continuous collision is off
  }
  void getAllContactManifolds(btManifoldArray& manifolds) override {
    manifolds.push_back(manifold_);
  }

  struct Create : public btCollisionAlgorithmCreateFunc {
    btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                   const btCollisionObjectWrapper* first,
                                                   const btCollisionObjectWrapper* second) override;
  };

 private:
  btPersistentManifold* manifold_;
};

}  // namespace crossgrain_worker::bullet
