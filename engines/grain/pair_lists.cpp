#include "engines/grain/pair_lists.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <tuple>

namespace grain {
namespace {

bool earlier(const KeptSpring& a, const KeptSpring& b) {
  return std::tie(a.i, a.j) < std::tie(b.i, b.j);
}

}  // namespace

void requireFinite(const Places& now) {
  for (std::size_t i = 0; i < now.position.size(); ++i)
    if (!std::isfinite(now.position[i].x) || !std::isfinite(now.position[i].y)) throw NotFinite{i};
}

template <class Real>
PairLists<Real>::PairLists(std::size_t moving, std::size_t parts, PairSprings springs, Skin skin,
                           double maxOverlap, double range)
    : moving_(moving),
      springs_(springs),
      maxOverlap_(maxOverlap),
      range_(range),
      skin_(skin),
      lists_(parts),
      row_(parts) {}

template <class Real>
PairCounts PairLists<Real>::counts() const {
  PairCounts counts;
  for (const auto& part : lists_)
    for (const PairList<Real>& list : part) {
      counts.near += list.count;
      counts.far += list.farI.size();
    }
  counts.touching = std::accumulate(touching_.begin(), touching_.end(), std::size_t{0});
  return counts;
}

template <class Real>
void PairLists<Real>::update(const Places& now, std::span<const double> travel,
                             std::size_t stepsSince, ThreadTeam& team) {
  skin_.beginUpdate(stepsSince);
  skin_.allow(travel, allowance_);
  const double used = skinUsed(now);
  for (auto& part : lists_)
    for (PairList<Real>& list : part)
      if (springs_.any()) list.storeSprings(springs_);
  if (!(used <= 0.5 * skin_.skin())) {
    skin_.tune(counts(), used);
    carrySprings();
    collect(now, team);
  }
  refresh(now, team);
}

template <class Real>
void PairLists<Real>::rebuild(const Places& now, std::span<const double> travel, ThreadTeam& team) {
  restoreSprings(stretched(), now, travel, team);
}

template <class Real>
void PairLists<Real>::renumber(std::span<const std::int32_t> newNumber, const Places& now,
                               std::span<const double> travel, ThreadTeam& team) {
  std::vector<KeptSpring> kept = stretched();
  for (KeptSpring& spring : kept) {
    spring.i = newNumber[static_cast<std::size_t>(spring.i)];
    if (spring.j < static_cast<std::int32_t>(moving_))
      spring.j = newNumber[static_cast<std::size_t>(spring.j)];
    if (spring.j < spring.i) swapDisks(spring);
  }
  restoreSprings(std::move(kept), now, travel, team);
}

template <class Real>
std::vector<KeptSpring> PairLists<Real>::stretched() const {
  std::vector<KeptSpring> found;
  if (!springs_.any()) return found;
  for (const auto& part : lists_)
    for (const PairList<Real>& list : part)
      for (std::size_t k = 0; k < list.count; ++k) {
        const KeptSpring pair{list.i[k],
                              list.j[k],
                              springs_.sliding ? list.spring[k] : Real(0),
                              springs_.rolling ? list.angle[k] : Real(0),
                              springs_.memory ? list.memory[k] : Real(0),
                              springs_.rest ? list.rest[k] : Real(0)};
        if (pair.spring != 0.0 || pair.angle != 0.0 || pair.memory != 0.0) found.push_back(pair);
      }
  return found;
}

template <class Real>
void PairLists<Real>::restoreSprings(std::vector<KeptSpring> springs, const Places& now,
                                     std::span<const double> travel, ThreadTeam& team) {
  std::ranges::sort(springs, earlier);
  for (auto& part : lists_)
    for (PairList<Real>& list : part) list.kept.clear();
  for (const KeptSpring& spring : springs) {
    const std::size_t part = partOf(spring.i);
    const Sort sort = spring.j >= static_cast<std::int32_t>(moving_) ? Sort::walls
                      : partOf(spring.j) == part                     ? Sort::inside
                                                                     : Sort::across;
    list(part, sort).kept.push_back(spring);
  }
  skin_.beginUpdate(0);
  skin_.allow(travel, allowance_);
  collect(now, team);
  refresh(now, team);
}

template <class Real>
std::size_t PairLists<Real>::partOf(std::int32_t disk) const {
  std::size_t part = parts() - 1;
  while (static_cast<std::size_t>(disk) < partBegin(part)) --part;
  return part;
}

/// The skin is used up by how far a disk has come since the rebuild and how far it may go on: two
/// disks may approach each other, so either may take half of it. Not a number for a disk that is
/// nowhere.
template <class Real>
double PairLists<Real>::skinUsed(const Places& now) const {
  if (built_.size() != now.position.size()) return std::numeric_limits<double>::infinity();
  double farthest = 0.0;
  double notFinite = 0.0;  // max() would drop a NaN, this sum keeps it
  for (std::size_t i = 0; i < built_.size(); ++i) {
    const Vec<double> moved = now.position[i] - built_[i];
    const double used = std::sqrt(moved.x * moved.x + moved.y * moved.y) + allowance_[i];
    farthest = std::max(farthest, used);
    notFinite += used - used;
  }
  return farthest + notFinite;
}

template <class Real>
void PairLists<Real>::carrySprings() {
  if (!springs_.any()) return;
  for (auto& part : lists_)
    for (PairList<Real>& list : part) list.carry(springs_);
}

template <class Real>
void PairLists<Real>::collect(const Places& now, ThreadTeam& team) {
  requireFinite(now);
  skin_.beginRebuild();
  const double largest = now.radius.empty() ? 1.0 : *std::ranges::max_element(now.radius);
  grid_.sort(now.position, 2.0 * largest + range_ + skin_.skin());
  team.run([&](std::size_t part) { collectPart(part, now); });
  built_.assign(now.position.begin(), now.position.end());
  skin_.endRebuild();
}

template <class Real>
void PairLists<Real>::collectPart(std::size_t part, const Places& now) {
  auto& lists = lists_[part];
  for (PairList<Real>& list : lists) list.clear();
  const auto moving = static_cast<std::int32_t>(moving_);
  const auto end = static_cast<std::int32_t>(partBegin(part + 1));
  std::vector<std::int32_t>& row = row_[part];
  for (std::size_t i = partBegin(part); i < partBegin(part + 1); ++i) {
    row.clear();
    grid_.around(i, [&](std::int32_t j) {
      if (j <= static_cast<std::int32_t>(i)) return;
      const Vec<double> d = now.position[i] - now.position[static_cast<std::size_t>(j)];
      const double reach =
          now.radius[i] + now.radius[static_cast<std::size_t>(j)] + range_ + skin_.skin();
      if (d.x * d.x + d.y * d.y < reach * reach) row.push_back(j);
    });
    std::ranges::sort(row);
    for (const std::int32_t j : row)
      list(part, j >= moving ? Sort::walls
                 : j < end   ? Sort::inside
                             : Sort::across)
          .append(static_cast<std::int32_t>(i), j);
  }
  if (springs_.any())
    for (PairList<Real>& list : lists) list.takeKept(springs_);
}

template <class Real>
void PairLists<Real>::refresh(const Places& now, ThreadTeam& team) {
  touching_.assign(parts(), 0);
  team.run([&](std::size_t part) {
    for (PairList<Real>& list : lists_[part])
      touching_[part] += list.chooseNear(now, allowance_, maxOverlap_, springs_, range_);
  });
  skin_.endRefresh(counts());
}

template class PairLists<double>;
template class PairLists<float>;

}  // namespace grain
