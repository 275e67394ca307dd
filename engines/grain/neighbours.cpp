#include "engines/grain/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace grain {

bool Neighbours::outdated(std::span<const double> x, std::span<const double> y) const {
  if (builtX_.size() != x.size()) return true;
  // Two disks may approach each other, so either may use up half of the skin.
  const double limit = 0.25 * skin_ * skin_;
  double farthest = 0.0;
  double notFinite = 0.0;  // max() would drop a NaN, this sum keeps it
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double dx = x[i] - builtX_[i];
    const double dy = y[i] - builtY_[i];
    const double moved = dx * dx + dy * dy;
    farthest = std::max(farthest, moved);
    notFinite += moved - moved;
  }
  return farthest > limit || notFinite != 0.0;
}

void Neighbours::rebuild(std::span<const double> x, std::span<const double> y,
                         std::span<const double> radius) {
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!std::isfinite(x[i]) || !std::isfinite(y[i]))
      throw std::runtime_error("the position of disk " + std::to_string(i) + " is not finite");

  oldRow_.swap(row_);
  oldPartner_.swap(partner_);
  oldSpring_.swap(spring_);
  row_.assign(1, 0);
  partner_.clear();

  const double largest = radius.empty() ? 1.0 : *std::ranges::max_element(radius);
  sortIntoCells(x, y, 2.0 * largest + skin_);
  for (std::size_t i = 0; i < moving_; ++i) {
    collectRow(i, x, y, radius);
    row_.push_back(partner_.size());
  }
  keepSprings();
  builtX_.assign(x.begin(), x.end());
  builtY_.assign(y.begin(), y.end());
  ++rebuilds_;
}

void Neighbours::sortIntoCells(std::span<const double> x, std::span<const double> y,
                               double cellSize) {
  const auto [left, right] = std::ranges::minmax(x);
  const auto [low, high] = std::ranges::minmax(y);
  originX_ = left;
  originY_ = low;
  cellSize_ = cellSize;
  // A disk that flew far away must not blow the grid up: larger cells are slower, never wrong.
  const double mostCells = 16.0 + 4.0 * static_cast<double>(x.size());
  while (((right - left) / cellSize_ + 1.0) * ((high - low) / cellSize_ + 1.0) > mostCells)
    cellSize_ *= 1.5;
  columns_ = static_cast<std::int64_t>((right - left) / cellSize_) + 1;
  lines_ = static_cast<std::int64_t>((high - low) / cellSize_) + 1;

  cellStart_.assign(static_cast<std::size_t>(columns_ * lines_) + 1, 0);
  cellOf_.resize(x.size());
  sorted_.resize(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto column = static_cast<std::int64_t>((x[i] - originX_) / cellSize_);
    const auto line = static_cast<std::int64_t>((y[i] - originY_) / cellSize_);
    cellOf_[i] = static_cast<std::int32_t>(line * columns_ + column);
    ++cellStart_[static_cast<std::size_t>(cellOf_[i]) + 1];
  }
  for (std::size_t c = 1; c < cellStart_.size(); ++c) cellStart_[c] += cellStart_[c - 1];
  for (std::size_t i = x.size(); i-- > 0;)  // from behind: ascending ids within a cell
    sorted_[static_cast<std::size_t>(--cellStart_[static_cast<std::size_t>(cellOf_[i]) + 1])] =
        static_cast<std::int32_t>(i);
  // Each cellStart_[c + 1] now holds the beginning of cell c: shift back by one.
  std::rotate(cellStart_.begin(), cellStart_.begin() + 1, cellStart_.end());
  cellStart_.back() = static_cast<std::int32_t>(x.size());
}

void Neighbours::collectRow(std::size_t i, std::span<const double> x, std::span<const double> y,
                            std::span<const double> radius) {
  const std::size_t begin = partner_.size();
  const std::int64_t column = cellOf_[i] % columns_;
  const std::int64_t line = cellOf_[i] / columns_;
  for (std::int64_t l = std::max<std::int64_t>(line - 1, 0); l <= std::min(line + 1, lines_ - 1);
       ++l) {
    const auto first =
        static_cast<std::size_t>(l * columns_ + std::max<std::int64_t>(column - 1, 0));
    const auto last = static_cast<std::size_t>(l * columns_ + std::min(column + 1, columns_ - 1));
    for (std::int32_t at = cellStart_[first]; at < cellStart_[last + 1]; ++at) {
      const std::int32_t j = sorted_[static_cast<std::size_t>(at)];
      if (j <= static_cast<std::int32_t>(i)) continue;
      const double dx = x[i] - x[static_cast<std::size_t>(j)];
      const double dy = y[i] - y[static_cast<std::size_t>(j)];
      const double reach = radius[i] + radius[static_cast<std::size_t>(j)] + skin_;
      if (dx * dx + dy * dy < reach * reach) partner_.push_back(j);
    }
  }
  std::sort(partner_.begin() + static_cast<std::ptrdiff_t>(begin), partner_.end());
}

void Neighbours::keepSprings() {
  spring_.assign(partner_.size(), 0.0);
  if (oldRow_.size() != row_.size()) return;
  for (std::size_t i = 0; i + 1 < row_.size(); ++i) {
    std::size_t old = oldRow_[i];
    for (std::size_t pair = row_[i]; pair < row_[i + 1]; ++pair) {
      while (old < oldRow_[i + 1] && oldPartner_[old] < partner_[pair]) ++old;
      if (old == oldRow_[i + 1]) break;
      if (oldPartner_[old] == partner_[pair]) spring_[pair] = oldSpring_[old];
    }
  }
}

}  // namespace grain
