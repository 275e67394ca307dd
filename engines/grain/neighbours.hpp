#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace grain {

/// Verlet list: for each moving disk i the disks j > i (moving, or of a wall) whose surfaces are
/// nearer than a skin, with the tangential spring of each pair. Rows are in ascending j.
class Neighbours {
 public:
  /// @param moving  disks 0 … moving−1 move; those after belong to walls and never meet each other
  /// @param skin    gap up to which pairs are listed [m]
  Neighbours(std::size_t moving, double skin) : moving_(moving), skin_(skin) {}

  /// Whether some disk has moved so far since rebuild() that an unlisted pair may touch.
  /// True also where a position is not finite.
  bool outdated(std::span<const double> x, std::span<const double> y) const;

  /// Lists the pairs anew; springs of pairs that stay listed are kept, all others start at zero.
  /// @throws std::runtime_error naming the first disk whose position is not finite
  void rebuild(std::span<const double> x, std::span<const double> y,
               std::span<const double> radius);

  std::size_t rowBegin(std::size_t i) const { return row_[i]; }
  std::size_t rowEnd(std::size_t i) const { return row_[i + 1]; }
  std::int32_t partner(std::size_t pair) const { return partner_[pair]; }
  double& spring(std::size_t pair) { return spring_[pair]; }
  std::size_t pairCount() const { return partner_.size(); }
  std::size_t rebuilds() const { return rebuilds_; }

 private:
  void sortIntoCells(std::span<const double> x, std::span<const double> y, double cellSize);
  void collectRow(std::size_t i, std::span<const double> x, std::span<const double> y,
                  std::span<const double> radius);
  void keepSprings();

  std::size_t moving_;
  double skin_;
  std::vector<std::size_t> row_{0}, oldRow_;
  std::vector<std::int32_t> partner_, oldPartner_;
  std::vector<double> spring_, oldSpring_;
  std::vector<double> builtX_, builtY_;  ///< positions at the last rebuild
  std::size_t rebuilds_ = 0;

  // Cell grid of the last rebuild: disks sorted by cell, cellStart_[c] … cellStart_[c+1].
  double originX_ = 0.0, originY_ = 0.0, cellSize_ = 1.0;
  std::int64_t columns_ = 0, lines_ = 0;
  std::vector<std::int32_t> cellStart_, cellOf_, sorted_;
};

}  // namespace grain
