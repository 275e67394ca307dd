#pragma once

#include <iosfwd>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engines/grain/impacts.hpp"
#include "engines/grain/kernels.hpp"
#include "engines/grain/ledger_observer.hpp"
#include "engines/grain/pair_lists.hpp"
#include "engines/grain/setup.hpp"
#include "engines/grain/thread_team.hpp"

namespace grain {

/// The time step in one precision. Simulation is its face; "number" is a disk's number there,
/// "place" its place in the arrays here, which follow the disks' neighbourhood in space.
///
/// Arrays that the scene's effects do not call for stay empty.
template <class Real>
class Core {
 public:
  explicit Core(Setup setup);

  /// @param record  whether contacts() is to know this step's forces
  /// @param tally   whether the ledger is to know what each contact loses
  void step(bool record, bool tally);
  void advance(bool record, bool tally) {
    team_.step([=, this] { step(record, tally); });
  }
  void beginUnderWay(const std::vector<Contact>& forces);
  void findNeighbours();

  double time() const { return static_cast<double>(steps_) * dt_; }
  std::uint64_t steps() const { return steps_; }
  double dt() const { return dt_; }
  std::size_t movingCount() const { return moving_; }
  std::size_t diskCount() const { return position_.size(); }
  std::size_t wallCount() const { return walls_.size(); }

  double x(std::size_t number) const;
  double y(std::size_t number) const;
  double velocityX(std::size_t number) const;
  double velocityY(std::size_t number) const;
  double spin(std::size_t number) const;
  bool rotates() const { return law_.rotation; }
  bool rolls() const { return law_.rolling != RollingLaw::none; }
  const MovingWall& wall(std::size_t w) const { return walls_[w]; }
  const std::vector<Contact>& contacts() const;
  WallLoad wallLoad(std::size_t wall) const;
  double kineticEnergy() const;
  double elasticEnergy() const;
  /// nullptr where none is kept
  const EnergyLedger* energyLedger() const { return ledger_ ? &ledger_->ledger() : nullptr; }
  std::vector<double> contactLosses() const {
    return ledger_ ? ledger_->contactLosses(contacts()) : std::vector<double>();
  }

  std::uint64_t contactEvaluations() const { return contactEvaluations_; }
  std::uint64_t unfinishedImpacts() const { return unfinishedImpacts_; }
  const PairLists<Real>& lists() const { return lists_; }
  const char* instructions() const { return kernels_.instructions; }

  void save(std::ostream& out) const;
  void restore(std::istream& in);

 private:
  friend class LedgerObserver<Real>;  // reads only
  struct PlacedPlane {
    std::size_t wall, member;
    Plane plane;  ///< as it stands now
    // By the disks' places.
    Array<Real> spring, angle, memory, rest, overlap, normal, tangential, sliding, rolling,
        rollingSlides;
  };

  // The step.
  void advanceDisks();
  void moveWalls();
  void updateNeighbours();
  void rememberChoice();
  std::span<const double> travel();
  void addForces(bool record);
  void addSoftForces(bool record);
  std::size_t addPairs(std::size_t part, Sort sort, bool record);
  void addFromLowerParts(std::size_t part);
  void addFromHigherParts(std::size_t part);
  void kick(Real dt);

  // The same of rigid disks.
  void addImpacts();
  void findPairImpacts();
  void findPlaneImpacts(std::size_t plane);
  ImpactBody wallBody(const MovingWall& wall, const WallOffset& offset) const;
  void addImpulse(const Impact& impact);
  std::vector<Contact> impactContacts() const;

  // The beginning.
  void buildWalls(std::vector<Wall> walls);
  void buildMaterials(const Setup& setup);
  void allocate(const Disks& disks, const MotionEffects& effects);
  void start();
  void addForcesOfStart(bool underWay);
  /// By numbers i < j.
  template <class T>
  using PairMap = std::map<std::pair<std::int32_t, std::int32_t>, T>;
  void addMissing(const PairMap<const Contact*>& wanted);
  struct Stretches {
    double spring = 0.0, angle = 0.0;  ///< ξ, θ
    double memory = 0.0;
  };
  bool stretch(const PairMap<const Contact*>& wanted, PairMap<Stretches>& springs) const;
  std::size_t placeOf(std::int32_t number) const;
  double forcePerStretch(const Contact& contact) const;
  void setSprings(const PairMap<Stretches>& springs);

