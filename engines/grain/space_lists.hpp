#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engines/grain/skin.hpp"
#include "engines/grain/space_views.hpp"

namespace grain {

/// A cell that is repeated along its periodic directions.
struct SpaceBox {
  Vec3<double> low, length;  ///< [m]
  std::array<bool, 3> periodic{};

  /// Where the image of j is, from j, that is nearest to i; `apart` is x_i − x_j.
  Vec3<double> shift(const Vec3<double>& apart) const;
};

/// Verlet lists of two levels, as PairLists of the plane: near pairs for as long as every sphere
/// stays within its allowance, chosen from far ones, which a cell grid collects when the skin is
/// used up. Pairs are in ascending (i, j), whatever the skin; i moves, j moves or is of a wall.
class SpaceLists {
 public:
  /// @param moving   spheres 0 … moving−1 move; those after belong to walls and never meet
  /// @param range    how far apart bodies may be in contact [m]
  SpaceLists(std::size_t moving, const SpaceBox& box, Skin skin, double range);

  /// Chooses the near pairs anew, and collects the far ones where the skin does not last.
  /// @param position  w: radius  @param travel  of each in a step [m]
  /// @throws NotFinite
  void update(std::span<const Quad> position, std::span<const double> travel,
              std::size_t stepsSince);

  /// A pair that touches, on its way from one choice to the next.
  struct Kept {
    std::int32_t i, j;
    SpaceMemory<double> memory;
    SpaceResult result;
  };
  std::vector<Kept> touching() const;
  /// Lists built anew, of pairs in ascending (i, j) that touch.
  /// @throws NotFinite
  void restore(std::vector<Kept> touching, std::span<const Quad> position,
               std::span<const double> travel);

  /// How far each sphere may be from where it was at the last update [m].
  std::span<const double> allowances() const { return allowance_; }
  SpacePairs near();
  std::size_t rebuilds() const { return skin_.rebuilds(); }
  void pairsTook(double seconds) { skin_.pairsTook(seconds, i_.size()); }

 private:
  struct Far {
    std::int32_t i, j;
    Quad shift;
  };
  struct Cells {
    std::array<std::int32_t, 3> count{1, 1, 1};
    Vec3<double> low, size;
    std::vector<std::int32_t> begin, sorted;
  };

  void requireFinite(std::span<const Quad> position) const;
  void rebuild(std::span<const Quad> position);
  double skinUsed(std::span<const Quad> position) const;
  void collect(std::span<const Quad> position);
  void sortIntoCells(std::span<const Quad> position, double reach);
  void choose(std::span<const Quad> position);

  std::size_t moving_;
  SpaceBox box_;
  Skin skin_;
  double range_;
  Cells cells_;
  std::vector<std::array<std::int32_t, 3>> cellOf_;
  std::vector<Far> far_;
  std::vector<std::int32_t> i_, j_;  ///< of the near ones, as what follows
  Array<Quad> shift_;
  std::vector<SpaceMemory<double>> kept_;
  std::vector<SpaceResult> results_;
  std::vector<std::uint8_t> touches_;
  std::vector<Kept> carried_;
  std::vector<double> allowance_;
  std::vector<Quad> built_;  ///< places at the last rebuild
};

}  // namespace grain
