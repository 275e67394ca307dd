#pragma once

#include <vector>

#include "averaging/coordinates.hpp"

namespace crossgrain::inline averaging {

/// Concentric rings about the origin: the coordinate of every profile.
///
/// Bins are numbered by increasing radius: −1 is the overflow bin inside R_i, 0 … B−1 are the
/// rings, B is the overflow bin outside R_o. Nothing is lost: sums over all bins are sums over all
/// disks. Ring k holds edge(k) ≤ r < edge(k+1).
class Rings : public Coordinates {
 public:
  /// @param innerRadius R_i ≥ 0 [m]  @param outerRadius R_o > R_i [m]  @param count B ≥ 1
  /// @param height h of the disks, normal to the plane [m]
  /// @param diameter d, the unit of r̃ (twice the small radius in the thesis' cell) [m]
  /// @throws std::invalid_argument naming the value that is out of range
  Rings(double innerRadius, double outerRadius, int count, double height, double diameter);

  /// Rings between edges that rise from R_i ≥ 0 to R_o, of any widths [m].
  /// @throws std::invalid_argument as above
  Rings(std::vector<double> edges, double height, double diameter);

  int count() const { return static_cast<int>(edges_.size()) - 1; }
  double innerRadius() const { return edges_.front(); }
  double outerRadius() const { return edges_.back(); }
  double height() const override { return height_; }
  double diameter() const { return diameter_; }

  int insideBin() const { return -1; }
  int outsideBin() const { return count(); }

  /// Number of bins, overflow included, and the place of a bin in an array of that length.
  std::size_t slots() const override { return edges_.size() + 1; }
  std::size_t slot(int bin) const { return static_cast<std::size_t>(bin + 1); }

  /// Radius of edge k = 0 … B; ring k lies between edges k and k+1 [m]
  double edge(int k) const { return edges_[static_cast<std::size_t>(k)]; }

  /// Radius half way between a ring's edges [m]
  double centre(int ring) const { return 0.5 * (edge(ring) + edge(ring + 1)); }

  /// r̃ = (r − R_i)/d at a ring's centre (Lätzel 2003, section 6.1) [-]
  double rTilde(int ring) const { return (centre(ring) - innerRadius()) / diameter_; }

  /// V = π(r₂² − r₁²)h of a ring, which is 2π r Δr h at its centre (Lätzel 2003, Fig. 5.2) [m³]
  double ringVolume(int ring) const;

  /// The bin that holds a point at distance r from the origin.
  int binOf(double r) const;

  bool isOverflow(std::size_t slot) const override { return slot == 0 || slot > edges_.size() - 1; }
  double volume(std::size_t slot) const override { return ringVolume(static_cast<int>(slot) - 1); }
  std::size_t slotAt(const Vec2& x) const override { return slot(binOf(x.norm())); }
  Vec2 firstDirection(const Vec2& x) const override;
  void discFractions(const Vec2& x, double a, Edges edges, BinFractions& fractions) const override;
  void outlineFractions(const std::vector<Vec2>& outline, BinFractions& fractions) const override;

  /// Of the parabola through the ring and its neighbours, at the first and the last ring through
  /// the three rings there. Absent with fewer than three rings.
  std::optional<Slope> slope(std::size_t slot) const override;

 private:
  void check() const;
  /// @param within  the part of a body's area within a radius of the origin
  void fractionsOf(double nearest, double farthest, auto&& within, BinFractions& fractions) const;

  std::vector<double> edges_;
  double height_;
  double diameter_;
};

}  // namespace crossgrain::inline averaging