  // Housekeeping.
  void renumber();
  void localise();
  void findReachedWallDisks();
  Places places();
  /// Does what may find a disk that is nowhere, or two that are too deep in each other.
  /// @throws std::runtime_error naming them
  template <class Work>
  void guarded(Work&& work);
  void checkPlanes();
  [[noreturn]] void reportNotFinite(const NotFinite& found) const;
  [[noreturn]] void reportTooDeep(const TooDeep& found) const;
  [[noreturn]] void reportTooDeep(std::size_t place, const std::string& partner, double overlap,
                                  double radius) const;
  /// Calls visit(array) for each array that goes with the moving disks where they change place.
  template <class Visit>
  void forDiskArrays(Visit&& visit);
  enum class Which { moving, all };
  void placeWalls(Which which);
  template <class Member>
  void placeWallDisks(std::size_t w, std::size_t count, Member&& member);

  // Views for the kernels.
  /// As the law sees them: predicted, where they are.
  const Array<Vec<Real>>& velocitySeen() const {
    return dashpotVelocity_.empty() ? velocity_ : dashpotVelocity_;
  }
  const Array<Real>& spinSeen() const { return dashpotVelocity_.empty() ? spin_ : seenSpin_; }
  ContactView<Real> contactView();
  MotionView<Real> motionView();
  PlaneView<Real> planeView(PlacedPlane& placed, bool record);
  void makeRoomForRecords();

  std::size_t wallOf(std::size_t number) const;
  WallPoint wallDisk(std::size_t number) const;
  /// Pair k of a list, or a disk and a plane, if they touch; i and j are places, of planes as
  /// numbers.
  std::optional<Contact> touching(const PairList<Real>& list, std::size_t k) const;
  /// @param overlaps  by geometry; a bond decides where the law has one
  bool isContact(const PairList<Real>& list, std::size_t k, bool overlaps) const {
    return law_.cohesion == CohesionLaw::jkr ? list.memory[k] > Real(0) : overlaps;
  }
  Contact contactOf(const PairList<Real>& list, std::size_t k, Vec<Real> normal,
                    Real overlap) const;
  std::optional<Contact> touching(std::size_t plane, std::size_t i) const;
  /// Calls visit(contact), of places, in the order in which a disk's forces are summed up: disk by
  /// disk its pairs by ascending partner, wall disks, planes.
  template <class Visit>
  void forContactsByPlace(Visit&& visit) const;
  std::vector<Contact> softContacts() const;
  /// Of a disk and another or a plane, by places. Only constants differ from law_.
  const GeneralLaw<Real>& lawOf(std::size_t i, std::size_t j) const {
    return laws_.empty() ? law_ : laws_[pairOf(i, j)];
  }
  const GeneralLaw<Real>& lawOf(const Contact& contact) const {
    return lawOf(static_cast<std::size_t>(contact.i), static_cast<std::size_t>(contact.j));
  }
  /// In laws_.
  std::size_t pairOf(std::size_t i, std::size_t j) const {
    return static_cast<std::size_t>(material_[i] * materials_ + material_[j]);
  }
  double ownRadius(const Contact& contact) const;
  /// Values that the law's energies and stiffnesses ask for, of a contact of places.
  ContactMotion<Real> geometryOf(const Contact& contact) const;
  Contact byPlace(Contact contact) const;
  /// The lengths of a contact of places.
  RollingMotion<Real> rollingLengths(const Contact& contact) const;
  Real pairRadius(std::size_t i, std::size_t j) const;

  GeneralLaw<Real> law_;
  std::vector<GeneralLaw<Real>> laws_;  ///< of two materials each; empty: law_ is that of all
  std::int32_t materials_ = 0;
  Array<std::int32_t> material_;  ///< of moving disks, wall disks, planes, where there are several
  Integrator integrator_;
  double dt_;
  double halfKick_ = 0.0;  ///< from the stored velocity to the one at time() [s]
  std::size_t moving_;
  std::uint64_t fingerprint_;  ///< of the setup
  std::uint64_t steps_ = 0, contactEvaluations_ = 0, unfinishedImpacts_ = 0;
  MotionConstants<Real> motionConstants_;
  std::vector<double> mass_, inertia_;  ///< by number

  Kernels<Real> kernels_;
  ContactKernel<Real> contacts_;
  PlaneKernel<Real> planes_;
  MotionKernel<Real> motion_;

  // Moving disks, then wall disks.
  Array<Vec<Real>> position_;
  Array<Real> radius_, inverseMass_, inverseInertia_;
  Array<Vec<Real>> origin_;  ///< of the local coordinates, in single precision [m]
  Real square_ = 1;          ///< that these count from the corners of [m]
  Array<Vec<Real>> velocity_, dashpotVelocity_;  ///< as integrated, and as the dashpots see them
  Array<Real> spin_, seenSpin_;                  ///< where that differs
  // Moving disks.
  Array<Vec<Real>> force_, plateSpring_;
  Array<Real> torque_, gravityForce_;
  std::vector<std::int32_t> idAtIndex_, indexOfId_;
  std::vector<Vec<double>> places_;
  std::vector<double> placeRadius_;  ///< in double, where the state is not

