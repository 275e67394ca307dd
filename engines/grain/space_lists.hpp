#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engines/grain/skin.hpp"
#include "engines/grain/space_cells.hpp"

namespace grain {

/// Verlet lists of two levels, as PairLists of the plane: near pairs for as long as every sphere
/// stays within its allowance, chosen from far ones, which a cell grid collects when the skin is
/// used up. Pairs are in ascending (i, j), whatever the skin; i moves, j moves or is of a wall.
class SpaceLists {
 public:
  /// @param moving   spheres 0 … moving−1 move; those after belong to walls and never meet
  /// @param range    how far apart bodies may be in contact [m]
  SpaceLists(std::size_t moving, const SpaceBox& box, Skin skin, double range,
             const SpaceKernels& kernels);

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

  /// The same for spheres that have other numbers now. @param newNumber  old → new
  void renumber(std::span<const std::int32_t> newNumber, std::span<const Quad> position,
                std::span<const double> travel);

  /// How far each sphere may be from where it was at the last update [m].
  std::span<const double> allowances() const { return allowance_; }
  SpacePairs near();
  std::size_t rebuilds() const { return skin_.rebuilds(); }
  /// A pair that touches costs as much as some thirty that are only looked at.
  void pairsTook(double seconds, std::size_t touching) {
    skin_.pairsTook(seconds, i_.size() + 30 * touching);
  }

 private:
  void requireFinite(std::span<const Quad> position) const;
  void rebuild(std::span<const Quad> position);
  double skinUsed(std::span<const Quad> position) const;
  void collect(std::span<const Quad> position);
  void choose(std::span<const Quad> position);
  void sortChosen(std::size_t count);
  PairCounts counts() const { return {carried_.size(), i_.size(), far_.size()}; }

  std::size_t moving_;
  Skin skin_;
  double range_;
  SpaceKernels kernels_;
  SpaceCells cells_;
  // The far pairs, and what choosing from them needs. The images are those of the 27 numbers.
  std::vector<SpaceNeighbour> far_, row_;
  std::vector<std::int32_t> farBegin_;
  Array<Quad> place_, image_;
  std::vector<SpaceChoice> chosen_;
  std::vector<std::int32_t> i_, j_;  ///< of the near ones, as what follows
  Array<Quad> shift_;
  std::vector<SpaceMemory<double>> kept_;  ///< with room to spare, as results
  std::vector<SpaceResult> results_;
  std::vector<std::uint8_t> touches_;
  std::vector<Kept> carried_;
  std::vector<double> allowance_;
  Array<Quad> built_;  ///< places at the last rebuild
};

}  // namespace grain
