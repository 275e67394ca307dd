#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "crossgrain_walls.hpp"
#include "faults.hpp"

namespace crossgrain::planted {

using crossgrain_worker::dot;
using crossgrain_worker::Vector;

/// Two that are near each other, i < j, i a disk and j a disk or wall disk.
struct Pair {
  std::size_t i, j;
  double spring = 0.0;  ///< ξ [m]

  bool before(const Pair& other) const { return i < other.i || (i == other.i && j < other.j); }
};

/// A Verlet list: pairs nearer than `skin` to touching, in order of their ids, made anew when
/// anything has gone half the skin.
class Neighbours {
 public:
  std::vector<Pair> pairs;

  /// @param disks  how many of the places move by themselves; the others are wall disks
  void update(const std::vector<Vector>& position, const std::vector<double>& radius,
              std::size_t disks, const Faults& faults) {
    if (valid(position, faults)) return;
    std::vector<Pair> before;
    before.swap(pairs);
    positionsAtListBuild_ = position;
    find(position, radius, disks);
    ++lists_;
    const bool lost = everyNth(faults.historyLostEvery, lists_);
    auto old = before.begin();
    for (Pair& pair : pairs) {
      while (old != before.end() && old->before(pair)) ++old;
      if (old != before.end() && old->i == pair.i && old->j == pair.j && !lost)
        pair.spring = old->spring;
    }
  }

 private:
  bool valid(const std::vector<Vector>& position, const Faults& faults) const {
    if (positionsAtListBuild_.size() != position.size()) return false;
    const double most = 0.5 * skin_ * faults.listReach;
    for (std::size_t k = 0; k < position.size(); ++k) {
      const Vector gone = position[k] - positionsAtListBuild_[k];
      if (!(dot(gone, gone) <= most * most)) return false;
    }
    return true;
  }

  /// Cells of the largest reach and a skin; fewer and larger ones where a scene is thin and wide.
  void find(const std::vector<Vector>& position, const std::vector<double>& radius,
            std::size_t disks) {
    if (position.empty()) return;
    Vector low = position[0], high = position[0];
    for (const Vector& x : position) {
      if (!std::isfinite(x.x) || !std::isfinite(x.y))
        throw std::runtime_error("the position of a disk is not a number");
      low = {std::min(low.x, x.x), std::min(low.y, x.y)};
      high = {std::max(high.x, x.x), std::max(high.y, x.y)};
    }
    const double largest = *std::max_element(radius.begin(), radius.end());
    skin_ = 0.3 * *std::min_element(radius.begin(), radius.end());
    const double most = std::sqrt(4.0 * static_cast<double>(position.size())) + 2.0;
    const double cell =
        std::max({2.0 * largest + skin_, (high.x - low.x) / most, (high.y - low.y) / most});
    const auto across = [&](double from, double to) {
      return static_cast<std::size_t>((to - from) / cell) + 1;
    };
    const std::size_t columns = across(low.x, high.x), rows = across(low.y, high.y);
    std::vector<std::vector<std::size_t>> members(columns * rows);
    std::vector<std::size_t> column, row;
    for (std::size_t k = 0; k < position.size(); ++k) {
      column.push_back(across(low.x, position[k].x) - 1);
      row.push_back(across(low.y, position[k].y) - 1);
      members[row[k] * columns + column[k]].push_back(k);
    }
    for (std::size_t i = 0; i < disks; ++i) {
      const std::size_t first = pairs.size();
      for (std::size_t r = row[i] - (row[i] > 0); r <= std::min(row[i] + 1, rows - 1); ++r)
        for (std::size_t c = column[i] - (column[i] > 0); c <= std::min(column[i] + 1, columns - 1);
             ++c)
          for (const std::size_t j : members[r * columns + c]) {
            if (j <= i) continue;
            const Vector apart = position[i] - position[j];
            const double reach = radius[i] + radius[j] + skin_;
            if (dot(apart, apart) < reach * reach) pairs.push_back({i, j});
          }
      std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(first), pairs.end(),
                [](const Pair& one, const Pair& other) { return one.before(other); });
    }
  }

  std::vector<Vector> positionsAtListBuild_;  ///< where everything was when the list was made
  double skin_ = 0.0;
  unsigned long long lists_ = 0;
};

}  // namespace crossgrain::planted
