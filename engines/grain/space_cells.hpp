#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engines/grain/space_views.hpp"

namespace grain {

/// A cell that is repeated along its periodic directions.
struct SpaceBox {
  Vec3<double> low, length;  ///< [m]
  std::array<bool, 3> periodic{};
};

/// Spheres sorted into cells, row after row along x, by where they are in a periodic box; within a
/// cell in ascending order.
class SpaceCells {
 public:
  explicit SpaceCells(const SpaceBox& box);

  /// @param position  w: radius  @param size  of a cell, the least [m]
  /// @pre positions are finite
  void sort(std::span<const Quad> position, double size);

  /// The spheres, cell after cell.
  std::span<const std::int32_t> sorted() const { return sorted_; }
  SpaceCellsView view() const { return {place_.data(), sorted_.data(), length_, half_}; }
  /// How many boxes away from the box sphere i is along each direction.
  const Quad& winding(std::size_t i) const { return winding_[i]; }
  /// Sphere i in the box, where it was when sorted; and one that moved since.
  Quad inBox(std::size_t i, const Quad& position) const;
  /// Of a box, or of so many in each direction [m].
  Quad boxes(const Quad& count) const;

  /// Calls visit(begin, end) for ranges of the sorted spheres that are in the cells around sphere
  /// i, each once, unless all of a range have lower numbers.
  template <class Visit>
  void around(std::size_t i, Visit&& visit) const;

 private:
  using Cell = std::array<std::int32_t, 3>;
  /// Ranges of cells along a direction: of the neighbours of one, each once.
  struct Ranges {
    std::array<std::pair<std::int32_t, std::int32_t>, 2> of;
    std::size_t count;
  };
  Ranges rangesAround(std::size_t direction, std::int32_t at) const;
  void layOut(std::span<const Quad> position, double size);
  Cell cellOf(const Quad& inBox) const;
  std::size_t number(const Cell& cell) const {
    return static_cast<std::size_t>((cell[2] * count_[1] + cell[1]) * count_[0] + cell[0]);
  }

  SpaceBox box_;
  Quad length_, half_;
  Cell count_{1, 1, 1};
  Vec3<double> low_, size_;
  std::vector<Cell> cellOf_;
  Array<Quad> winding_, place_;  ///< place_: of the sorted, and spares
  std::vector<std::int32_t> begin_, sorted_;
};

template <class Visit>
void SpaceCells::around(std::size_t i, Visit&& visit) const {
  std::array<Ranges, 3> ranges;
  for (std::size_t k = 0; k < 3; ++k) ranges[k] = rangesAround(k, cellOf_[i][k]);
  const auto each = [](const Ranges& all, auto&& act) {
    for (std::size_t r = 0; r < all.count; ++r)
      for (std::int32_t at = all.of[r].first; at <= all.of[r].second; ++at) act(at);
  };
  each(ranges[2], [&](std::int32_t z) {
    each(ranges[1], [&](std::int32_t y) {
      for (std::size_t r = 0; r < ranges[0].count; ++r) {
        const std::size_t first = number({ranges[0].of[r].first, y, z}),
                          last = number({ranges[0].of[r].second, y, z});
        // A cell's last has its highest number. Spheres are numbered by place from time to time, so
        // that half of the ranges are left out.
        bool some = false;
        for (std::size_t cell = first; cell <= last; ++cell)
          some |= begin_[cell] < begin_[cell + 1] &&
                  sorted_[static_cast<std::size_t>(begin_[cell + 1]) - 1] >
                      static_cast<std::int32_t>(i);
        if (some)
          visit(static_cast<std::size_t>(begin_[first]),
                static_cast<std::size_t>(begin_[last + 1]));
      }
    });
  });
}

}  // namespace grain
