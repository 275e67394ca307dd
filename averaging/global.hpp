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
GlobalNumbers globalNumbers(const Scene& scene, const Snapshot& snapshot);

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

}  // namespace crossgrain::inline averaging
