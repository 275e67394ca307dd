#include "engines/grain/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace grain {
namespace {

double defaultSkin(const Disks& disks) {
  return disks.size() == 0 ? 1.0 : 0.2 * *std::ranges::min_element(disks.radius);
}

}  // namespace

Simulation::Simulation(Setup setup)
    : law_(setup.law),
      bottom_(setup.bottom),
      integrator_(setup.integrator),
      gravityX_(setup.gravityX),
      gravityY_(setup.gravityY),
      dt_(setup.dt),
      skin_(setup.skin > 0.0 ? setup.skin : defaultSkin(setup.disks)),
      friction_(setup.law.friction()),
      moving_(setup.disks.size()),
      x_(std::move(setup.disks.x)),
      y_(std::move(setup.disks.y)),
      vx_(std::move(setup.disks.vx)),
      vy_(std::move(setup.disks.vy)),
      spin_(std::move(setup.disks.spin)),
      radius_(std::move(setup.disks.radius)),
      mass_(std::move(setup.disks.mass)),
      inertia_(std::move(setup.disks.inertia)),
      walls_(std::move(setup.walls)),
      neighbours_(moving_, skin_) {
  if (!(dt_ > 0.0)) throw std::invalid_argument("the time step must be > 0 s");
  for (const Wall& wall : walls_) {
    wallDiskBegin_.push_back(x_.size());
    planeBegin_.push_back(planes_.size());
    x_.insert(x_.end(), wall.diskX.begin(), wall.diskX.end());
    y_.insert(y_.end(), wall.diskY.begin(), wall.diskY.end());
    radius_.insert(radius_.end(), wall.diskRadius.begin(), wall.diskRadius.end());
    planes_.insert(planes_.end(), wall.planes.begin(), wall.planes.end());
    planeWall_.resize(planes_.size(), planeBegin_.size() - 1);
    wallStates_.push_back(wall.motion(0.0));
  }
  wallDiskBegin_.push_back(x_.size());
  planeBegin_.push_back(planes_.size());
  planeLoads_.resize(planes_.size());

  const std::size_t all = x_.size();
  for (auto* array : {&vx_, &vy_, &fx_, &fy_, &ux_, &uy_, &inverseMass_}) array->resize(all, 0.0);
  for (std::size_t i = 0; i < moving_; ++i) inverseMass_[i] = 1.0 / mass_[i];
  if (friction_) {
    for (auto* array : {&spin_, &us_, &torque_, &inverseInertia_}) array->resize(all, 0.0);
    for (std::size_t i = 0; i < moving_; ++i) inverseInertia_[i] = 1.0 / inertia_[i];
  }
  if (bottom_) {
    bottomX_.resize(moving_, 0.0);
    bottomY_.resize(moving_, 0.0);
  }

  // At t = 0 the velocities are given, so nothing is predicted and no damping is implicit.
  moveWalls();
  predictVelocities(0.0);
  findNeighbours();
  const Damping damping = std::exchange(law_.damping, Damping::lagged);
  evaluateForces();
  law_.damping = damping;
  if (integrator_ == Integrator::positionVerlet) {
    halfKick_ = 0.5 * dt_;  // from here on velocities live half a step before positions
    kick(-halfKick_);
  }
}

void Simulation::step() {
  const bool velocityVerlet = integrator_ == Integrator::velocityVerlet;
  kick(velocityVerlet ? 0.5 * dt_ : dt_);
  drift();
  ++steps_;
  moveWalls();
  const bool predict =
      law_.damping == Damping::predicted && integrator_ != Integrator::semiImplicitEuler;
  predictVelocities(predict ? 0.5 * dt_ : 0.0);
  if (neighbours_.outdated(x_, y_)) findNeighbours();
  evaluateForces();
  if (velocityVerlet) kick(0.5 * dt_);
}

void Simulation::kick(double dt) {
  for (std::size_t i = 0; i < moving_; ++i) {
    vx_[i] += dt * ax(i);
    vy_[i] += dt * ay(i);
  }
  if (!friction_) return;
  for (std::size_t i = 0; i < moving_; ++i) spin_[i] += dt * torque_[i] * inverseInertia_[i];
}

void Simulation::drift() {
  for (std::size_t i = 0; i < moving_; ++i) {
    x_[i] += dt_ * vx_[i];
    y_[i] += dt_ * vy_[i];
  }
}

