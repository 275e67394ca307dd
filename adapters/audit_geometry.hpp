#pragma once

#include <cmath>

#include "adapters/audit.hpp"
#include "law/cohesion.hpp"

namespace crossgrain {

/// Of a spin, an angle, a torque or a tangential force: in the plane a number.
inline double sizeOf(double aboutNormal) {
  return std::abs(aboutNormal);
}
inline double sizeOf(const Vec3& vector) {
  return vector.norm();
}

/// A plane or a cylinder at that time, and the body that moves it.
template <int D>
struct PlacedPlaneOf {
  PlaneOf<D> plane;  ///< not of a cylinder
  const WallBodyOf<D>* body;
  BodyStateOf<D> motion;  ///< of the body
  bool known;             ///< false: it turned in ways that the scene does not prescribe
  const Cylinder* cylinder = nullptr;

  /// Plane that a disk at `place` meets; of a cylinder its tangent plane.
  PlaneOf<D> under(const VecOf<D>& place) const {
    if constexpr (D == 3)
      if (cylinder) return tangentPlane(*cylinder, place);
    return plane;
  }
};

/// Where everything was when a snapshot's contacts were as it shows them, as well as is known.
template <int D>
struct ContactPlacesOf {
  std::vector<VecOf<D>> position;        ///< disks, then wall disks [m]
  std::vector<VecOf<D>> velocity;        ///< likewise, as shown [m/s]
  std::vector<PlacedPlaneOf<D>> planes;  ///< then cylinders
  /// Uncertainty of two bodies' distance, divided by their relative speed [s].
  double drift = 0.0;
  double rounding = 0.0;  ///< [m]
};
using ContactPlaces = ContactPlacesOf<2>;

template <int D>
ContactPlacesOf<D> contactPlaces(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis);

/// Sets wall disks and bodies as the scene prescribes them at that time, without forces, for
/// snapshots of files that lack them.
template <int D>
void placeWallsAsPrescribed(const SceneOf<D>& scene, double t, SnapshotOf<D>& snapshot);

/// Contacts by their first body: those of i are order[begin[i]] … order[begin[i + 1] − 1]. Each
/// body has few, so that a search of this list is faster than of a tree.
struct ContactsByFirst {
  std::vector<std::size_t> begin, order;

  template <int D>
  ContactsByFirst(const ContactsOf<D>& contacts, std::size_t bodies)
      : begin(bodies + 1), order(contacts.size()) {
    for (const std::int32_t i : contacts.i) ++begin[static_cast<std::size_t>(i) + 1];
    for (std::size_t i = 0; i < bodies; ++i) begin[i + 1] += begin[i];
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    for (std::size_t k = 0; k < contacts.size(); ++k)
      order[next[static_cast<std::size_t>(contacts.i[k])]++] = k;
  }

  /// Number of contacts of the pair.
  template <int D>
  std::size_t count(const ContactsOf<D>& contacts, std::size_t i, std::size_t j) const {
    std::size_t found = 0;
    for (std::size_t k = begin[i]; k < begin[i + 1]; ++k)
      found += static_cast<std::size_t>(contacts.j[order[k]]) == j;
    return found;
  }
};

/// Geometry of a pair, in a periodic box of its nearest images: n from j to i, δ > 0 where they
/// overlap, and the uncertainty of δ.
template <int D>
struct PairPlaceOf {
  VecOf<D> normal;
  double overlap;    ///< δ [m]
  double uncertain;  ///< [m]
  double distance;   ///< between centres; to a plane from the disk's centre [m]
};
using PairPlace = PairPlaceOf<2>;

/// Nearest point of the plane.
template <int D>
VecOf<D> footOn(const PlaneOf<D>& plane, const VecOf<D>& point);

/// Velocity of the second of a pair: a disk's at its centre, a plane's at the foot of the first's
/// centre [m/s].
template <int D>
VecOf<D> velocityOfSecond(const ContactPlacesOf<D>& places, const AuditBasisOf<D>& basis,
                          std::size_t i, std::size_t j);

/// @pre ids are in range; the plane is known
template <int D>
PairPlaceOf<D> pairPlace(const ContactPlacesOf<D>& places, const AuditBasisOf<D>& basis,
                         std::size_t i, std::size_t j);

/// The two as the law sees them, moments of inertia apart: walls have no mass.
template <int D>
CollidingPair pairOf(const AuditBasisOf<D>& basis, std::size_t i, std::size_t j);

/// Whether two with this overlap repel each other with any damper up to a critical one:
/// f_el(δ) > max(γ_n, 2 √(m₁₂ f_el′(δ))) v, at the speed v with which they part.
template <int D>
bool pushesForSure(const AuditBasisOf<D>& basis, std::size_t i, std::size_t j, double overlap,
                   double parting);

/// "contact 12 (disk 3 with wall disk 5)"
template <int D>
std::string contactName(const ContactsOf<D>& contacts, std::size_t k, const SceneOf<D>& scene);

}  // namespace crossgrain
