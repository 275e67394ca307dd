#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
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

/// Two rings 1–2 m and 2–3 m of height 0.5 m; d = 0.2 m.
Rings twoRings();

/// A scene and one instant of it, grown disk by disk and contact by contact.
struct Instant {
  Scene scene;
  Snapshot snapshot;

  Instant();
  void addDisk(const Vec2& position, double radius, double mass = 1.0,
               const Vec2& velocity = Vec2::Zero(), double spin = 0.0);
  /// A body of wall disks of one radius, which stands still.
  void addWall(const std::string& name, const std::vector<Vec2>& places, double radius);
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

/// Expects of every field of these bins that its slopes in one slot are what central differences of
/// all moments, there and beside it, come to.
template <typename SomeMoments>
void expectSlopes(const auto& bins, const std::vector<SomeMoments>& moments, std::size_t slot,
                  SpringConstants springs = {}) {
  constexpr std::size_t count = std::tuple_size_v<SomeMoments>;
  for (const FieldSpec& field : fieldsOf(bins)) {
    const auto here = evaluate(field, BinView(bins, moments, slot, springs));
    ASSERT_TRUE(here) << field.name;
    std::vector<SomeMoments> slopes(moments.size());
    for (const auto& [index, slope] : here->slopes) slopes[index / count][index % count] += slope;
    for (std::size_t bin = 0; bin < moments.size(); ++bin)
      for (std::size_t q = 0; q < count; ++q) {
        // 1e-5 of the moment itself, or of what it is elsewhere, or of a scale where it is 0.
        double elsewhere = 0.0;
        for (const SomeMoments& each : moments) elsewhere = std::max(elsewhere, std::abs(each[q]));
        const double least = elsewhere > 0.0 ? 1e-2 * elsewhere : 1e-9;
        const double step = 1e-5 * std::max(std::abs(moments[bin][q]), least);
        const auto moved = [&](double by) {
          auto other = moments;
          other[bin][q] += by;
          return evaluate(field, BinView(bins, other, slot, springs))->value;
        };
        const double change = (moved(step) - moved(-step)) / 2.0;
        // Truncation 1e-10, rounding 1e-16 of the value, per step of 1e-5.
        EXPECT_NEAR(slopes[bin][q] * step, change,
                    1e-5 * std::abs(change) + 1e-13 * std::abs(here->value))
            << field.name << " moment " << q;
      }
  }
}

/// Σ over all slots of one moment
double total(const std::vector<Moments>& moments, Moment which, int k = 0);

}  // namespace crossgrain::test
