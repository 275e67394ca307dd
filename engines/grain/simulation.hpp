#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engines/grain/bottom.hpp"
#include "engines/grain/law.hpp"
#include "engines/grain/neighbours.hpp"
#include "engines/grain/walls.hpp"

namespace grain {

/// State of disks, structure of arrays [SI units].
struct Disks {
  std::vector<double> x, y, vx, vy, spin, radius, mass, inertia;

  std::size_t size() const { return radius.size(); }
};

enum class Precision { float64, float32 };

/// Everything a simulation starts from.
struct Setup {
  Disks disks;
  std::vector<Wall> walls;
  Law law;
  std::optional<Bottom> bottom;
  double gravityX = 0.0, gravityY = 0.0;  ///< [m/s²]
  double dt = 0.0;                        ///< [s]
  Integrator integrator = Integrator::positionVerlet;
  double skin = 0.0;     ///< of the Verlet list [m]; 0: a fifth of the smallest radius
  bool rotation = true;  ///< false: friction without any disk spinning
  Precision precision = Precision::float64;
  int threads = 1;
};

/// One contact of the last force evaluation; the force acts on i, n points from j to i.
/// Ids: moving disks, then wall disks wall by wall, then planes wall by wall.
struct Contact {
  std::int32_t i, j;
  double nx, ny;
  double overlap;
  double normalForce, tangentialForce;
  double spring;  ///< ξ after the evaluation [m]
  bool sliding;
};

/// Disks that touch softly, in two dimensions.
///
///   kick: v += a dt   drift: x += v dt   move walls   forces: a(x, v)
///
/// Positions and forces belong to the same time t = steps·dt after each step. Without friction no
/// spin is ever read or written.
class Simulation {
 public:
  explicit Simulation(Setup setup);

  void step();
  void advance(std::uint64_t steps) {
    for (std::uint64_t k = 0; k < steps; ++k) step();
  }

  /// Lists the neighbours anew, as the step does when the list is outdated.
  void findNeighbours();

  std::uint64_t steps() const { return steps_; }
  double time() const { return static_cast<double>(steps_) * dt_; }
  double dt() const { return dt_; }
  std::size_t movingCount() const { return moving_; }

  /// Positions of moving disks, then of wall disks.
  std::span<const double> x() const { return x_; }
  std::span<const double> y() const { return y_; }
  /// Velocities and spins of the moving disks at time() [second order for both Verlet schemes].
  double velocityX(std::size_t i) const { return vx_[i] + halfKick_ * ax(i); }
  double velocityY(std::size_t i) const { return vy_[i] + halfKick_ * ay(i); }
  double spin(std::size_t i) const {
    return friction_ ? spin_[i] + halfKick_ * torque_[i] * inverseInertia_[i] : spin_[i];
  }

  /// Contacts of the last force evaluation, that is at time().
  std::span<const Contact> contacts() const { return {contacts_.data(), contactCount_}; }
  std::uint64_t contactEvaluations() const { return contactEvaluations_; }
  std::size_t neighbourRebuilds() const { return neighbours_.rebuilds(); }

  WallState wallState(std::size_t wall) const { return wallStates_[wall]; }
  WallLoad wallLoad(std::size_t wall) const;

  /// ½ m v² + ½ J ω² of the moving disks at time() [J].
  double kineticEnergy() const;
  /// ½ k_n δ² + ½ k_t ξ² over the contacts [J].
  double elasticEnergy() const;

 private:
  struct PlaneContact {
    std::int32_t disk, plane;
    double spring;
  };

  double ax(std::size_t i) const { return fx_[i] * inverseMass_[i]; }
  double ay(std::size_t i) const { return fy_[i] * inverseMass_[i]; }
  void kick(double dt);
  void drift();
  void predictVelocities(double half);
  void moveWalls();
  void findPlaneNeighbours();
  void evaluateForces();
  template <bool Friction>
  void addPairForces();
  template <bool Friction>
  void addPlaneForces();
  void addBottomForces();

  Law law_;
  std::optional<Bottom> bottom_;
  Integrator integrator_;
  double gravityX_, gravityY_, dt_, skin_;
  bool friction_;          ///< spins, torques and springs exist
  double halfKick_ = 0.0;  ///< from the stored velocity to the one at time() [s]
  std::size_t moving_;
  std::uint64_t steps_ = 0, contactEvaluations_ = 0;

  // Moving disks, then wall disks.
  std::vector<double> x_, y_, vx_, vy_, spin_, radius_;
  std::vector<double> ux_, uy_, us_;  ///< the velocities that the dashpots see
  std::vector<double> fx_, fy_, torque_;
  std::vector<double> inverseMass_, inverseInertia_;  ///< 0 for wall disks
  std::vector<double> mass_, inertia_;                ///< moving disks only
  std::vector<double> bottomX_, bottomY_;             ///< springs to the plate [m]

  std::vector<Wall> walls_;
  std::vector<WallState> wallStates_;
  std::vector<std::size_t> wallDiskBegin_, planeBegin_;  ///< per wall, one more at the end
  std::vector<Plane> planes_;                            ///< as they stand now
  std::vector<std::size_t> planeWall_;
  std::vector<WallLoad> planeLoads_;

  Neighbours neighbours_;
  std::vector<PlaneContact> planeNeighbours_;
  std::vector<Contact> contacts_;  ///< the first contactCount_ count; room for every listed pair
  std::size_t contactCount_ = 0;
};

}  // namespace grain
