#pragma once

#include <optional>
#include <vector>

#include "adapters/engine.hpp"
#include "oracle/collision_quantities.hpp"

namespace crossgrain::inline studies {

/// Record of one pair's contact in a run that was watched step by step.
struct ContactAccount {
  double maxOverlap = 0.0;  ///< largest at any step: below the true maximum by O(dt²) [m]
  ForceWork work;
  std::optional<EnergySplit> split;  ///< absent where the engine does not distinguish slip from
                                     ///< stick, or its spring's stiffness follows the overlap;
                                     ///< parts of a law that its forces do not tell are absent
};

/// How an engine runs a sweep: what is needed to read its contacts.
template <int D>
struct ContactRecording {
  /// Of collisionScene() or spaceCollisionScene(): pair k is disks 2k and 2k + 1, or disk k and the
  /// wall.
  const SceneOf<D>& scene;
  CollidingPair pair;  ///< that all of them are
  ContactLaw law;      ///< with the engine's own conventions
  const EffectiveParameters& effective;
  bool slidingFlags = false;
};

/// Advances to `end` and watches the contacts, step by step, until all pairs have met and parted.
///
/// Work is Σ f·v dt over the steps in contact, forces, normals and velocities of contactTime;
/// velocities of another time are interpolated between two snapshots, which is of second order. So
/// the sum is what the forces of a leapfrog scheme really took out of its motion; against the
/// continuous law's integral it is of first order, since a dashpot's force jumps at the first touch
/// and the last. Sticking loses what its forces do less what the spring gains, the spring's force
/// being f_t without the dashpot's part; a gain between two steps belongs to what the contact does
/// at the later one.
/// @returns one account per pair; absent for one that was not seen to touch, and for all where
///          forces are means over a step, those of impulses
template <int D>
std::vector<std::optional<ContactAccount>> recordContacts(Engine& engine,
                                                          const ContactRecording<D>& run,
                                                          double end);

}  // namespace crossgrain::inline studies
