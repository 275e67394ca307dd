#pragma once

#include <btBulletDynamicsCommon.h>

#include <new>
#include <utility>

#include "crossgrain_walls.hpp"

namespace crossgrain_worker::bullet {

/// A hollow cylinder about an axis through its body's origin, which may turn about that axis.
/// Bullet's own cylinders are solid.
class HollowCylinderShape : public btConcaveShape {
 public:
  /// @param axis  of length 1
  HollowCylinderShape(Vector3 axis, double radius) : cylinder_{{}, axis, radius} {
    m_shapeType = CUSTOM_CONCAVE_SHAPE_TYPE;
  }

  /// @param place  from the body's origin
  CylinderOf<3>::Facing facing(const btVector3& place) const {
    return cylinder_.facing({place.x(), place.y(), place.z()});
  }

  void getAabb(const btTransform&, btVector3& low, btVector3& high) const override {
    low.setValue(-BT_LARGE_FLOAT, -BT_LARGE_FLOAT, -BT_LARGE_FLOAT);
    high.setValue(BT_LARGE_FLOAT, BT_LARGE_FLOAT, BT_LARGE_FLOAT);
  }
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
  using Wrapper = const btCollisionObjectWrapper*;

 public:
  SphereInCylinder(const btCollisionAlgorithmConstructionInfo& info, Wrapper first, Wrapper second)
      : btCollisionAlgorithm(info) {
    if (isCylinder(first)) std::swap(first, second);
    manifold_ =
        m_dispatcher->getNewManifold(first->getCollisionObject(), second->getCollisionObject());
  }
  ~SphereInCylinder() override { m_dispatcher->releaseManifold(manifold_); }
  SphereInCylinder(const SphereInCylinder&) = delete;
  SphereInCylinder& operator=(const SphereInCylinder&) = delete;

  void processCollision(Wrapper first, Wrapper second, const btDispatcherInfo&,
                        btManifoldResult* result) override {
    if (isCylinder(first)) std::swap(first, second);
    const auto& sphere = static_cast<const btSphereShape&>(*first->getCollisionShape());
    const auto& cylinder = static_cast<const HollowCylinderShape&>(*second->getCollisionShape());
    const btVector3& centre = first->getWorldTransform().getOrigin();
    const auto [n, distance] = cylinder.facing(centre - second->getWorldTransform().getOrigin());
    const btVector3 normal(n.x, n.y, n.z);
    const btScalar gap = distance - sphere.getRadius();
    result->setPersistentManifold(manifold_);
    if (gap < manifold_->getContactBreakingThreshold())
      result->addContactPoint(normal, centre - distance * normal, gap);
    result->refreshContactPoints();
  }
  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&,
                                 btManifoldResult*) override {
    return 1.0;  // as of planes: continuous collision is off
  }
  void getAllContactManifolds(btManifoldArray& manifolds) override {
    manifolds.push_back(manifold_);
  }

  struct Create : public btCollisionAlgorithmCreateFunc {
    btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                   Wrapper first, Wrapper second) override {
      void* const room = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(SphereInCylinder));
      return new (room) SphereInCylinder(info, first, second);
    }
  };

 private:
  static bool isCylinder(Wrapper object) {
    return object->getCollisionShape()->getShapeType() == CUSTOM_CONCAVE_SHAPE_TYPE;
  }

  btPersistentManifold* manifold_;
};

}  // namespace crossgrain_worker::bullet
