#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "stability/recording.hpp"

namespace crossgrain::inline stability {

/// Demand of a measure on an engine.
enum class StabilityProtocol {
  oneRun,
  againstOriginal,  ///< a run of the case's first variant, then one of its own: copiesDiffer()
  restart,          ///< a run, and one taken up from its middle: largestDistance()
  stepLimit,        ///< many runs, until the largest stable step is known: theoreticalStepLimit()
  largestStep,      ///< likewise, of a scene as it is: isSound()
  invariances,      ///< runs of transformed scenes
  acceptance        ///< one that it has to refuse
};

/// Of a measure that looks at what single steps do.
inline constexpr int burstSteps = 8;

/// One figure that a hard case may be judged by. All are ≥ 0, and 0 is best.
struct StabilityMeasure {
  std::string_view name;  ///< as in [stability] measure
  std::string_view unit;
  std::string_view what;  ///< one clause
  /// Of one run: what it is at each snapshot, in its unit; the case's figure is the largest. Empty:
  /// the engine does not show what it takes. Null with another protocol.
  std::vector<double> (*curve)(const Recording&) = nullptr;
  /// The same in space. Null: of the plane alone.
  std::vector<double> (*curveInSpace)(const SpaceRecording&) = nullptr;
  StabilityProtocol protocol = StabilityProtocol::oneRun;
  bool takesLedger = false;  ///< engines that can account for their energy have to
  int steps = 0;             ///< snapshots after each sample's, one a step
  /// Why a run has no curve.
  std::string_view absent = "does not show what the measure takes";

  template <int D>
  std::vector<double> of(const RecordingOf<D>& run) const {
    if constexpr (D == 2)
      return curve(run);
    else
      return curveInSpace(run);
  }
};

/// All of them, in the order of the documentation.
std::span<const StabilityMeasure> stabilityMeasures();

/// @throws std::out_of_range
const StabilityMeasure& stabilityMeasure(std::string_view name);

/// |e_n − oracle's of the law that the engine runs| of each of a case's collisions; e_n is 0 of
/// disks that do not part (nearly critical dampers take for ever).
std::vector<double> restitutionErrors(const Recording& run);

/// StabilityProtocol::againstOriginal: the largest distance between a disk of the copy, taken back
/// to where it would be without being mirrored, turned, shifted and boosted, and the same disk of
/// the original [diameters], at each instant that both have. In space a copy is shifted: ways from
/// the start are compared.
template <int D>
std::vector<double> copiesDiffer(const RecordingOf<D>& original, const RecordingOf<D>& copy);

/// StabilityProtocol::largestStep: whether a run came to its end, none of its bodies sank into
/// another by more than a radius or went through it or a wall, and its kinetic energy stayed below
/// 100 times the largest of `calm`, the same scene at the case's own step; and where no wall moves
/// the energy grew by less than a tenth.
template <int D>
bool isSound(const RecordingOf<D>& run, const RecordingOf<D>& calm);

/// StabilityProtocol::restart: the largest distance between two runs of the same scene [diameters].
template <int D>
double largestDistance(const SceneOf<D>& scene, const SnapshotOf<D>& one,
                       const SnapshotOf<D>& other);

/// StabilityProtocol::stepLimit: the largest time step of an explicit scheme of second order, 2/ω
/// with ω² the largest eigenvalue of M⁻¹K, K the stiffness of the start's contacts, normal springs
/// alone [s] (Belytschko, Liu and Moran 2000, section 6.6).
template <int D>
double theoreticalStepLimit(const SceneOf<D>& scene);

/// Its estimate from the coordination number, dt = 2 √(m/(2 k_n z_max)) with z_max the most
/// contacts that a disk has: Gershgorin's bound, which is on the safe side [s] (O'Sullivan and Bray
/// 2004).
template <int D>
double coordinationStepLimit(const SceneOf<D>& scene);

}  // namespace crossgrain::inline stability
