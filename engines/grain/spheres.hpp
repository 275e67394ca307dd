#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engines/grain/space_lists.hpp"

namespace grain {

/// A rigid body of planes, cylinders and spheres that moves as prescribed, whatever pushes on it.
struct SpaceWall {
  struct Plane {
    Vec3<double> point, normal;  ///< at t = 0; of length 1, into the free side
  };
  /// Hollow, with the spheres inside. Its body stands still or turns about its axis.
  struct Cylinder {
    Vec3<double> point, axis;  ///< of length 1
    double radius;
  };
  struct State {
    Vec3<double> centre, velocity;
    Vec3<double> angle{}, spin{};  ///< turned since t = 0, and its rate, about one axis
  };
  std::vector<Plane> planes;
  std::vector<Cylinder> cylinders;
  std::vector<Vec3<double>> position;  ///< of spheres at t = 0
  std::vector<double> radius;
  std::function<State(double t)> motion;
};

/// Everything a simulation of spheres starts from [SI units]. As Setup, in space.
struct SpheresSetup {
  std::vector<Vec3<double>> position, velocity, spin;
  std::vector<double> radius, mass, inertia;
  std::vector<SpaceWall> walls;
  std::optional<SpaceBox> box;
  ContactLaw law;                      ///< no impulses
  std::optional<Materials> materials;  ///< where pairs differ: then `law` is of none
  Vec3<double> gravity;
  double dt = 0.0;
  bool rotation = true;
  double skin = 0.0;        ///< of the neighbour list [m]; 0: tuned
  double maxOverlap = 1.0;  ///< as in Setup
  int threads = 1;
  bool generalKernels = false;  ///< as in Setup
};

/// One contact of the last force evaluation; the force acts on i, n points from j to i. Numbers:
/// spheres, then those of walls, then planes, then cylinders, each wall by wall.
struct SpaceContact {
  std::int32_t i, j;
  Vec3<double> normal;
  double overlap;
  double normalForce;
  Vec3<double> tangentialForce, rollingTorque;
  bool sliding;
};

/// Spheres that touch softly, in space: the scheme of Simulation with vectors, in double precision.
///
///   kick: v += a dt   drift: x += v dt   move walls   forces: a(x, v)
///
/// The same setup gives the same bits in every run, on any number of threads, with any skin and
/// instruction set: forces are summed in the order of pairs, and a pair that does not touch adds
/// nothing. Spheres are numbered
/// anew by place at fixed steps; what goes in and out has the setup's numbers, their ids. A sphere
/// that leaves a periodic box goes on; contacts are with the nearest images, so that nothing of it
/// changes when it crosses a border.
class Spheres {
 public:
  /// @throws std::invalid_argument for a step that is not > 0, and for a law or box that it does
  /// not have
  explicit Spheres(SpheresSetup setup);
  Spheres(Spheres&&) = default;  // not copied: its shares point into it

  /// @throws std::runtime_error naming a sphere whose position is not finite, or two that overlap
  /// too much
  void advance(std::uint64_t steps);

  std::uint64_t steps() const { return steps_; }
  double time() const { return setup_.dt * static_cast<double>(steps_); }
  double dt() const { return setup_.dt; }
  std::size_t size() const { return setup_.mass.size(); }
  bool rotates() const { return law_.rotation; }

  // By the setup's numbers.
  Vec3<double> position(std::size_t id) const { return vectorOf(position_[indexOf(id)]); }
  Vec3<double> velocity(std::size_t id) const;  ///< at time()
  Vec3<double> spin(std::size_t id) const;      ///< at time(); without rotation 0

  /// Of the last force evaluation, by ascending i, j.
  std::vector<SpaceContact> contacts();
  std::uint64_t contactEvaluations() const { return evaluations_; }
  std::uint64_t rebuilds() const { return lists_.rebuilds(); }

  /// All that the future depends on, and back to where it goes on to the bit.
  /// @throws std::runtime_error for what is cut short, damaged or of another setup
  void save(std::ostream& out) const;
  void restore(std::istream& in);

  /// As Simulation::beginUnderWay(): with springs stretched for these forces.
  /// @throws std::logic_error after the first step
  void beginUnderWay(const std::vector<SpaceContact>& forces);

  SpaceWall::State wallState(std::size_t w) const { return setup_.walls[w].motion(time()); }
  std::size_t wallSpheres() const { return position_.size() - size(); }
  Vec3<double> wallPosition(std::size_t k) const;
  /// On a wall: the force [N], and its torque about the wall's centre [N m].
  std::pair<Vec3<double>, Vec3<double>> wallLoad(std::size_t w) const;

 private:
  /// One thread's data, on a cache line of its own.
  struct alignas(64) Share {
    ActiveSpheres active{};
    SpaceMotionReport moved;
    std::size_t touching = 0;  ///< in this step
    bool deep = false;         ///< some overlap is beyond what is allowed
  };
  /// A plane or a cylinder, and what its contacts remember, one a sphere.
  struct PlacedPlane {
    std::size_t wall, member;
    double radius;  ///< of a cylinder; 0: a plane
    /// At this instant; of a cylinder a point of the axis, and its direction.
    Vec3<double> point, normal;
    SpaceContacts contacts;
    std::vector<std::uint8_t> touches{};

    bool isCylinder() const { return radius > 0.0; }
  };

