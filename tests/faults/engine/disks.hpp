#pragma once

#include <cstdint>
#include <vector>

#include "crossgrain_worker.hpp"
#include "faults.hpp"
#include "neighbours.hpp"

namespace crossgrain::planted {

using crossgrain_worker::Body;

/// The thesis' law and plate, as law/contact_law.hpp has them. [SI units]
struct Law {
  double kn = 0.0, gn = 0.0, kt = 0.0, gt = 0.0, mu = 0.0;
  bool friction = false, spring = false, dashpot = false;  ///< of the tangential force
  Resistance more;
};
struct Plate {
  double mu = 0.0, kb = 0.0, gb = 0.0, tauM = 0.0, gravity = 0.0;
  bool present = false, spin = false;
};

/// A contact; n from j to i, forces on i.
struct Contact {
  std::int32_t i, j;
  Vector normal;
  double overlap, fn, ft, elastic;
  bool sliding;
  double rolling = 0.0;  ///< M on i, −M on j [N m]
};

/// Everything that a scene loads.
struct World {
  std::size_t disks = 0;
  double dt = 0.0;
  Law law;
  Plate plate;
  Vector gravity;
  bool turns = false;
  bool backwards = false;  ///< pairs are taken from the last to the first
  std::vector<Body> bodies;
  std::vector<double> mass, inertia;                 ///< disks
  std::vector<double> radius, spin;                  ///< disks, wall disks
  std::vector<Vector> position, velocity;            ///< disks, wall disks
  std::size_t rough = static_cast<std::size_t>(-1);  ///< disks from this number on have no friction
};

/// Soft disks in Störmer's scheme: velocities and spins live half a step before positions, and
/// contacts see them brought on by the last acceleration. With neutral faults it is the in-house
/// engine's motion under the thesis' conventions. The other schemes differ in when velocities are
/// kicked: twice by half a step around the drift (velocity Verlet), or whole steps from the start's
/// velocities on, which are seen as they are (semi-implicit Euler).
class Simulation {
 public:
  Simulation(World world, const Faults& faults);

  void step();
  void forgetSprings();
  /// Everything that its future depends on, one after the other, given to `each`.
  void parts(const auto& each) {
    each(steps_);
    each(evaluations_);
    for (auto* list : {&world_.position, &world_.velocity, &plateSpring_, &force_, &onBody_})
      each(*list);
    for (auto* list : {&world_.spin, &torque_, &torqueOnBody_}) each(*list);
    for (std::vector<Memory>& memories : planeMemory_) each(memories);
    each(contacts_);
    neighbours_.parts(each);
  }
  /// Parts are those of another run of the same scene.
  void restored();
  /// Springs of another run, those that there are a list entry for.
  void takeSprings(const Simulation& other);

  const World& world() const { return world_; }
  double now() const { return static_cast<double>(steps_) * world_.dt; }
  unsigned long long steps() const { return steps_; }
  unsigned long long evaluations() const { return evaluations_; }
  const std::vector<Contact>& contacts() const { return contacts_; }
  const std::vector<Vector>& forceOnBodies() const { return onBody_; }
  const std::vector<double>& torqueOnBodies() const { return torqueOnBody_; }
  /// Of disk i at the time of positions, but that semi-implicit Euler's are half a step older.
  Vector velocity(std::size_t i) const {
    return world_.velocity[i] + (halfKick_ / world_.mass[i]) * force_[i];
  }
  double spin(std::size_t i) const {
    return world_.spin[i] + halfKick_ * torque_[i] / world_.inertia[i];
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  void drift(double dt);
  void kick(double dt);
  double stored(double number) const;
  Vector stored(Vector vector) const;
  void moveWalls();
  void addForces(double ahead);
  bool late() const {
    return faults_.lateSteps > 0.0 ? static_cast<double>(steps_) > faults_.lateSteps : now() > 1.0;
  }
  void addPlate(std::size_t i);
  void addPairs();
  Memory& memoryOf(Pair& pair);
  void addPlanes();
  Contact contact(std::size_t i, std::size_t j, Vector n, double overlap, Vector relative,
                  double rim, double spinOfOther, Memory& kept);
  bool holds(const Touching& pair, Memory& kept) const;
  void push(std::size_t body, Vector place, const Contact& c, double arm);
  double arm(std::size_t i, double overlap) const;
  bool outsideStart(Vector x) const;
  Vector seenOfWall(const Body& body, Vector velocity) const;
  double seenSpinOfWall(const Body& body) const;

  World world_;
  Faults faults_;
  Neighbours neighbours_;
  std::vector<std::size_t> bodyOf_;               ///< of each wall disk
  std::vector<std::vector<Memory>> planeMemory_;  ///< by plane and disk
  std::vector<Vector> planePoint_;                ///< at the start
  std::vector<Vector> plateSpring_;
  std::vector<Vector> force_, dashpotVelocity_, onBody_;
  std::vector<double> torque_, seenSpin_, torqueOnBody_;
  std::vector<Contact> contacts_;
  std::vector<int> touching_;       ///< contacts of each disk in this step
  std::vector<int> planesTouched_;  ///< by each disk in this step
  double halfKick_ = 0.0;
  double smallest_ = 0.0;  ///< radius of the smallest disk [m]
  double heaviest_ = 0.0;  ///< mass of the heaviest [kg]
  double meanMass_ = 0.0;  ///< [kg]
  Vector startLow_{infinity, infinity}, startHigh_{-infinity, -infinity};  ///< where disks were [m]
  unsigned long long steps_ = 0, evaluations_ = 0;
};

}  // namespace crossgrain::planted