/// The velocities that the dashpots see: the stored ones, carried on by half a step of the forces
/// of the step before.
void Simulation::predictVelocities(double half) {
  for (std::size_t i = 0; i < moving_; ++i) {
    ux_[i] = vx_[i] + half * ax(i);
    uy_[i] = vy_[i] + half * ay(i);
  }
  for (std::size_t i = moving_; i < x_.size(); ++i) {
    ux_[i] = vx_[i];
    uy_[i] = vy_[i];
  }
  if (!friction_) return;
  for (std::size_t i = 0; i < moving_; ++i)
    us_[i] = spin_[i] + half * torque_[i] * inverseInertia_[i];
  for (std::size_t i = moving_; i < x_.size(); ++i) us_[i] = spin_[i];
}

void Simulation::moveWalls() {
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    const Wall& wall = walls_[w];
    const WallState start = wall.motion(0.0);
    const WallState now = wall.motion(time());
    wallStates_[w] = now;
    const double c = std::cos(now.angle);
    const double s = std::sin(now.angle);
    for (std::size_t k = 0; k < wall.diskX.size(); ++k) {
      const std::size_t i = wallDiskBegin_[w] + k;
      const double dx = wall.diskX[k] - start.x;
      const double dy = wall.diskY[k] - start.y;
      const double distance =
          now.radialShift == 0.0 && now.radialVelocity == 0.0 ? 0.0 : std::sqrt(dx * dx + dy * dy);
      const double scale = distance > 0.0 ? 1.0 + now.radialShift / distance : 1.0;
      const double rx = scale * (c * dx - s * dy);
      const double ry = scale * (s * dx + c * dy);
      const double radial = distance > 0.0 ? now.radialVelocity / (distance * scale) : 0.0;
      x_[i] = now.x + rx;
      y_[i] = now.y + ry;
      vx_[i] = now.vx - now.spin * ry + radial * rx;
      vy_[i] = now.vy + now.spin * rx + radial * ry;
      if (friction_) spin_[i] = now.spin;
    }
    for (std::size_t k = 0; k < wall.planes.size(); ++k) {
      const Plane& at0 = wall.planes[k];
      const double dx = at0.x - start.x;
      const double dy = at0.y - start.y;
      planes_[planeBegin_[w] + k] = {now.x + c * dx - s * dy, now.y + s * dx + c * dy,
                                     c * at0.nx - s * at0.ny, s * at0.nx + c * at0.ny};
    }
  }
}

void Simulation::findNeighbours() {
  neighbours_.rebuild(x_, y_, radius_);
  contacts_.resize(neighbours_.pairCount() + moving_ * planes_.size());
  findPlaneNeighbours();
}

/// Planes move too, and nothing tracks how far, so every disk is listed with every plane: planes
/// are few, and the test of a disk against one costs as much as the test whether to list it.
void Simulation::findPlaneNeighbours() {
  if (!planeNeighbours_.empty() || planes_.empty()) return;
  for (std::size_t i = 0; i < moving_; ++i)
    for (std::size_t p = 0; p < planes_.size(); ++p)
      planeNeighbours_.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(p), 0.0});
}

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

WallLoad Simulation::wallLoad(std::size_t wall) const {
  WallLoad load;
  const WallState& now = wallStates_[wall];
  for (std::size_t i = wallDiskBegin_[wall]; i < wallDiskBegin_[wall + 1]; ++i) {
    load.fx += fx_[i];
    load.fy += fy_[i];
    load.torque += (x_[i] - now.x) * fy_[i] - (y_[i] - now.y) * fx_[i];
    if (friction_) load.torque += torque_[i];
  }
  for (std::size_t p = planeBegin_[wall]; p < planeBegin_[wall + 1]; ++p) {
    load.fx += planeLoads_[p].fx;
    load.fy += planeLoads_[p].fy;
    load.torque += planeLoads_[p].torque;
  }
  return load;
}

double Simulation::kineticEnergy() const {
  double energy = 0.0;
  for (std::size_t i = 0; i < moving_; ++i) {
    const double vx = velocityX(i);
    const double vy = velocityY(i);
    energy += 0.5 * mass_[i] * (vx * vx + vy * vy);
    if (friction_) energy += 0.5 * inertia_[i] * spin(i) * spin(i);
  }
  return energy;
}

double Simulation::elasticEnergy() const {
  double energy = 0.0;
  for (const Contact& contact : contacts())
    energy += 0.5 * law_.kn * contact.overlap * contact.overlap +
              0.5 * law_.kt * contact.spring * contact.spring;
  return energy;
}

}  // namespace grain
