#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "adapters/engine.hpp"
#include "oracle/collision_end.hpp"
#include "stability/placement.hpp"

namespace crossgrain::inline stability {

/// Record of one engine in a hard case, seen at some instants.
template <int D>
struct RecordingOf {
  SceneOf<D> scene;  ///< as it was asked for
  EffectiveParameters effective;
  /// In the order of time, the first at t = 0; in a periodic box paths are whole.
  std::vector<SnapshotOf<D>> snapshots;
  std::string failure;  ///< why the engine did not get to the end; empty if it did
  double settle = 0.0;  ///< fraction of the run before it should be at rest, [0, 1)
  Placement placement;  ///< of a scene of the plane, against the original it is a copy of
  /// Where the scene is nothing but collisions side by side, what they start from, in its order.
  std::vector<CollisionStart> collisions = {};
  /// Of the contacts, as the engine says that it runs them (lawAsRun()).
  ContactLaw law = {};
  bool stands = false;  ///< all should be at rest from the start, but for how contacts settle
};
using Recording = RecordingOf<2>;
using SpaceRecording = RecordingOf<3>;

/// The length that displacements are expressed in: a diameter of the smallest disk [m].
template <int D>
double smallestDiameter(const SceneOf<D>& scene) {
  return 2.0 * std::ranges::min(scene.disks.radius);
}

/// Two bodies that overlap: a disk, and by Scene's ids another disk, a wall disk, a plane or a
/// cylinder.
template <int D>
struct OverlapOf {
  std::size_t i = 0, j = 0;
  double depth = 0.0;                  ///< [m]
  double smallerRadius = 0.0;          ///< of the two; the disk's on a plane [m]
  double reducedRadius = 0.0;          ///< a_i a_j/(a_i + a_j), a_i on a plane or cylinder [m]
  VecOf<D> normal = VecOf<D>::Zero();  ///< from j to i
};

/// All of them at one instant, walls where their motion takes them, in a periodic box of nearest
/// images.
/// @param turn  orientations of convex bodies; those of the scene's start if null
template <int D>
std::vector<OverlapOf<D>> overlapsOf(const SceneOf<D>& scene, const std::vector<VecOf<D>>& position,
                                     double t, const std::vector<TurnOf<D>>* turn = nullptr);

/// Planes of all bodies at time t, in Scene's order.
template <int D>
std::vector<PlaneOf<D>> planesAt(const SceneOf<D>& scene, double t);

/// Positions of all wall disks at time t, in Scene's order [m].
template <int D>
std::vector<VecOf<D>> wallDisksAt(const SceneOf<D>& scene, double t);

/// The difference of two places, of the nearest images in a periodic box [m].
template <int D>
VecOf<D> apartIn(const SceneOf<D>& scene, const VecOf<D>& difference) {
  return scene.box ? scene.box->nearest(difference) : difference;
}

/// Energies of a scene at the time of a snapshot's velocities [J].
struct EnergyState {
  double kinetic = 0.0;    ///< translation and rotation of the disks
  double elastic = 0.0;    ///< in the contacts, as far as it is known; of bonds < 0
  double potential = 0.0;  ///< of the disks in the plane's gravity, −Σ m g·x

  double total() const { return kinetic + elastic + potential; }
};

/// Of translation and rotation, with the spins of the start where a snapshot has none [J].
template <int D>
double kineticEnergy(const DisksOf<D>& disks, const SnapshotOf<D>& snapshot);

/// From the engine's own ledger where it keeps one. Else from what it shows:
/// positions, and with them the energies of springs and gravity, are taken back to the time that
/// the velocities belong to; so the sum of a leapfrog engine is as good as its scheme, second
/// order. Normal springs hold what the scene's law says of the overlaps, tangential ones f_t²/2k_t
/// of the forces shown, rolling ones M²/2k_r(…) of the torques; cohesion what its law gives, of JKR
/// beyond δ = 0 and of an elasto-plastic law as far as contacts are shown; engines that put
/// impulses in place of the law's springs hold nothing, but at t = 0 what the law would: that much
/// motion a start with overlaps may become.
template <int D>
EnergyState energyOf(const RecordingOf<D>& run, const SnapshotOf<D>& snapshot);

/// Whether the engine has impulses where the scene has springs, so that a start with overlaps holds
/// no energy there but what it makes of them.
template <int D>
bool hasNoSprings(const RecordingOf<D>& run);

/// Scale of all energies of a run: kinetic and elastic energy at the start and the work
/// of lifting every disk by its radius, a bond's energy by its size; where all of that is nothing,
/// the run's largest kinetic and elastic energy [J].
template <int D>
double energyScale(const RecordingOf<D>& run);

}  // namespace crossgrain::inline stability
