#pragma once

#include <array>
#include <optional>
#include <vector>

#include "adapters/scene.hpp"
#include "averaging/coordinates.hpp"
#include "averaging/kernels.hpp"
#include "averaging/weights.hpp"

namespace crossgrain::inline averaging {

/// The part of a line that one bin gets, and a place on it, whose directions count.
struct LineFraction {
  std::size_t slot;
  double fraction;
  Vec3 place;  ///< [m]
};

/// Equal parts of a range of one coordinate, which may be periodic.
class Parts {
 public:
  /// @param period  0: none
  /// @throws std::invalid_argument for no range, or one longer than the period
  Parts(double low, double high, int count, double period, const char* name);

  int count() const { return count_; }
  double edge(int k) const { return k == count_ ? high_ : low_ + k * width_; }
  double centre(int k) const { return low_ + (k + 0.5) * width_; }
  double width() const { return width_; }
  /// One part that is all there is: no edge cuts anything.
  bool isAll() const { return all_; }

  /// The part that holds x; absent outside.
  std::optional<int> at(double x) const;

  /// The stretch within r of x in one part, of any image, from there to there relative to x.
  struct Cut {
    int part;
    double from, to;
  };
  void cut(double x, double r, std::vector<Cut>& cuts) const;

  /// Appends where, between 0 and 1, x + s step crosses an edge of any image.
  void crossings(double x, double step, std::vector<double>& s) const;

 private:
  /// Index of the first part to look at, 0 … count: beyond the last there is none.
  int partFrom(double place) const;

  double low_, high_, width_, period_;
  int count_;
  bool all_;
};

/// Bins in space. Places are of any image of a periodic box.
class SpaceBins : public BinSet {
 public:
  int dimension() const override { return 3; }

  virtual std::size_t slotAt(const Vec3& x) const = 0;

  /// Unit vectors along the three directions at x, as columns.
  virtual Eigen::Matrix3d directions(const Vec3&) const { return Eigen::Matrix3d::Identity(); }

  /// The fractions of a sphere of radius a [m] about x, or of a point (a = 0); they add up to 1
  /// over all slots. Whatever was in `fractions` is dropped. @pre require(weight)
  void sphereFractions(const Vec3& x, double a, const Weight& weight,
                       BinFractions& fractions) const;
  /// The same of a body of radius a about x, by points that fill it evenly.
  void bodyFractions(const Vec3& x, double a, const std::vector<Vec3>& points, const Weight& weight,
                     BinFractions& fractions) const;
  /// The same of a line from x to x + step; with a function each of its points is spread.
  virtual void lineFractions(const Vec3& x, const Vec3& step, const Weight& weight,
                             std::vector<LineFraction>& fractions) const = 0;

  /// @throws std::invalid_argument if these bins do not go with that weight
  virtual void require(const Weight& weight) const;

 protected:
  /// Appends the fractions by volume.
  virtual void addVolumes(const Vec3& x, double a, BinFractions& fractions) const = 0;
  /// Those by a function. @pre the bins go with it
  virtual void addByFunction(const Vec3&, const KernelIn1d&, BinFractions&) const {}
};

/// nx × ny × nz equal cells of a box, directions x, y and z everywhere: slabs are a row of them,
/// one cell over everything gives whole-box averages. Slot 0 is the overflow, cell (i, j, k) is
/// slot 1 + i + nx (j + ny k). Along a periodic direction of the scene a sphere that sticks out of
/// a side counts inside the other.
///
/// Spheres that planes of one direction cut are divided exactly, by others to 1e-8. A
/// coarse-graining function is of slabs: it spreads along their axis alone, and across it what lies
/// beside the slabs (its centre, that part of the line) is left out.
class Cells : public SpaceBins {
 public:
  /// @param box   the scene's, if it has one
  /// @param axis  of slabs: 0, 1, 2; else absent
  /// @throws std::invalid_argument naming the value that is out of range
  Cells(const Vec3& low, const Vec3& high, const std::array<int, 3>& count,
        const std::optional<BoxOf<3>>& box, std::optional<int> axis = {});

  std::size_t slots() const override { return static_cast<std::size_t>(cells()) + 1; }
  bool isOverflow(std::size_t slot) const override { return slot == 0; }
  bool isCartesian() const override { return true; }
  double volume(std::size_t) const override { return volume_; }
  std::size_t slotAt(const Vec3& x) const override;
  void lineFractions(const Vec3& x, const Vec3& step, const Weight& weight,
                     std::vector<LineFraction>& fractions) const override;
  void require(const Weight& weight) const override;

  int cells() const { return parts_[0].count() * parts_[1].count() * parts_[2].count(); }
  /// Of cell number n = i + nx (j + ny k) [m]
  Vec3 centre(int n) const;
  const Parts& parts(int direction) const { return parts_[static_cast<std::size_t>(direction)]; }

 protected:
  void addVolumes(const Vec3& x, double a, BinFractions& fractions) const override;
  void addByFunction(const Vec3& x, const KernelIn1d& kernel,
                     BinFractions& fractions) const override;

 private:
  std::size_t slot(int i, int j, int k) const {
    return static_cast<std::size_t>(1 + i + parts_[0].count() * (j + parts_[1].count() * k));
  }
  /// By a function what is spread evenly along the axis, over ± half about x. @param put  of a slot
  /// and its fraction
  void spread(const Vec3& x, double half, const KernelIn1d& kernel, auto&& put) const;

  std::array<Parts, 3> parts_;
  std::optional<int> axis_;
  double volume_;
};

/// The function that a weight names. @pre weight.isFunction()
KernelIn1d kernelOf(const Weight& weight);

}  // namespace crossgrain::inline averaging
