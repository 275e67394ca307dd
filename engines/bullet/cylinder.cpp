#include "cylinder.hpp"

#include <new>
#include <utility>

namespace crossgrain_worker::bullet {

HollowCylinderShape::HollowCylinderShape(Vector3 axis, double radius)
    : cylinder_{{}, axis, radius} {
  m_shapeType = CUSTOM_CONCAVE_SHAPE_TYPE;
}

CylinderOf<3>::Facing HollowCylinderShape::facing(const btVector3& place) const {
  return cylinder_.facing({place.x(), place.y(), place.z()});
}

void HollowCylinderShape::getAabb(const btTransform&, btVector3& low, btVector3& high) const {
  low.setValue(-BT_LARGE_FLOAT, -BT_LARGE_FLOAT, -BT_LARGE_FLOAT);
  high.setValue(BT_LARGE_FLOAT, BT_LARGE_FLOAT, BT_LARGE_FLOAT);
}

namespace {

using Wrapper = const btCollisionObjectWrapper*;

bool isCylinder(Wrapper object) {
  return object->getCollisionShape()->getShapeType() == CUSTOM_CONCAVE_SHAPE_TYPE;
}

}  // namespace

SphereInCylinder::SphereInCylinder(const btCollisionAlgorithmConstructionInfo& info, Wrapper first,
                                   Wrapper second)
    : btCollisionAlgorithm(info) {
  if (isCylinder(first)) std::swap(first, second);
  manifold_ =
      m_dispatcher->getNewManifold(first->getCollisionObject(), second->getCollisionObject());
}

SphereInCylinder::~SphereInCylinder() {
  m_dispatcher->releaseManifold(manifold_);
}

void SphereInCylinder::processCollision(Wrapper first, Wrapper second, const btDispatcherInfo&,
                                        btManifoldResult* result) {
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

btCollisionAlgorithm* SphereInCylinder::Create::CreateCollisionAlgorithm(
    btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* first,
    const btCollisionObjectWrapper* second) {
  void* const room = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(SphereInCylinder));
  return new (room) SphereInCylinder(info, first, second);
}

}  // namespace crossgrain_worker::bullet
