#pragma once

#include <optional>
#include <vector>

#include "averaging/space_bins.hpp"

namespace crossgrain::inline averaging {

/// Rings about the z axis, of equal widths, in layers one above the other: directions r, φ and z.
/// Slot 0 is the overflow, ring k of layer l is slot 1 + k + rings·l.
///
/// The fraction of a sphere in a ring is an integral over its slices (volumes.hpp), to 1e-8; a line
/// is cut exactly, and each piece of it has the directions of three points (Gauss and Legendre's).
class SpaceRings : public SpaceBins {
 public:
  /// @param box  the scene's, if it has one: of its directions z alone may be periodic
  /// @throws std::invalid_argument naming the value that is out of range
  SpaceRings(double innerRadius, double outerRadius, int rings, double low, double high, int layers,
             const std::optional<BoxOf<3>>& box = {});

  std::size_t slots() const override {
    return static_cast<std::size_t>(rings_.count() * layers_.count()) + 1;
  }
  bool isOverflow(std::size_t slot) const override { return slot == 0; }
  double volume(std::size_t slot) const override;
  std::size_t slotAt(const Vec3& x) const override;
  Eigen::Matrix3d directions(const Vec3& x) const override;
  void lineFractions(const Vec3& x, const Vec3& step, const Weight& weight,
                     std::vector<LineFraction>& fractions) const override;

  const Parts& rings() const { return rings_; }
  const Parts& layers() const { return layers_; }

 protected:
  void addVolumes(const Vec3& x, double a, BinFractions& fractions) const override;

 private:
  std::size_t slot(int ring, int layer) const {
    return static_cast<std::size_t>(1 + ring + rings_.count() * layer);
  }

  Parts rings_, layers_;
};

}  // namespace crossgrain::inline averaging
