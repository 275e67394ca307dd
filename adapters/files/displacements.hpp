#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adapters/snapshot.hpp"

namespace crossgrain::files {

/// Whether disks move from one snapshot to the next as far as their velocities say: of files whose
/// time step or unit of velocities is another than was said, they do not.
///
/// A disk is counted whose velocity changes from v₁ to v₂ by no more than its mean,
/// |v₂ − v₁| ≤ |v₁ + v₂|/2. Without turning back meanwhile it covers ½ to 3/2 of the way
/// (v₁ + v₂) Δt/2; in flight under gravity just that way.
class Displacements {
 public:
  struct Finding {
    /// Way covered/way by velocities, where it is the same to 5 % of nine in ten of the counted
    /// disks, and is either a power of ten to 2 % or the same as since the snapshot before.
    std::optional<double> factor;
    std::size_t of = 0;  ///< counted disks
    /// Else: root of the mean square of displacements/that of velocities Δt, where that is more
    /// than 2 or less than 1/100. A steady flow has at most 1 (Minkowski's inequality); disks that
    /// vibrate or diffuse have less without a limit.
    std::optional<double> rms;
  };

  /// Compares with the snapshot before. @param uncertain  how far positions may be off [m]
  Finding compare(const Snapshot& now, double uncertain);

 private:
  std::optional<double> factorOf(const Snapshot& now, double uncertain, Finding& finding);
  std::optional<double> rmsOf(const Snapshot& now, double uncertain) const;

  std::vector<Vec2> position_, velocity_;  ///< of the snapshot before
  double time_ = 0.0;
  std::optional<double> factor_;  ///< since the one before that
};

}  // namespace crossgrain::files
