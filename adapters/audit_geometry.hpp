#pragma once

#include "adapters/audit.hpp"

namespace crossgrain {

/// A plane at that time, and the body that moves it.
struct PlacedPlane {
  Plane plane;
  const WallBody* body;
  BodyState motion;  ///< of the body
  bool known;        ///< false: it turned in ways that nobody prescribed
};

/// Where everything was when a snapshot's contacts were as it shows them, as well as is known.
struct ContactPlaces {
  std::vector<Vec2> position;  ///< disks, then wall disks [m]
  std::vector<Vec2> velocity;  ///< likewise, as shown [m/s]
  std::vector<PlacedPlane> planes;
  /// What of two bodies' relative motion their places are uncertain by [s].
  double drift = 0.0;
  double rounding = 0.0;  ///< [m]
};

ContactPlaces contactPlaces(const Snapshot& snapshot, const AuditBasis& basis);

/// Wall disks and bodies as the scene prescribes them at that time, without forces: what a snapshot
/// of somebody else's need not say.
void placeWallsAsPrescribed(const Scene& scene, double t, Snapshot& snapshot);

/// How a pair lies there: n from j to i, δ > 0 where they overlap, and how far δ may be off.
struct PairPlace {
  Vec2 normal;
  double overlap;    ///< δ [m]
  double uncertain;  ///< [m]
  double distance;   ///< between centres; to a plane from the disk's centre [m]
};

/// The point of the plane that is nearest.
Vec2 footOn(const Plane& plane, const Vec2& point);

/// Of the second of a pair: of a disk's centre; of a plane where the first's centre has its foot
/// [m/s].
Vec2 velocityOfSecond(const ContactPlaces& places, const AuditBasis& basis, std::size_t i,
                      std::size_t j);

/// @pre ids are in range; the plane is known
PairPlace pairPlace(const ContactPlaces& places, const AuditBasis& basis, std::size_t i,
                    std::size_t j);

/// "contact 12 (disk 3 with wall disk 5)"
std::string contactName(const Contacts& contacts, std::size_t k, const Scene& scene);

}  // namespace crossgrain