  std::vector<MovingWall> walls_;
  std::vector<std::size_t> wallBegin_;  ///< first disk of each wall, one more at the end
  std::vector<std::vector<std::int32_t>> reached_;  ///< per wall: its disks in some list
  std::vector<PlacedPlane> placedPlanes_;

  double maxOverlap_;  ///< in units of the smaller radius; infinite: any
  PairLists<Real> lists_;
  mutable ThreadTeam team_;
  // Near pairs hold as long as every disk is within its allowance of where it was.
  Array<Vec<Real>> positionsAtListBuild_;
  Array<Real> allowanceSquare_;
  std::vector<double> travel_, wallPath_;
  std::uint64_t chosenAt_ = 0;  ///< step
  bool outdated_ = false, sampled_ = false;
  // Kept for the room that they have: a step allocates nothing.
  std::vector<char> isReached_;
  CellGrid renumberingGrid_;
  std::vector<std::int32_t> newPlace_;
  std::vector<std::byte> scratch_;
  std::vector<MotionReport<Real>> reports_;
  std::vector<std::size_t> touching_;
  bool recorded_ = false;
  ImpactLaw impactLaw_;
  std::vector<ImpactLaw> impactLaws_;  ///< as laws_
  std::vector<ImpactBody> impactBodies_;
  std::vector<Impact> impacts_;  ///< of the last step
  mutable std::optional<std::vector<Contact>> known_;

  std::unique_ptr<LedgerObserver<Real>> ledger_;  ///< with room of its own, if there is one
};

template <class Real>
template <class Work>
void Core<Real>::guarded(Work&& work) {
  try {
    work();
  } catch (const NotFinite& found) {
    reportNotFinite(found);
  } catch (const TooDeep& found) {
    reportTooDeep(found);
  }
}

/// The last step's record of a pair. @param normal  from j to i
template <class Real>
GRAIN_INLINE Contact Core<Real>::contactOf(const PairList<Real>& list, std::size_t k,
                                           Vec<Real> normal, Real overlap) const {
  return Contact{list.i[k],
                 list.j[k],
                 static_cast<double>(normal.x),
                 static_cast<double>(normal.y),
                 static_cast<double>(overlap),
                 static_cast<double>(list.normal[k]),
                 static_cast<double>(list.tangential[k]),
                 list.spring.empty() ? 0.0 : static_cast<double>(list.spring[k]),
                 list.sliding[k] != Real(0),
                 rolls() ? static_cast<double>(list.rolling[k]) : 0.0,
                 list.angle.empty() ? 0.0 : static_cast<double>(list.angle[k]),
                 rolls() && list.rollingSlides[k] != Real(0),
                 list.memory.empty() ? 0.0 : static_cast<double>(list.memory[k])};
}

template <class Real>
template <class Visit>
void Core<Real>::forContactsByPlace(Visit&& visit) const {
  for (std::size_t part = 0; part < lists_.parts(); ++part) {
    std::array<std::size_t, sorts.size()> next{};
    for (std::size_t i = lists_.partBegin(part); i < lists_.partBegin(part + 1); ++i) {
      for (const Sort sort : sorts) {
        const PairList<Real>& list = lists_.list(part, sort);
        std::size_t& k = next[static_cast<std::size_t>(sort)];
        for (; k < list.count && static_cast<std::size_t>(list.i[k]) == i; ++k)
          if (const auto contact = touching(list, k)) visit(*contact);
      }
      for (std::size_t p = 0; p < placedPlanes_.size(); ++p)
        if (const auto contact = touching(p, i)) visit(*contact);
    }
  }
}

template <class Real>
template <class Visit>
void Core<Real>::forDiskArrays(Visit&& visit) {
  for (auto* array : {&position_, &velocity_, &dashpotVelocity_, &force_, &plateSpring_, &origin_})
    visit(*array);
  for (auto* array :
       {&radius_, &inverseMass_, &inverseInertia_, &spin_, &seenSpin_, &torque_, &gravityForce_})
    visit(*array);
  if (!material_.empty()) visit(material_);
  for (PlacedPlane& placed : placedPlanes_) {
    visit(placed.spring);
    visit(placed.angle);
    visit(placed.memory);
    visit(placed.rest);
  }
}

}  // namespace grain
