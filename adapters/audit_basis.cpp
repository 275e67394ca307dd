#include "adapters/audit_basis.hpp"

#include <algorithm>
#include <cmath>

#include "adapters/suitability.hpp"

namespace crossgrain {
namespace {

/// Fastest that a body's motion moves any of its members [m/s].
double fastestOf(const WallBody& body) {
  double arm = 0.0;
  for (const Vec2& place : body.diskPosition) arm = std::max(arm, (place - body.centre).norm());
  for (const Plane& plane : body.planes) arm = std::max(arm, (plane.point - body.centre).norm());
  const Motion& motion = body.motion;
  switch (motion.kind) {
    case Motion::Kind::fixed:
      return 0.0;
    case Motion::Kind::rotating:
      return std::abs(motion.angularVelocity) * arm;
    case Motion::Kind::translating:
      return motion.velocity.norm();
    case Motion::Kind::oscillating:
      return std::abs(motion.frequency) * motion.amplitude.norm();
    case Motion::Kind::radial:
      return std::abs(motion.radialVelocity);
  }
  return 0.0;
}

void measurePlaces(const Scene& scene, AuditBasis& basis) {
  std::vector<Vec2> places = scene.disks.position;
  for (const WallBody& body : scene.bodies) {
    places.insert(places.end(), body.diskPosition.begin(), body.diskPosition.end());
    for (const Plane& plane : body.planes) places.push_back(plane.point);
  }
  if (places.empty()) return;
  Vec2 low = places.front(), high = places.front();
  for (const Vec2& place : places) {
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  const double largest =
      basis.radius.empty() ? 0.0 : *std::max_element(basis.radius.begin(), basis.radius.end());
  basis.middle = 0.5 * (low + high);
  basis.extent = 0.5 * (high - low).norm() + largest;
  basis.farthest = basis.middle.norm() + basis.extent;
}

}  // namespace

AuditBasis auditBasis(const Scene& scene) {
  AuditBasis basis;
  basis.scene = &scene;
  basis.prescribed = false;
  basis.rounding = 1e-6;
  basis.radius = scene.disks.radius;
  for (const WallBody& body : scene.bodies) {
    basis.radius.insert(basis.radius.end(), body.diskRadius.begin(), body.diskRadius.end());
    basis.fastest = std::max(basis.fastest, fastestOf(body));
  }
  for (std::size_t i = 0; i < scene.disks.size(); ++i)
    basis.fastest = std::max(basis.fastest, scene.disks.velocity[i].norm());
  measurePlaces(scene, basis);
  return basis;
}

AuditBasis auditBasis(const Scene& scene, const Capabilities& can,
                      const EffectiveParameters& effective) {
  AuditBasis basis = auditBasis(scene);
  basis.dt = effective.dt;
  basis.byOverlap = scene.law.soft() && hasNormalLaw(can, scene.law);
  basis.prescribed = true;
  basis.rounding = effective.precision == toString(Precision::float32) ? 1e-6 : 1e-10;
  return basis;
}

}  // namespace crossgrain
