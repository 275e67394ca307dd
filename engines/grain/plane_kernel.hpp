#pragma once

#include "engines/grain/contact_force.hpp"
#include "engines/grain/kernels.hpp"

namespace grain {

/// The law of a disk with the plane: of a law without materials that one itself.
template <class L, class Real>
GRAIN_INLINE const L& lawAtPlane(const L& law, const ContactView<Real>&, const PlaneView<Real>&,
                                 std::size_t) {
  return law;
}
template <HasMaterials L, class Real>
GRAIN_INLINE L lawAtPlane(const L& law, const ContactView<Real>& disks,
                          const PlaneView<Real>& plane, std::size_t i) {
  L own = law;
  const GeneralLaw<Real>& constants = disks.lawOf(disks.material[i], plane.material);
  forPairConstants(
      law, [&](std::size_t, auto member) GRAIN_INLINE_LAMBDA { own.*member = constants.*member; });
  return own;
}

/// Disks begin … end−1 against one plane. Planes are few and few disks touch one, so disks are
/// taken one by one.
template <class L, class Real>
static std::size_t planeKernel(const GeneralLaw<Real>& general, const ContactView<Real>& disks,
                               const PlaneView<Real>& plane, std::size_t begin, std::size_t end) {
  const L common(general);
  std::size_t touching = 0;
  for (std::size_t i = begin; i < end; ++i) {
    // Origin and plane first: where the disk touches their difference is small.
    Vec<double> origin{0.0, 0.0};
    if constexpr (hasLocalCoordinates<Real>)
      origin = {static_cast<double>(plane.origin[i].x), static_cast<double>(plane.origin[i].y)};
    const Real dx = static_cast<Real>(origin.x - plane.x) + disks.position[i].x;
    const Real dy = static_cast<Real>(origin.y - plane.y) + disks.position[i].y;
    const Real height = dx * plane.nx + dy * plane.ny;
    const Real overlap = disks.radius[i] - height;
    // Parts that the law does not have are not compiled.
    Real spring = plane.kept.spring == nullptr ? Real(0) : plane.kept.spring[i];
    Real angle = common.rolling == RollingLaw::spring ? plane.kept.angle[i] : Real(0);
    Real memory = remembers(common) ? plane.kept.memory[i] : Real(0);
    Real rest = remembersRest(common) ? plane.kept.rest[i] : Real(0);
    bool touches = overlap > Real(0);
    if (common.cohesion == CohesionLaw::jkr) {
      memory = isBonded(lawAtPlane(common, disks, plane, i), overlap, disks.radius[i], memory);
      touches = memory > Real(0);
    }
    ContactForce<Real> force{Real(0), Real(0), Real(0), Real(0)};
    RollingTorque<Real> resistance{Real(0), Real(0)};
    if (touches) {
      const L& law = lawAtPlane(common, disks, plane, i);
      const Real reach = planePoint(law, disks.radius[i], height);
      const Real armX = static_cast<Real>(plane.x) + dx - reach * plane.nx - plane.centreX;
      const Real armY = static_cast<Real>(plane.y) + dy - reach * plane.ny - plane.centreY;
      const Real vx = disks.velocity[i].x - (plane.vx - plane.spin * armY);
      const Real vy = disks.velocity[i].y - (plane.vy + plane.spin * armX);
      const Real lever = planeArmOf(law.lever, law.planeLever, disks.radius[i], height);
      const Real arm = planeArmOf(law.velocityLever, law.planeLever, disks.radius[i], height);
      ContactMotion<Real> motion{};
      motion.overlap = overlap;
      motion.normalVelocity = vx * plane.nx + vy * plane.ny;
      motion.tangentialVelocity = vy * plane.nx - vx * plane.ny;
      motion.radius = disks.radius[i];
      if (law.damper == Damper::critical) motion.mass = Real(1) / disks.inverseMass[i];
      if (law.rotation) motion.tangentialVelocity -= arm * disks.spin[i];
      if (seesCompliances(law)) {
        motion.normalCompliance = law.halfStep * disks.inverseMass[i];
        motion.tangentialCompliance = motion.normalCompliance;
        if (law.rotation)
          motion.tangentialCompliance += law.halfStep * arm * lever * disks.inverseInertia[i];
      }
      force = contactForce(law, motion, spring, memory, rest);
      disks.force[i].x += force.normal * plane.nx - force.tangential * plane.ny;
      disks.force[i].y += force.normal * plane.ny + force.tangential * plane.nx;
      if (law.rotation) disks.torque[i] -= lever * force.tangential;
      if (law.rolling != RollingLaw::none) {
        RollingMotion<Real> rolling =
            rollingMotion(law, disks.radius[i], Real(0), disks.spin[i] - plane.spin);
        if (seesRollingInertia(law))
          rolling.inertia =
              Real(1) /
              inverseRollingInertia(disks.inverseMass[i], disks.inverseInertia[i], disks.radius[i]);
        resistance = rollingTorque(law, rolling, motion, force.load, angle);
        disks.torque[i] += resistance.torque;
      }
      ++touching;
    } else {
      spring = angle = memory = rest = Real(0);
    }
    if (plane.kept.spring != nullptr) plane.kept.spring[i] = spring;
    if (common.rolling == RollingLaw::spring) plane.kept.angle[i] = angle;
    if (remembers(common)) plane.kept.memory[i] = memory;
    if (remembersRest(common)) plane.kept.rest[i] = rest;
    if (plane.normal != nullptr) {
      plane.overlap[i] = overlap;
      plane.normal[i] = force.normal;
      plane.tangential[i] = force.tangential;
      plane.sliding[i] = force.sliding;
    }
    if (common.rolling != RollingLaw::none && plane.rolling != nullptr) {
      plane.rolling[i] = resistance.torque;
      plane.rollingSlides[i] = resistance.sliding;
    }
  }
  return touching;
}

}  // namespace grain
