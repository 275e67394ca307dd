#pragma once

#include <optional>
#include <string_view>

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"

namespace crossgrain::inline averaging {

/// Numbers of a whole scene at one instant. What the snapshot has no data for is absent.
struct GlobalNumbers {
  double kineticEnergy = 0.0;  ///< Σ ½ m v² + ½ J ω² over the disks (ω if there is one) [J]
  /// Contacts per disk, those with walls included [-]. @see contact_rule.hpp
  std::optional<double> coordination;
  /// The same count of all pairs that the engine lists, whether or not a force passes [-].
  std::optional<double> listedPairs;
  std::optional<double> maxOverlap;       ///< of any pair listed; absent without one [m]
  std::optional<double> meanOverlap;      ///< over contacts; absent without one [m]
  std::optional<double> slidingFraction;  ///< of contacts at the Coulomb bound [-]
};

/// @throws std::invalid_argument if the snapshot does not fit the scene
template <int D>
GlobalNumbers globalNumbers(const SceneOf<D>& scene, const SnapshotOf<D>& snapshot);

/// Contacts of the named body's disks and planes with the moving disks. Absent without contacts in
/// the snapshot and for a body of nothing (of another source's snapshots, say); with accumulated
/// ones it counts what transmitted a force within their interval.
/// @throws std::invalid_argument if the scene has no such body
std::optional<double> contactsOf(const Scene& scene, const Snapshot& snapshot,
                                 std::string_view body);

/// Pressure of the disks on the named body at radius R [m], height h [m] [N/m²]:
/// Σ_c f·e_r / (2πRh) with f the force on the wall in one contact and e_r the direction from the
/// body's centre to that contact; positive where the disks push outward on a ring (compression).
/// Contact by contact, since the body's net force is about 0. Absent without contacts in the
/// snapshot.
/// @throws std::invalid_argument if the scene has no such body
std::optional<double> radialPressure(const Scene& scene, const Snapshot& snapshot,
                                     std::string_view body, double radius, double height);

/// Torque that the named body exerts on the disks about its centre [N m], > 0 where Ω > 0 drags
/// them: minus BodySnapshot::torque. Without bottom friction it is σ_φr·2πr²h at every r.
/// @throws std::invalid_argument if the scene has no such body
std::optional<double> drivingTorque(const Scene& scene, const Snapshot& snapshot,
                                    std::string_view body);

/// Force of the disks on a wall body, or on one of its planes [N]: as the engine reports it where
/// that is all of the body, else the sum over contacts. Absent for a snapshot without either.
/// @pre the scene has that body, and the body that plane
template <int D>
std::optional<VecOf<D>> forceOnWall(const SceneOf<D>& scene, const SnapshotOf<D>& snapshot,
                                    std::size_t body, std::optional<std::size_t> plane = {});

/// Of a cell between two walls: a box that is periodic but for one direction n, and at least two
/// bodies. F is the force on the lowest and the highest body along n, A the area across n: the
/// box's, or its length times h in the plane. Stresses as in the bins next to the walls, where
/// nothing accelerates: n is z (in space), t is x; else n is y and t is x, or n is x and t is y.
struct WallStresses {
  double normal = 0.0;  ///< (F_high − F_low)·n / 2A, > 0 pushes them apart [N/m²]
  double shear = 0.0;  ///< (F_low − F_high)·t / 2A, > 0 where the high one drags along +t [N/m²]
};

/// Forces as the engine reports them, else the sum over contacts. Absent for any other scene and
/// for a snapshot without either.
/// @param height  h of the disks; 1 in space [m]
template <int D>
std::optional<WallStresses> wallStresses(const SceneOf<D>& scene, const SnapshotOf<D>& snapshot,
                                         double height);

/// Whether a scene is such a cell.
template <int D>
bool hasTwoWalls(const SceneOf<D>& scene);

}  // namespace crossgrain::inline averaging
