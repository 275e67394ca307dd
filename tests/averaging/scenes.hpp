#pragma once

#include <cstdint>
#include <vector>

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"
#include "averaging/fields.hpp"
#include "averaging/moments.hpp"
#include "averaging/rings.hpp"
#include "averaging/weights.hpp"

namespace crossgrain::test {

/// The thesis' cell: R_i, R_o, h and d in metres, 20 rings.
Rings thesisRings(int count = 20);

/// A scene and one instant of it, grown disk by disk and contact by contact.
struct Instant {
  Scene scene;
  Snapshot snapshot;

  Instant();
  void addDisk(const Vec2& position, double radius, double mass = 1.0,
               const Vec2& velocity = Vec2::Zero(), double spin = 0.0);
  /// normal from j to i, as in Contacts
  void addContact(std::int32_t i, std::int32_t j, const Vec2& normal, double normalForce,
                  double tangentialForce);
};

/// Seeded disks all over the thesis' cell and beyond both walls, with random velocities, spins and
/// contacts (disk with disk, disk with a wall body of two wall disks). No mechanics: only sums.
Instant randomInstant(std::uint64_t seed, int disks);

/// Neighbours along m·e1 + n·e2 push on each other with that force [N].
struct Bond {
  int m, n;
  double force;
};

/// Disks of radius a on all lattice points m·e1 + n·e2 within 0.28 m of the origin.
Instant lattice(double a, const Vec2& e1, const Vec2& e2, const std::vector<Bond>& bonds);

/// Touching disks, six neighbours each, equal forces.
Instant triangularLattice(double a, double force);

/// The moments under one weight, per slot.
std::vector<Moments> momentsOf(const Coordinates& coordinates, const Instant& instant,
                               Weight weight = WeightMethod::slicing, bool countWallDisks = false);

/// A field in one slot; a failure, and NaN, where it is absent.
double fieldIn(std::size_t slot, const char* field, const Coordinates& coordinates,
               const std::vector<Moments>& moments, SpringConstants springs = {});

/// The same in ring k of rings.
double valueOf(const char* field, const Rings& rings, const std::vector<Moments>& moments, int ring,
               SpringConstants springs = {});

/// Σ over all slots of one moment
double total(const std::vector<Moments>& moments, Moment which);

}  // namespace crossgrain::test
