#pragma once

#include <optional>

#include "adapters/scene.hpp"
#include "averaging/coordinates.hpp"

namespace crossgrain::inline averaging {

/// A Cartesian grid of nx × ny equal cells; directions are x and y everywhere. It has no slope(): a
/// gradient needs both directions, and fields know but the first. One cell over everything gives
/// whole-cell averages. Slot 0 is the overflow, cell (i, j) is slot 1 + i + nx j.
class Grid : public Coordinates {
 public:
  /// @param low, high  corners [m]  @param height h of the disks [m]
  /// @param box  the scene's, if it has one: along its periodic directions places are of any image
  /// @throws std::invalid_argument naming the value that is out of range
  Grid(const Vec2& low, const Vec2& high, int nx, int ny, double height,
       const std::optional<BoxOf<2>>& box = {});

  std::size_t slot(int i, int j) const { return static_cast<std::size_t>(1 + i + nx_ * j); }

  /// Of cell number k = i + nx j [m]
  Vec2 centre(int k) const { return low_ + cell_.cwiseProduct(Vec2(k % nx_ + 0.5, k / nx_ + 0.5)); }
  int cells() const { return nx_ * ny_; }

  std::size_t slots() const override { return static_cast<std::size_t>(nx_ * ny_) + 1; }
  bool isOverflow(std::size_t slot) const override { return slot == 0; }
  bool isCartesian() const override { return true; }
  double height() const override { return height_; }
  double volume(std::size_t) const override { return cell_.prod() * height_; }
  std::size_t slotAt(const Vec2& x) const override;
  Vec2 firstDirection(const Vec2&) const override { return Vec2::UnitX(); }
  /// Straight edges are exact here: both kinds of cut are one. What sticks out of a periodic side
  /// counts inside the other.
  void discFractions(const Vec2& x, double a, Edges edges, BinFractions& fractions) const override;
  void outlineFractions(const std::vector<Vec2>& outline, BinFractions& fractions) const override;

 private:
  /// Of a body between two corners, every image of it.
  /// @param within  its area below and left of a place [whole]
  template <typename Within>
  void fractionsOf(const Vec2& low, const Vec2& high, double whole, const Within& within,
                   BinFractions& fractions) const;

  Vec2 low_, cell_;
  int nx_, ny_;
  double height_;
  Vec2 period_ = Vec2::Zero();  ///< 0 along what is not periodic [m]
};

}  // namespace crossgrain::inline averaging
