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
