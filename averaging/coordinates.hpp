#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "adapters/vec2.hpp"

namespace crossgrain::inline averaging {

/// The part of something that one bin gets.
struct BinFraction {
  std::size_t slot;
  double fraction;
};
using BinFractions = std::vector<BinFraction>;

/// How a bin's edges cut a disc: as they are, or straightened (Lätzel 2003, Eq. 5.4).
enum class Edges { exact, straight };

/// ∂/∂x₁ at a bin as a sum over bins, Σ fraction · field [1/m], and the bin's radius of curvature.
struct Slope {
  BinFractions terms;
  double radius;  ///< r of a ring's centre [m]
};

/// Bins: places ("slots") in an array. Some are overflow: with them nothing is lost, sums over all
/// slots are sums over all disks.
class BinSet {
 public:
  virtual ~BinSet() = default;

  virtual int dimension() const { return 2; }
  virtual std::size_t slots() const = 0;
  virtual bool isOverflow(std::size_t slot) const = 0;
  /// Of a bin that is no overflow [m³]
  virtual double volume(std::size_t slot) const = 0;

  /// Whether the directions are x and y (and z) everywhere.
  virtual bool isCartesian() const { return false; }

  /// Absent where there is no derivative to offer.
  virtual std::optional<Slope> slope(std::size_t) const { return std::nullopt; }
};

/// Where averages are taken in the plane: bins, and two directions at every point. Weights and
/// fields know no more than this, so a new coordinate is a class of its own.
class Coordinates : public BinSet {
 public:
  /// h of the disks, normal to the plane [m]
  virtual double height() const = 0;

  virtual std::size_t slotAt(const Vec2& x) const = 0;

  /// Unit vector along the first direction at x, e_r for rings. The second is z × it.
  virtual Vec2 firstDirection(const Vec2& x) const = 0;

  /// The area fractions of a disc of radius a [m] about x, in rising order of slots; they add up
  /// to 1. Whatever was in `fractions` is dropped.
  virtual void discFractions(const Vec2& x, double a, Edges edges,
                             BinFractions& fractions) const = 0;

  /// The same of a convex polygon, counter-clockwise [m]; edges are exact.
  virtual void outlineFractions(const std::vector<Vec2>& outline,
                                BinFractions& fractions) const = 0;
};

}  // namespace crossgrain::inline averaging
