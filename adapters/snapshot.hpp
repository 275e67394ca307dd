#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "adapters/energy_ledger.hpp"
#include "adapters/vec2.hpp"

namespace crossgrain {

/// Which contacts a snapshot is to hold.
enum class ContactReport {
  none,
  instant,     ///< forces at contactTime
  accumulated  ///< impulses since the last such snapshot (or load) divided by that interval
};

/// Contacts as the engine computed them, structure of arrays, i < j by Scene's ids.
/// The normal points from j to i; forces act on i.
struct Contacts {
  std::vector<std::int32_t> i, j;
  std::vector<Vec2> normal;
  std::vector<double> overlap;          ///< δ > 0 where the disks overlap [m]
  std::vector<double> normalForce;      ///< f_n on i along the normal, > 0 repulsive [N]
  std::vector<double> tangentialForce;  ///< f_t on i along z × normal [N]
  std::vector<std::uint8_t> sliding;    ///< 1 where the Coulomb bound holds; may be empty: unknown
  /// M on i, −M on j, of laws that resist rolling [N m]; may be empty: none, or unknown
  std::vector<double> rollingTorque;
  /// Power that dashpots, sliding, rolling and yield turn into heat, over the step that ends at
  /// contactTime or at that instant [W]; may be empty: unknown. Asked for with
  /// Scene::energyLedger
  std::vector<double> dissipation;

  std::size_t size() const { return i.size(); }
  /// On the first of the two [N].
  Vec2 force(std::size_t k) const {
    return normalForce[k] * normal[k] + tangentialForce[k] * perpendicular(normal[k]);
  }
};

/// State of one wall body and what the disks do to it.
struct BodySnapshot {
  Vec2 centre = Vec2::Zero();    ///< [m]
  double angle = 0.0;            ///< since t = 0 [rad]
  Vec2 velocity = Vec2::Zero();  ///< [m/s]
  double angularVelocity = 0.0;  ///< [rad/s]
  std::optional<Vec2> force;     ///< on the body [N]
  std::optional<double> torque;  ///< on the body about its centre [N m]
};

/// Energies where the engine has them [J].
struct Energies {
  double kinetic = 0.0;  ///< translation and rotation of the disks
  double elastic = 0.0;  ///< normal and tangential springs
};

/// What an engine shows of its state. Engines stagger their arrays in time, so each says its own.
/// Absent data is absent, never zero.
struct Snapshot {
  double positionTime = 0.0;     ///< [s]
  double velocityTime = 0.0;     ///< [s]
  double contactTime = 0.0;      ///< of contacts and wall forces [s]
  double contactInterval = 0.0;  ///< > 0: forces are means over this interval up to contactTime [s]

  std::vector<Vec2> position;               ///< disks [m]
  std::vector<Vec2> velocity;               ///< disks [m/s]
  std::optional<std::vector<double>> spin;  ///< disks [rad/s]; absent where nothing spins
  std::vector<Vec2> wallPosition;           ///< wall disks, body by body [m]
  std::vector<BodySnapshot> bodies;
  std::optional<Contacts> contacts;
  std::optional<Energies> energies;
  std::optional<EnergyLedger> ledger;  ///< where Scene::energyLedger asks for it; of positionTime
};

/// When the motion had the velocities that a snapshot shows [s].
/// @param lag  EffectiveParameters::velocityLag; a scene's own velocities at t = 0 have none
inline double timeOfVelocities(const Snapshot& snapshot, double lag) {
  return snapshot.velocityTime - (snapshot.positionTime > 0.0 ? lag : 0.0);
}

}  // namespace crossgrain
