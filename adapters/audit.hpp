#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "adapters/engine.hpp"

/// Checks whether a snapshot is possible in its scene. Each returns one clause that names the fault
/// (which disk or contact), the number and the right one; empty: no fault was found.
namespace crossgrain {

/// Rounding of numbers as they were written: relative, 10⁻⁵ of six digits, at least 10⁻⁹, and by
/// the place of the last decimal.
struct LastDigit {
  double relative = 0.0;
  double place = 0.0;  ///< in the numbers' unit
};

/// Accuracy of overlaps in a result file, and pairs that its list of contacts may leave out.
struct ShownPlaces {
  LastDigit position, radius;  ///< in the file's numbers
  double unit = 1.0;           ///< of these [m]
  /// Of numbers held in binary, of their size: 2⁻²³ of single precision.
  double binary = 0.0;
  double step = 0.0;  ///< by which a list may be older than the places [s]
};

/// Reference for the snapshots of one run, computed once so that each audit is cheap.
template <int D>
struct AuditBasisOf {
  const SceneOf<D>* scene =
      nullptr;      ///< as the engine runs it; only its bodies and places are read
  double dt = 0.0;  ///< the engine's [s]; 0: not known, then times are not counted
  /// Whether a contact is a pair that overlaps at contactTime, as soft disks have it. Rigid disks
  /// show the pairs that an impulse passed between in the last step, while they moved on.
  bool byOverlap = true;
  /// Whether walls have moved as the scene prescribes since t = 0.
  bool prescribed = true;
  /// Rounding error of recomputed geometry, as a share of the farthest coordinate: 10⁶ roundings of
  /// double precision, 10 of single.
  double rounding = 1e-10;
  /// Present where forces are compared with the law at the contacts' own overlaps, which in files
  /// have more digits than those from positions. Absent: overlaps are those from positions.
  std::optional<LastDigit> shownOverlaps;
  /// Absent: every pair that overlaps by more than `rounding` allows has to be listed.
  std::optional<ShownPlaces> shownPlaces;

  std::vector<double> radius;          ///< disks, then wall disks [m]
  VecOf<D> middle = VecOf<D>::Zero();  ///< of everything at t = 0 [m]
  double extent = 0.0;                 ///< farthest from there that anything reaches at t = 0 [m]
  double farthest = 0.0;               ///< from the origin, rounding's measure [m]
  double fastest = 0.0;                ///< of what the scene starts or prescribes [m/s]
  double mass = 0.0;                   ///< of all disks [kg]
};
using AuditBasis = AuditBasisOf<2>;

/// Reference of an engine that has loaded the scene, which has to outlive it.
template <int D>
AuditBasisOf<D> auditBasis(const SceneOf<D>& scene, const Capabilities& can,
                           const EffectiveParameters& effective);

/// Reference of snapshots of unknown origin: soft, single precision, unknown step and wall motion.
template <int D>
AuditBasisOf<D> auditBasis(const SceneOf<D>& scene);

/// Checks times, places, and contacts against those recomputed from positions. Costs less than a
/// third of averaging the same snapshot.
/// @param reached  what advance() returned last [s]; absent: not known
template <int D>
std::string auditFault(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis,
                       std::optional<double> reached = std::nullopt);

/// Time of positions is a whole number of steps and the time reached; those of velocities and
/// contacts are within a step of it, as in staggered schemes. A hundredth of a step is allowed for
/// the rounding of sums over 10⁷ steps in any order.
template <int D>
std::string timeFault(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis,
                      std::optional<double> reached);

/// No disk is farther off than it could have flown: a hundred times the scene's extent, and ten
/// times what the fastest thing of the scene and its gravity cover (disks that overlap at the start
/// drive each other apart; one that slipped out flies on). None crosses the scene in a step,
/// unless the scene itself is as fast. Walls are where they are prescribed to be, to 10⁻⁶ of the
/// extent. In a periodic box positions may be of any image.
template <int D>
std::string positionFault(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis);

/// Every contact: i < j, i a moving disk, no pair twice, |n| = 1. Forces of a step also: f_t across
/// n, none so large that it would throw all disks out of the scene. Forces of an instant also:
/// normal and overlap are those of the positions at contactTime, in a periodic box of the pair's
/// nearest images, no force passes a gap (but a bond of JKR's, as far as that reaches), and no pair
/// that overlaps is left out.
///
/// Of scenes with convex bodies instead of normal and overlap: each contact has a point, in both
/// bodies.
///
/// Of result files (AuditBasis::shownPlaces) lists may lack pairs that overlap by less than what
/// the digits leave open, than the listed ones are off themselves, than a tenth of the listed
/// ones' median (each carries less than a tenth of what half of these do), or than two bodies
/// approach each other in a step, and pairs that part so fast that a damper may leave no force.
///
/// Allowances for conventions: contacts of another time than the positions are compared with the
/// disks' places at that time, to within half of what two disks moved meanwhile where velocities do
/// not lie half way. Rigid disks move on after their impulse, by what they move in a step and by
/// what solvers move overlapping disks apart (twice the deepest overlap shown); the solver decides
/// which pairs get an impulse, so none of theirs counts as left out. Means over more than a step
/// belong to no positions.
template <int D>
std::string contactFault(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis);

/// The forces of every contact against the law: f_n from overlap and approach, |f_t| and the torque
/// against rolling within their bounds by the law's conventions. An elasto-plastic law, whose
/// memory is in no snapshot, has a range of f_n. For instants of soft disks; of rigid disks only
/// f_n ≥ 0 is checked. Velocities are uncertain by the change that forces make in a step and a
/// half, as the dashpots of schemes use velocities of up to that long before.
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

/// Steps are those that advance() was called for; seconds are possible ones.
std::string statsFault(const Stats& stats, double dt, double reached);

}  // namespace crossgrain
