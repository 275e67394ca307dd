#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "averaging/coordinates.hpp"

namespace crossgrain::inline averaging {

/// How a disk, and the force along a branch, is divided among the bins.
enum class WeightMethod {
  slicing,        ///< exact area fraction of the disk
  straightCut,    ///< area fraction with the bins' edges taken as straight (Lätzel 2003, Eq. 5.4)
  centre,         ///< all to the bin that holds the centre (Lätzel 2003, Eq. 5.3)
  lineGaussian,   ///< kernel about the centre, stress along the branch (Goldhirsch 2010, Eq. 25)
  lineHeaviside,  ///< the same with another kernel
  heaviside,  ///< in space, of slabs: a coarse-graining function of one coordinate (kernels.hpp)
  lucy,
  gauss
};

/// The names used in case files and CSV: those of the plane, in enum order, and of space. In space
/// stress lies along branches whatever the weight (space_moments.hpp).
inline constexpr std::array<std::string_view, 5> weightNames = {"slicing", "straight_cut", "centre",
                                                                "line_gaussian", "line_heaviside"};
inline constexpr std::array<std::string_view, 5> spaceWeightNames = {"slicing", "centre",
                                                                     "heaviside", "lucy", "gauss"};
std::span<const std::string_view> weightNamesIn(int dimension);

std::string_view toString(WeightMethod method);

/// @throws std::invalid_argument saying which names there are
WeightMethod weightMethod(std::string_view name);

/// A method and what it needs. The kernels of width w are exp(−r²/w²)/(πw²) and the disc of radius
/// w over its area (Goldhirsch 2010, Granular Matter 12:239).
struct Weight {
  WeightMethod method;
  double width = 0.0;  ///< w of a line method's kernel, or a function's [m]; the others have none

  Weight(WeightMethod how, double w = 0.0) : method(how), width(w) {}

  /// Whether stress is spread along the branches and not over the disk.
  bool alongBranch() const {
    return method == WeightMethod::lineGaussian || method == WeightMethod::lineHeaviside;
  }
  /// Whether it is a coarse-graining function of space.
  bool isFunction() const { return method >= WeightMethod::heaviside; }
};

/// BinFractions out disks and branches of one coordinate by one weight; keeps its memory.
///
/// A Gaussian is a mixture of discs, ∫ u e^{−u} (disc of radius w√u) du. Six of them,
/// Gauss–Laguerre nodes, stand for it: coordinates need to know nothing but how they cut a disc,
/// and fractions stay positive and add up to 1. All moments ⟨r²ᵏ⟩ of the kernel up to k = 10 are
/// exact.
class Partition {
 public:
  /// @throws std::invalid_argument for a line method without a positive width, or one of space
  Partition(const Coordinates& coordinates, const Weight& weight);

  const Weight& weight() const { return weight_; }

  /// A disk of radius a [m] about x.
  const BinFractions& ofDisk(const Vec2& x, double a);

  /// A convex body about x. @param outline  where it is
  const BinFractions& ofBody(const Vec2& x, const std::vector<Vec2>& outline);

  /// Of a wall disk at the border of all bins, as the walls of a Couette cell are: its part in the
  /// cell. What reaches into the overflow is given to the bins that
  /// the disk reaches; a disk that reaches none stays where it is.
  const BinFractions& ofWallDisk(const Vec2& x, double a);

  /// The same for a point of a wall disk's branch.
  const BinFractions& ofWallPoint(const Vec2& point, const Vec2& centre, double a);

  /// The kernel about a point of a branch.
  const BinFractions& ofPoint(const Vec2& point) { return ofDisk(point, 0.0); }

 private:
  const BinFractions& keepInCell(const Vec2& x, double a);

  const Coordinates& coordinates_;
  Weight weight_;
  std::vector<std::pair<double, double>> discs_;  ///< radius and part of the kernel's discs
  BinFractions fractions_, disc_;
};

/// Points along a branch, from the disk's centre (0) to the contact (1), and their parts of it.
struct BranchPoint {
  double place, part;
};

/// Three-point Gauss–Legendre rules in pieces no longer than the kernel's width.
std::vector<BranchPoint> branchPoints(double length, double width);

}  // namespace crossgrain::inline averaging
