#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "adapters/engine.hpp"

/// Whether a snapshot can be true of its scene. Each answer is one clause that names what is wrong
/// (which disk or contact), the number and what would be right; empty: nothing was found.
namespace crossgrain {

/// How numbers were rounded when they were written: by 10⁻⁵ of six digits, at least 10⁻⁹, and by
/// the place of the last decimal.
struct LastDigit {
  double relative = 0.0;
  double place = 0.0;  ///< in the numbers' unit
};

/// How exactly a result file says which disks overlap, and what its list may leave out all the
/// same.
struct ShownPlaces {
  LastDigit position, radius;  ///< in the file's numbers
  double unit = 1.0;           ///< of these [m]
  /// Of numbers held in binary, of their size: 2⁻²³ of single precision.
  double binary = 0.0;
  double step = 0.0;  ///< by which a list may be older than the places [s]
};

/// What the snapshots of one run are compared with: worked out once, so that an audit is cheap.
template <int D>
struct AuditBasisOf {
  const SceneOf<D>* scene =
      nullptr;      ///< as the engine runs it; only its bodies and places are asked for
  double dt = 0.0;  ///< the engine's [s]; 0: not known, then times are not counted
  /// Whether a contact is a pair that overlaps at contactTime, as soft disks have it. Rigid disks
  /// show the pairs that an impulse passed between in the last step, while they moved on.
  bool byOverlap = true;
  /// Whether walls have moved as the scene prescribes since t = 0.
  bool prescribed = true;
  /// How far geometry worked out again may be off by rounding, of the farthest coordinate: 10⁶
  /// roundings of double precision, 10 of single.
  double rounding = 1e-10;
  /// Where forces are compared with the law at the overlaps that contacts show, as those of files
  /// have more digits than what follows from places.
  /// Absent: positions' are taken.
  std::optional<LastDigit> shownOverlaps;
  /// Absent: pairs that overlap by more than `rounding` leaves open have to be listed, all of them.
  std::optional<ShownPlaces> shownPlaces;

  std::vector<double> radius;          ///< disks, then wall disks [m]
  VecOf<D> middle = VecOf<D>::Zero();  ///< of everything at t = 0 [m]
  double extent = 0.0;                 ///< farthest from there that anything reaches at t = 0 [m]
  double farthest = 0.0;               ///< from the origin, rounding's measure [m]
  double fastest = 0.0;                ///< of what the scene starts or prescribes [m/s]
  double mass = 0.0;                   ///< of all disks [kg]
};
using AuditBasis = AuditBasisOf<2>;

/// Of an engine that has loaded the scene, which outlives it.
template <int D>
AuditBasisOf<D> auditBasis(const SceneOf<D>& scene, const Capabilities& can,
                           const EffectiveParameters& effective);

/// Of snapshots of unknown origin: soft, single precision, nothing known of step and walls' motion.
template <int D>
AuditBasisOf<D> auditBasis(const SceneOf<D>& scene);

/// Times, places, and contacts worked out again from positions. Costs less than a third of
/// averaging the same snapshot.
/// @param reached  what advance() returned last [s]; absent: not known
template <int D>
std::string auditFault(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis,
                       std::optional<double> reached = std::nullopt);

/// Time of positions is a whole number of steps and the time reached; velocities and contacts are
/// of within a step of it, as staggered schemes have them. A hundredth of a step is left to sums of
/// 10⁷ steps in any order.
template <int D>
std::string timeFault(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis,
                      std::optional<double> reached);

/// No disk is farther off than it could have flown: a hundred times the scene's extent, and ten
/// times what the fastest thing of the scene and its gravity cover (disks that overlap at the start
/// drive each other apart; one that slipped out flies on). None crosses the scene in a step,
/// unless the scene itself is as fast. Walls
/// are where they are prescribed to be, to 10⁻⁶ of the extent. In a periodic box positions may be
/// of any image.
template <int D>
std::string positionFault(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis);

/// Every contact: i < j, i a moving disk, no pair twice, |n| = 1. Forces of a step also: f_t across
/// n, none so large that it would throw all disks out of the scene. Forces of an instant also:
/// normal and overlap are those of the positions at contactTime, in a periodic box of the pair's
/// nearest images, no force passes a gap (but a bond of JKR's, as far as that reaches), and no pair
/// that overlaps is left out.
///
/// Of result files (AuditBasis::shownPlaces) lists may lack pairs that overlap by less than what
/// the digits leave open, than the listed ones are off themselves, than a tenth of the listed
/// ones' median (each carries less than a tenth of what half of these do), or than two bodies
/// approach each other in a step, and pairs that part so fast that a damper may leave no force.
///
/// What conventions leave open: contacts of another time than the positions are looked for where
/// disks were then, half of what two disks moved meanwhile being left to schemes whose velocities
/// do not lie half way; rigid disks move on after their impulse, by what they move in a step and by
/// what solvers move disks apart that overlap (twice the deepest overlap shown), and whether a pair
/// got an impulse is the solver's matter, so none is missed there. Means over more than a step
/// belong to no positions.
template <int D>
std::string contactFault(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis);

/// The forces of every contact against the law: f_n from overlap and approach, |f_t| and the torque
/// against rolling within their bounds by the law's conventions. An elasto-plastic law, whose
/// memory nobody shows, has a range of f_n. Of instants of soft disks, and of rigid disks f_n ≥ 0
/// alone. Velocities are known to what forces change of them in a step and a
/// half, as schemes have their dashpots see velocities of up to that long before.
/// @param law  the one that the engine declares (adapters/declared_law.hpp)
template <int D>
std::string lawFault(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis,
                     const ContactLaw& law);

/// Contacts at the Coulomb bound whose tangential force is along the sliding, or against it.
struct SlidingSense {
  std::size_t along = 0, against = 0;
};

/// Adds the disks that slide on each other. Friction dissipates, so that f_t · v_t < 0, v_t of the
/// first relative to the second where they touch. Springs may give back what they store, but at the
/// bound they do so in passing alone: with f_t along v_t a spring relaxes at the rate k_t |v_t|,
/// and the contact leaves the bound unless that falls as fast, at µ |df_n/dt| ≤ µ (k_n |v_n| + γ_n
/// f_n/m₁₂). So contacts count whose v_t is twice what would keep up with this, three times what
/// velocities may be off by. One that swings up to the bound and back without sliding is there with
/// either sense for as long as with the other; one that slides is there against v_t. Right files
/// have at most half of them along.
template <int D>
void addSliding(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis, const ContactLaw& law,
                SlidingSense& sense);

/// Cost counted as advance() was asked: steps done so far, seconds that can be.
std::string statsFault(const Stats& stats, double dt, double reached);

}  // namespace crossgrain
