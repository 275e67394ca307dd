#include <algorithm>
#include <cmath>

#include "engines/grain/simulation.hpp"

namespace grain {

void Simulation::evaluateForces() {
  std::ranges::fill(fx_, 0.0);
  std::ranges::fill(fy_, 0.0);
  std::ranges::fill(planeLoads_, WallLoad{});
  contactCount_ = 0;
  if (friction_) {
    std::ranges::fill(torque_, 0.0);
    addPairForces<true>();
    addPlaneForces<true>();
  } else {
    addPairForces<false>();
    addPlaneForces<false>();
  }
  if (bottom_) addBottomForces();
  if (gravityX_ != 0.0 || gravityY_ != 0.0) {
    for (std::size_t i = 0; i < moving_; ++i) {
      fx_[i] += mass_[i] * gravityX_;
      fy_[i] += mass_[i] * gravityY_;
    }
  }
  contactEvaluations_ += contactCount_;
}

template <bool Friction>
void Simulation::addPairForces() {
  const double implicit = law_.damping == Damping::implicit ? 0.5 * dt_ : 0.0;
  for (std::size_t i = 0; i < moving_; ++i) {
    for (std::size_t pair = neighbours_.rowBegin(i); pair < neighbours_.rowEnd(i); ++pair) {
      const auto j = static_cast<std::size_t>(neighbours_.partner(pair));
      const double dx = x_[i] - x_[j];
      const double dy = y_[i] - y_[j];
      const double reach = radius_[i] + radius_[j];
      const double distance2 = dx * dx + dy * dy;
      if (distance2 >= reach * reach) {
        neighbours_.spring(pair) = 0.0;
        continue;
      }
      const double distance = std::sqrt(distance2);
      const double nx = dx / distance;
      const double ny = dy / distance;
      const double overlap = reach - distance;
      const double vx = ux_[i] - ux_[j];
      const double vy = uy_[i] - uy_[j];

      ContactMotion motion{overlap, vx * nx + vy * ny, 0.0,
                           implicit * (inverseMass_[i] + inverseMass_[j]), 0.0};
      const double leverI = Friction ? leverArm(law_, radius_[i], radius_[j], overlap) : 0.0;
      const double leverJ = Friction ? leverArm(law_, radius_[j], radius_[i], overlap) : 0.0;
      if constexpr (Friction) {
        motion.tangentialVelocity = -vx * ny + vy * nx - leverI * us_[i] - leverJ * us_[j];
        motion.tangentialCompliance =
            motion.normalCompliance + implicit * (leverI * leverI * inverseInertia_[i] +
                                                  leverJ * leverJ * inverseInertia_[j]);
      }
      const ContactForce force = contactForce(law_, motion, neighbours_.spring(pair), dt_);

      const double forceX = force.normal * nx - force.tangential * ny;
      const double forceY = force.normal * ny + force.tangential * nx;
      fx_[i] += forceX;
      fy_[i] += forceY;
      fx_[j] -= forceX;
      fy_[j] -= forceY;
      if constexpr (Friction) {
        torque_[i] -= leverI * force.tangential;
        torque_[j] -= leverJ * force.tangential;
      }
      contacts_[contactCount_++] = {static_cast<std::int32_t>(i),
                                    static_cast<std::int32_t>(j),
                                    nx,
                                    ny,
                                    overlap,
                                    force.normal,
                                    force.tangential,
                                    neighbours_.spring(pair),
                                    force.sliding};
    }
  }
}

template <bool Friction>
void Simulation::addPlaneForces() {
  const double implicit = law_.damping == Damping::implicit ? 0.5 * dt_ : 0.0;
  for (PlaneContact& neighbour : planeNeighbours_) {
    const auto i = static_cast<std::size_t>(neighbour.disk);
    const auto p = static_cast<std::size_t>(neighbour.plane);
    const Plane& plane = planes_[p];
    const double height = (x_[i] - plane.x) * plane.nx + (y_[i] - plane.y) * plane.ny;
    const double overlap = radius_[i] - height;
    if (overlap <= 0.0) {
      neighbour.spring = 0.0;
      continue;
    }
    const double footX = x_[i] - height * plane.nx;
    const double footY = y_[i] - height * plane.ny;
    const WallState& wall = wallStates_[planeWall_[p]];
    const double vx = ux_[i] - (wall.vx - wall.spin * (footY - wall.y));
    const double vy = uy_[i] - (wall.vy + wall.spin * (footX - wall.x));

    ContactMotion motion{overlap, vx * plane.nx + vy * plane.ny, 0.0, implicit * inverseMass_[i],
                         0.0};
    // The plane does not yield, so the contact point lies on it: a disk of infinite radius.
    const double lever = law_.lever == Lever::radius ? radius_[i] : height;
    if constexpr (Friction) {
      motion.tangentialVelocity = -vx * plane.ny + vy * plane.nx - lever * us_[i];
      motion.tangentialCompliance =
          motion.normalCompliance + implicit * lever * lever * inverseInertia_[i];
    }
    const ContactForce force = contactForce(law_, motion, neighbour.spring, dt_);

    const double forceX = force.normal * plane.nx - force.tangential * plane.ny;
    const double forceY = force.normal * plane.ny + force.tangential * plane.nx;
    fx_[i] += forceX;
    fy_[i] += forceY;
    if constexpr (Friction) torque_[i] -= lever * force.tangential;
    planeLoads_[p].fx -= forceX;
    planeLoads_[p].fy -= forceY;
    planeLoads_[p].torque -= (footX - wall.x) * forceY - (footY - wall.y) * forceX;
    contacts_[contactCount_++] = {neighbour.disk,   static_cast<std::int32_t>(x_.size() + p),
                                  plane.nx,         plane.ny,
                                  overlap,          force.normal,
                                  force.tangential, neighbour.spring,
                                  force.sliding};
  }
}

void Simulation::addBottomForces() {
  for (std::size_t i = 0; i < moving_; ++i) {
    const BottomForce force = bottomForce(*bottom_, mass_[i], radius_[i], ux_[i], uy_[i],
                                          friction_ ? us_[i] : 0.0, bottomX_[i], bottomY_[i], dt_);
    fx_[i] += force.x;
    fy_[i] += force.y;
    if (friction_) torque_[i] += force.torque;
  }
}

}  // namespace grain
