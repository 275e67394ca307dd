#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"

namespace crossgrain {

/// Largest difference between the time of a snapshot and the instant that was asked for: engines go
/// to the step nearest to it (Engine::advance), and files have six digits at least [s].
/// @param step  the time step [s]
inline double instantSlack(double step, double instant) {
  return std::max(0.5 * step, 2e-6 * std::abs(instant));
}

/// Beginning of a remark on files that list contacts, but none of walls that bodies touch.
inline constexpr std::string_view noWallContacts = "no contacts with walls in the files";

/// Snapshots of a file in place of a run, one after the other, so that memory holds one at a time.
template <int D>
class SnapshotSourceOf {
 public:
  virtual ~SnapshotSourceOf() = default;

  /// Disks and walls under the law of the case. Places and velocities of disks are those of the
  /// first snapshot, or of the last at which the disks changed.
  virtual const SceneOf<D>& scene() const = 0;
  /// Program that made them, as the file says, else the file's name.
  virtual const std::string& engine() const = 0;
  /// The next one, by time; absent after the last. It fits the scene and was found sound
  /// (adapters/audit.hpp). @throws BadInput naming the file, the snapshot and what is wrong
  virtual std::optional<SnapshotOf<D>> next() = 0;
  /// Whether the last snapshot has other disks than the one before, as particles come and go:
  /// scene() has them.
  virtual bool disksChanged() const { return false; }
  /// How far it has read, 0 … 1.
  virtual double progress() const = 0;
  /// Data that the files lack and the consequence, a sentence each; complete after the last
  /// snapshot.
  virtual std::vector<std::string> remarks() const { return {}; }
  /// Whether forces were read that are not those of the scene's law; a remark says where.
  virtual bool hasOtherLaw() const { return false; }
};
using SnapshotSource = SnapshotSourceOf<2>;

}  // namespace crossgrain