  std::size_t indexOf(std::size_t id) const {
    return id < size() ? static_cast<std::size_t>(indexOfId_[id]) : id;
  }
  std::int32_t idOf(std::int32_t index) const {
    const auto i = static_cast<std::size_t>(index);
    return i < size() ? idAtIndex_[i] : index;
  }
  /// Arrays with an entry a sphere; walls, and what is worked out from these, are not kept.
  void forState(auto&& visit) {
    visit(idAtIndex_);
    visit(mark_);
    for (auto* array : {&position_, &velocity_, &force_}) visit(*array);
    if (law_.rotation)
      for (auto* array : {&spin_, &torque_}) visit(*array);
    for (PlacedPlane& plane : planes_) {
      plane.contacts.forRecords(visit);
      visit(plane.touches);
    }
  }
  /// Velocities that dashpots see: the velocities themselves unless predicted.
  const Array<Quad>& seenVelocities() const {
    return seenVelocity_.empty() ? velocity_ : seenVelocity_;
  }
  const Array<Quad>& seenSpins() const { return seenSpin_.empty() ? spin_ : seenSpin_; }
  /// @param body  a sphere's index, or beyond them a plane's or cylinder's
  const GeneralLaw<double>& lawOf(std::size_t i, std::size_t body) const {
    if (laws_.empty()) return law_;
    const std::size_t count = setup_.materials->count;
    return laws_[static_cast<std::size_t>(material_[i]) * count +
                 static_cast<std::size_t>(material_[body])];
  }
  void forLaws(auto&& visit) {
    visit(law_);
    for (GeneralLaw<double>& law : laws_) visit(law);
  }
  /// Evaluates forces while another part of a step is left for implicit damping [s].
  void addForcesAfter(double halfStep);
  /// Calls work(share, first, end) for the moving spheres of each part.
  void together(auto&& work) {
    team_->run([&](std::size_t part) {
      work(shares_[part], lists_.partBegin(part), lists_.partBegin(part + 1));
    });
  }
  SpaceMotionView motionView(const ActiveSpheres& active);
  SpaceView view(const ActiveSpheres& active);
  void placeSpheres();
  void renumber();
  void followNumbers();
  void kick(double dt);
  void step();
  void moveWalls();
  Vec3<double> wallPlace(std::size_t w, const Vec3<double>& point) const;
  void placeWallSphere(std::size_t w, std::size_t i, bool steady);
  void updateNeighbours();
  void list(const std::function<void()>& pairs);
  void findTravel();
  void rememberChoice();
  void beginForces();
  void addForces();
  void addContacts(Share& share, const auto& kernel, const auto& bodies);
  void addFromLowerParts(std::size_t part);
  void addFromHigherParts(std::size_t part);
  SpacePlane viewOf(std::size_t plane, std::size_t begin, std::size_t end);
  Meeting<double> meetingOf(const SpaceContact& contact);
  void addLacking(const SpaceContact& contact, const Vec3<double>& force,
                  const Vec3<double>& torque);
  const GeneralLaw<double>& lawOf(const SpaceContact& contact) const {
    return lawOf(indexOf(static_cast<std::size_t>(contact.i)),
                 indexOf(static_cast<std::size_t>(contact.j)));
  }
  std::pair<double, double> loadPerStretch(const GeneralLaw<double>& law,
                                           const Meeting<double>& meeting) const;
  Vec3<double> springFor(const GeneralLaw<double>& law, const Meeting<double>& meeting,
                         const SpaceContact& want, double unit) const;
  std::string nameOfPlane(std::size_t p) const;  ///< "cylinder 0"
  [[noreturn]] void reportDeep();

  SpheresSetup setup_;
  std::uint64_t fingerprint_;
  GeneralLaw<double> law_;                ///< of materials, what they have in common
  std::vector<GeneralLaw<double>> laws_;  ///< of two materials each; empty: law_ is that of all
  std::vector<std::int32_t> material_;    ///< by index, then of planes and cylinders
  SpaceKernels kernels_;
  SpaceContactKernel<SpacePairs> pairKernel_;
  SpaceContactKernel<SpacePlane> planeKernel_;
  double halfKick_ = 0.0;  ///< by which velocities are behind positions [s]
  double range_;           ///< how far apart bodies may be in contact [m]
  std::uint64_t steps_ = 0, chosenAt_ = 0, evaluations_ = 0;
  bool outdated_ = true, sampled_ = false;
  bool asked_ = true;  ///< somebody may look at the results of contacts after this step
  /// Something besides pairs pushes: gravity, a plane or a cylinder.
  bool everyone_;
  double freeUntil_ = 0.0;  ///< the last step for which spheres that nothing pushes have allowance
  // By index, from place to place: the moving spheres, then those of walls. Without rotation there
  // are no spins and torques.
  std::vector<std::int32_t> idAtIndex_, indexOfId_;
  Array<Quad> position_, velocity_, spin_, seenVelocity_, seenSpin_, force_, torque_, chosen_;
  std::vector<double> mass_, inverseMass_, inverseInertia_, allowance_, travel_;
  std::vector<Share> shares_;             ///< by part
  std::vector<std::int32_t> activeList_;  ///< each part's with room for one more
  std::vector<std::uint8_t> mark_;
  std::vector<Vec3<double>> wallCentre_;  ///< at t = 0
  std::vector<std::size_t> wallBegin_;    ///< first sphere of each wall, and the end
  std::vector<SpaceWall::State> wallNow_;
  Array<Quad> wallArms_;               ///< of spheres of walls from the centre at t = 0; w: radius
  std::vector<double> wallReach_;      ///< from the centre to the farthest of its spheres [m]
  std::vector<char> wallSteady_;       ///< moves on as in the step before
  std::vector<double> wallPath_;       ///< of that one, at most, since pairs were chosen [m]
  std::vector<std::int32_t> reached_;  ///< spheres of walls that are in a near pair
  std::vector<PlacedPlane> planes_;    ///< then the cylinders
  SpaceLists lists_;
  std::unique_ptr<ThreadTeam> team_;
};

}  // namespace grain
