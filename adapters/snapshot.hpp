#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "adapters/energy_ledger.hpp"
#include "adapters/shape.hpp"
#include "adapters/vec2.hpp"

namespace crossgrain {

/// Which contacts a snapshot is to hold.
enum class ContactReport {
  none,
  instant,     ///< forces at contactTime
  accumulated  ///< impulses since the last such snapshot (or load) divided by that interval
};

/// Contacts as the engine computed them, structure of arrays, i < j by Scene's ids.
/// The normal points from j to i; forces act on i. Two bodies that touch in several points have one
/// contact with the sum of their forces: it acts at the mean of the points, weighed with the normal
/// forces, and what moment is left about that is the torque.
template <int D>
struct ContactsOf {
  std::vector<std::int32_t> i, j;
  std::vector<VecOf<D>> normal;
  std::vector<double> overlap;      ///< δ > 0 where the disks overlap [m]
  std::vector<double> normalForce;  ///< f_n on i along the normal, > 0 repulsive [N]
  /// f_t on i: along z × normal; in space the vector, normal to `normal` [N]
  std::vector<SpinOf<D>> tangentialForce;
  std::vector<std::uint8_t> sliding;  ///< 1 where the Coulomb bound holds; may be empty: unknown
  /// M on i, −M on j, of laws that resist rolling, and of several points [N m]; may be empty: none,
  /// or unknown
  std::vector<SpinOf<D>> rollingTorque;
  /// Power that dashpots, sliding, rolling and yield turn into heat, over the step that ends at
  /// contactTime or at that instant [W]; may be empty: unknown. Asked for with
  /// Scene::energyLedger
  std::vector<double> dissipation;
  /// Where the force acts; may be empty in scenes of disks alone [m]
  std::vector<VecOf<D>> point = {};

  std::size_t size() const { return i.size(); }
  /// On the first of the two [N].
  VecOf<D> force(std::size_t k) const {
    if constexpr (D == 2)
      return normalForce[k] * normal[k] + tangentialForce[k] * perpendicular(normal[k]);
    else
      return normalForce[k] * normal[k] + tangentialForce[k];
  }
};
using Contacts = ContactsOf<2>;

/// State of one wall body and what the disks do to it.
template <int D>
struct BodySnapshotOf {
  VecOf<D> centre = VecOf<D>::Zero();       ///< [m]
  SpinOf<D> angle = noSpin<D>();            ///< since t = 0; in space about one axis [rad]
  VecOf<D> velocity = VecOf<D>::Zero();     ///< [m/s]
  SpinOf<D> angularVelocity = noSpin<D>();  ///< [rad/s]
  std::optional<VecOf<D>> force;            ///< on the body [N]
  std::optional<SpinOf<D>> torque;          ///< on the body about its centre [N m]
};
using BodySnapshot = BodySnapshotOf<2>;

/// Energies where the engine has them [J].
struct Energies {
  double kinetic = 0.0;  ///< translation and rotation of the disks
  double elastic = 0.0;  ///< normal and tangential springs
};

/// State that an engine reports. Engines stagger their arrays in time, so each kind has its own.
/// Absent data is absent, never zero.
template <int D>
struct SnapshotOf {
  double positionTime = 0.0;     ///< [s]
  double velocityTime = 0.0;     ///< [s]
  double contactTime = 0.0;      ///< of contacts and wall forces [s]
  double contactInterval = 0.0;  ///< > 0: forces are means over this interval up to contactTime [s]

  std::vector<VecOf<D>> position;              ///< disks, of any image in a periodic box [m]
  std::vector<VecOf<D>> velocity;              ///< disks [m/s]
  std::optional<std::vector<SpinOf<D>>> spin;  ///< disks [rad/s]; absent where nothing spins
  std::optional<std::vector<TurnOf<D>>> turn;  ///< of disks; where there are convex bodies
  std::vector<VecOf<D>> wallPosition;          ///< wall disks, body by body [m]
  std::vector<BodySnapshotOf<D>> bodies;
  std::optional<ContactsOf<D>> contacts;
  std::optional<Energies> energies;
  std::optional<EnergyLedger> ledger;  ///< where Scene::energyLedger asks for it; of positionTime
};
using Snapshot = SnapshotOf<2>;
using SpaceSnapshot = SnapshotOf<3>;

/// Orientation of a body; null where all are round.
template <int D>
const TurnOf<D>* turnIn(const SnapshotOf<D>& snapshot, std::size_t i) {
  return snapshot.turn ? &(*snapshot.turn)[i] : nullptr;
}

/// When the motion had the velocities that a snapshot shows [s].
/// @param lag  EffectiveParameters::velocityLag; a scene's own velocities at t = 0 have none
template <int D>
double timeOfVelocities(const SnapshotOf<D>& snapshot, double lag) {
  return snapshot.velocityTime - (snapshot.positionTime > 0.0 ? lag : 0.0);
}

}  // namespace crossgrain
