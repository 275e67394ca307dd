#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engines/grain/real.hpp"

namespace grain {

/// Points sorted into square cells, row by row; within a cell in ascending order.
class CellGrid {
 public:
  /// @param cellSize  [m]; larger where points lie so far apart that most cells would be empty
  /// @pre points are finite
  void sort(std::span<const Vec<double>> points, double cellSize);

  /// The points, cell after cell.
  std::span<const std::int32_t> sorted() const { return sorted_; }

  /// Calls visit(j) for the points j in the nine cells around point i, itself included.
  template <class Visit>
  void around(std::size_t i, Visit&& visit) const {
    const std::int32_t column = cellOf_[i] % columns_;
    const std::int32_t line = cellOf_[i] / columns_;
    const std::int32_t left = column > 0 ? column - 1 : 0;
    const std::int32_t right = column + 1 < columns_ ? column + 1 : column;
    for (std::int32_t l = line > 0 ? line - 1 : 0; l <= line + 1 && l < lines_; ++l) {
      const auto first = static_cast<std::size_t>(l * columns_ + left);
      const auto last = static_cast<std::size_t>(l * columns_ + right);
      for (std::int32_t at = begin_[first]; at < begin_[last + 1]; ++at)
        visit(sorted_[static_cast<std::size_t>(at)]);
    }
  }

 private:
  std::int32_t columns_ = 0, lines_ = 0;
  std::vector<std::int32_t> begin_, cellOf_, sorted_;
};

}  // namespace grain
