#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"

namespace crossgrain::files {

/// The fastest angular frequency of walls that swing or turn [rad/s].
template <int D>
double driveOf(const std::vector<WallBodyOf<D>>& bodies);

/// Result of DisplacementsOf for two snapshots.
struct MotionFinding {
  /// Way covered/way by velocities, where it is the same to 5 % of nine in ten of the counted
  /// disks, or of the even ones, and is either a power of ten to 2 % or the same as since the
  /// snapshot before.
  std::optional<double> factor;
  std::size_t of = 0;  ///< such disks
  /// Else: root of the mean square of displacements/that of velocities Δt, where that is more
  /// than 2 or less than 1/100. A steady flow has at most 1 (Minkowski's inequality); disks that
  /// vibrate or diffuse have less without a limit.
  std::optional<double> rms;
};

/// Whether disks move from one snapshot to the next as far as their velocities say: of files whose
/// time step or unit of velocities is another than was said, they do not.
///
/// A disk is counted whose velocity changes from v₁ to v₂ by no more than its mean,
/// |v₂ − v₁| ≤ |v₁ + v₂|/2. Without turning back meanwhile it covers ½ to 3/2 of the way
/// (v₁ + v₂) Δt/2; in flight under gravity just that way.
///
/// Half or twice the time step shows in those alone of which more is known. A disk is even where
/// v₂ − v₁, or v₂ − v₁ − g τ, is at most a fifth of its mean velocity; τ is the time that its way
/// takes at that mean, whatever the files say of time. At an even speed, and in flight, τ is Δt.
/// Of these alone less than 0.4 of the way is no finding: see mostOfBouncing.
///
/// In a periodic box the way is that to the nearest image, since files may wrap places. Left out
/// are disks that by their velocities have gone more than half of a period: their image is not
/// known then.
template <int D>
class DisplacementsOf {
 public:
  /// @param gravity  g [m/s²]
  /// @param drive    driveOf() the walls: snapshots further apart than half a radian of it may show
  ///                 the same phase each time, and then only powers of ten are a finding [rad/s]
  explicit DisplacementsOf(const VecOf<D>& gravity = VecOf<D>::Zero(), double drive = 0.0,
                           const std::optional<BoxOf<D>>& box = {})
      : gravity_(gravity), drive_(drive), box_(box) {}

  /// Compares with the snapshot before. @param uncertain  how far positions may be off [m]
  MotionFinding compare(const SnapshotOf<D>& now, double uncertain);
  /// The next snapshot has other disks.
  /// @param before  of each of them, which disk of the snapshot before it is; absent: it is new
  void changeDisks(const std::vector<std::optional<std::size_t>>& before);

 private:
  /// Way covered/way by velocities of a disk; 0: by another way.
  struct Factors {
    std::vector<double> all, even;
  };
  Factors factorsOf(const SnapshotOf<D>& now, double uncertain) const;
  std::optional<double> rmsOf(const SnapshotOf<D>& now, double uncertain) const;
  /// Of disk k since the snapshot before; absent: not known [m].
  std::optional<VecOf<D>> movedOf(const SnapshotOf<D>& now, std::size_t k) const;

  VecOf<D> gravity_;
  double drive_;
  std::optional<BoxOf<D>> box_;
  std::vector<VecOf<D>> position_, velocity_;  ///< of the snapshot before
  double time_ = 0.0;
  std::optional<double> factor_, even_;  ///< since the one before that
};

}  // namespace crossgrain::files
