#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "crossgrain_walls.hpp"
#include "faults.hpp"
#include "resistance.hpp"

namespace crossgrain::planted {

using crossgrain_worker::dot;
using crossgrain_worker::Vector;

/// Two that are near each other, i < j, i a disk and j a disk or wall disk.
struct Pair {
  std::size_t i, j;
  Memory kept = {};

  bool before(const Pair& other) const { return i < other.i || (i == other.i && j < other.j); }
};

/// A Verlet list: pairs nearer than `skin` to touching, in order of their ids, made anew when
/// anything has gone half the skin.
class Neighbours {
 public:
  std::vector<Pair> pairs;

  /// @param disks  how many of the places move by themselves; the others are wall disks
  /// @param late   whether faults act that begin late
  void update(const std::vector<Vector>& position, const std::vector<double>& radius,
              std::size_t disks, const Faults& faults, bool late) {
    const bool looks = faults.listLookEvery == 0.0 || everyNth(faults.listLookEvery, updates_++);
    const std::size_t watched = faults.listOfDisks != 0.0 ? disks : position.size();
    if (!looks || valid(position, watched, faults)) return;
    std::vector<Pair> before;
    before.swap(pairs);
    positionsAtListBuild_ = position;
    find(position, radius, disks, faults);
    ++lists_;
    const bool lost =
        everyNth(faults.historyLostEvery, lists_) || (late && faults.historyLostLate != 0.0);
    auto old = before.begin();
    for (Pair& pair : pairs) {
      while (old != before.end() && old->before(pair)) ++old;
      if (old != before.end() && old->i == pair.i && old->j == pair.j && !lost)
        pair.kept = old->kept;
      if (faults.rollTurnedByList != 0.0) pair.kept.angle = -pair.kept.angle;
    }
  }

  unsigned long long made() const { return lists_; }
  /// As if the list had been made here.
  void madeAt(const std::vector<Vector>& position) { positionsAtListBuild_ = position; }

  /// Everything that it holds, one after the other, given to `each`.
  void parts(const auto& each) {
    each(pairs);
    each(positionsAtListBuild_);
    each(skin_);
    each(lists_);
    each(updates_);
  }

 private:
  bool valid(const std::vector<Vector>& position, std::size_t watched, const Faults& faults) const {
    if (positionsAtListBuild_.size() != position.size()) return false;
    const double most = 0.5 * skin_ * faults.listReach;
    for (std::size_t k = 0; k < watched; ++k) {
      const Vector gone = position[k] - positionsAtListBuild_[k];
      if (!(dot(gone, gone) <= most * most)) return false;
    }
    return true;
  }

  /// Every disk with all that follow it: the list is made anew every fifty steps or so.
  void find(const std::vector<Vector>& position, const std::vector<double>& radius,
            std::size_t disks, const Faults& faults) {
    if (position.empty()) return;
    for (const Vector& x : position)
      if (!std::isfinite(x.x) || !std::isfinite(x.y))
        throw std::runtime_error("the position of a disk is not a number");
    skin_ = 0.3 * *std::min_element(radius.begin(), radius.end());
    double mean = 0.0;
    for (const double each : radius) mean += 2.0 * each / static_cast<double>(radius.size());
    const double cell =
        faults.meanCells > 0.0 ? faults.meanCells * mean : std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < disks; ++i)
      for (std::size_t j = i + 1; j < position.size(); ++j) {
        const Vector apart = position[i] - position[j];
        const double reach = radius[i] + radius[j] + skin_;
        const double near = std::min(reach, cell);
        if (dot(apart, apart) < near * near) pairs.push_back({i, j});
      }
  }

  std::vector<Vector> positionsAtListBuild_;  ///< where everything was when the list was made
  double skin_ = 0.0;
  unsigned long long lists_ = 0, updates_ = 0;
};

}  // namespace crossgrain::planted
