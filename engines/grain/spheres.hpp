#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "engines/grain/law_types.hpp"
#include "engines/grain/space_law.hpp"

namespace grain {

/// A plane wall in space that moves without turning.
struct SpaceWall {
  struct Plane {
    Vec3<double> point, normal;  ///< at t = 0; of length 1, into the free side
  };
  struct State {
    Vec3<double> centre, velocity;
  };
  std::vector<Plane> planes;
  std::function<State(double t)> motion;
};

/// Everything a simulation of spheres starts from [SI units]. As Setup, in space.
struct SpheresSetup {
  std::vector<Vec3<double>> position, velocity, spin;
  std::vector<double> radius, mass, inertia;
  std::vector<SpaceWall> walls;
  Law law;  ///< linear, constant dampers; frictionless or with springs
  SpaceConventions conventions;
  Vec3<double> gravity;
  double dt = 0.0;
  Integrator integrator = Integrator::positionVerlet;
  bool rotation = true;
  double skin = 0.0;        ///< of the neighbour list [m]; 0: half the smallest radius
  double maxOverlap = 1.0;  ///< as in Setup
};

/// One contact of the last force evaluation; the force acts on i, n points from j to i. Numbers:
/// spheres, then planes wall by wall.
struct SpaceContact {
  std::int32_t i, j;
  Vec3<double> normal;
  double overlap;
  double normalForce;
  Vec3<double> tangentialForce;
  bool sliding;
};

/// Spheres that touch softly, in space: the scheme of Simulation with vectors, in double precision
/// and on one thread.
///
///   kick: v += a dt   drift: x += v dt   move walls   forces: a(x, v)
///
/// The same setup gives the same bits in every run and with any skin: forces are summed in the
/// order of pairs, and a pair that does not touch adds nothing.
class Spheres {
 public:
  /// @throws std::invalid_argument for a step that is not > 0, and for a law that it does not have
  explicit Spheres(SpheresSetup setup);

  /// @throws std::runtime_error naming a sphere whose position is not finite, or two that overlap
  /// too much
  void advance(std::uint64_t steps);

  std::uint64_t steps() const { return steps_; }
  double time() const { return setup_.dt * static_cast<double>(steps_); }
  double dt() const { return setup_.dt; }
  std::size_t size() const { return setup_.radius.size(); }
  bool rotates() const { return law_.rotation; }

  const Vec3<double>& position(std::size_t i) const { return setup_.position[i]; }
  Vec3<double> velocity(std::size_t i) const;  ///< at time()
  Vec3<double> spin(std::size_t i) const;      ///< at time()

  /// Of the last force evaluation, by ascending i, j.
  std::vector<SpaceContact> contacts() const;
  std::uint64_t contactEvaluations() const { return evaluations_; }
  std::uint64_t rebuilds() const { return rebuilds_; }

  SpaceWall::State wallState(std::size_t w) const { return setup_.walls[w].motion(time()); }
  /// On a wall: the force [N], and its torque about the wall's centre [N m].
  std::pair<Vec3<double>, Vec3<double>> wallLoad(std::size_t w) const;

 private:
  /// Two bodies that are near each other, and what their contact remembers.
  struct Pair {
    std::int32_t i, j;  ///< j < 0: plane −1 − j
    bool touches = false, sliding = false;
    Vec3<double> normal;       ///< while it touches
    Vec3<double> spring;       ///< ξ [m]
    double overlap = 0.0;      ///< [m]
    double normalForce = 0.0;  ///< [N]
    Vec3<double> tangential;   ///< [N]
    Vec3<double> place;        ///< where the force acts on a plane [m]
  };
  /// Where a contact is and how its bodies move.
  struct Meeting {
    Vec3<double> normal, velocity;
    double overlap, leverI, leverJ, armI, armJ;
  };
  struct PlacedPlane {
    std::size_t wall, member;
    Vec3<double> point, normal, velocity;
  };

  void kick(double dt);
  void step();
  void seeVelocities(double ahead);
  void placePlanes();
  void addForces();
  void addPair(Pair& pair);
  Meeting meetSphere(const Pair& pair) const;
  Meeting meetPlane(Pair& pair) const;
  void requireShallow(const Pair& pair) const;
  bool listIsOld() const;
  void listPairs();

  SpheresSetup setup_;
  GeneralLaw<double> law_;
  bool predicts_;
  double halfKick_ = 0.0;  ///< by which velocities are behind positions [s]
  std::uint64_t steps_ = 0, evaluations_ = 0, rebuilds_ = 0;
  std::vector<Vec3<double>> force_, torque_, seenVelocity_, seenSpin_;
  std::vector<PlacedPlane> planes_;
  std::vector<Pair> pairs_;                    ///< by ascending i, j, planes first
  std::vector<Vec3<double>> positionsAtList_;  ///< when the pairs were listed
};

}  // namespace grain
