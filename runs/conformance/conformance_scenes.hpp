#pragma once

#include <string>
#include <vector>

#include "runs/conformance/scene_parts.hpp"
#include "runs/conformance/thesis_laws.hpp"

namespace crossgrain::conformance {

/// The thesis' law; its rigid side, for engines that have only that, restores e_n = 0.8 and
/// e_t0 = 0.3.
ContactLaw fullLaw();

/// The law without anything that could turn a disk.
ContactLaw frictionless(ContactLaw law);

/// A scene without disks; its time step resolves the contact of two small disks by `steps`, at
/// Encounter::speed where that matters.
Scene emptyScene(const ContactLaw& law, double steps);

/// A body of wall disks of the small radius.
WallBody wallOf(const std::string& name, const Vec2& centre, const std::vector<Vec2>& disks,
                const Motion& motion = {});

/// Two disks that meet. Disk 0 comes from the right at `speed` relative to disk 1; the line of
/// centres makes the angle `obliqueness` with the path when they touch. Their centre of mass starts
/// at the origin and moves at `drift`.
struct Encounter {
  double radii[2] = {smallRadius, smallRadius};
  double masses[2] = {smallMass, smallMass};
  double obliqueness = 0.0;  ///< [rad]
  double spins[2] = {0.0, 0.0};
  Vec2 drift = Vec2::Zero();

  static constexpr double speed = 0.1;   ///< [m/s]
  static constexpr double gap = 1.3e-4;  ///< flown through before they touch [m]
  static constexpr double end = 0.01;    ///< by then every pair used here has parted [s]

  double reducedMass() const { return masses[0] * masses[1] / (masses[0] + masses[1]); }
};

/// An oblique impact of unequal disks that drift and spin: no symmetry hides a wrong sign.
Encounter crookedEncounter();

/// @param steps  time steps in one contact of two small disks
Scene encounterScene(const Encounter& pair, const ContactLaw& law, double steps);

/// A disk that meets a plane at 45°, a little more slowly, and turns.
Scene landingScene(const ContactLaw& law, double steps);

/// Disks that are heaped on a turning wheel between posts: many contacts of all kinds but planes.
/// There are some at busyEnd.
Scene busyScene(const ContactLaw& law);
inline constexpr double busyEnd = 0.02;  ///< [s]

}  // namespace crossgrain::conformance
