#include "engines/grain/cell_grid.hpp"

#include <algorithm>

namespace grain {

void CellGrid::sort(std::span<const Vec<double>> points, double cellSize) {
  columns_ = lines_ = 0;
  begin_.assign(1, 0);
  cellOf_.resize(points.size());
  sorted_.resize(points.size());
  if (points.empty()) return;
  Vec<double> low = points[0], high = points[0];
  for (const Vec<double>& point : points) {
    low = {std::min(low.x, point.x), std::min(low.y, point.y)};
    high = {std::max(high.x, point.x), std::max(high.y, point.y)};
  }
  const Vec<double> extent = high - low;
  // A disk that flew far away must not blow the grid up: larger cells are slower, never wrong.
  const double mostCells = 16.0 + 4.0 * static_cast<double>(points.size());
  while ((extent.x / cellSize + 1.0) * (extent.y / cellSize + 1.0) > mostCells) cellSize *= 1.5;
  columns_ = static_cast<std::int32_t>(extent.x / cellSize) + 1;
  lines_ = static_cast<std::int32_t>(extent.y / cellSize) + 1;

  begin_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(lines_) + 1, 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec<double> from = points[i] - low;
    const auto column = static_cast<std::int32_t>(from.x / cellSize);
    const auto line = static_cast<std::int32_t>(from.y / cellSize);
    cellOf_[i] = line * columns_ + column;
    ++begin_[static_cast<std::size_t>(cellOf_[i]) + 1];
  }
  for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
  for (std::size_t i = points.size(); i-- > 0;)  // from behind: ascending within a cell
    sorted_[static_cast<std::size_t>(--begin_[static_cast<std::size_t>(cellOf_[i]) + 1])] =
        static_cast<std::int32_t>(i);
  // Each begin_[c + 1] now holds the beginning of cell c: shift back by one.
  std::rotate(begin_.begin(), begin_.begin() + 1, begin_.end());
  begin_.back() = static_cast<std::int32_t>(points.size());
}

}  // namespace grain
