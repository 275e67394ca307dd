#include "engines/grain/space_lists.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engines/grain/pair_lists.hpp"

namespace grain {
namespace {

using Vector = Vec3<double>;

constexpr std::size_t imageCount = 27;

/// By how many boxes an image is shifted along each direction. @see SpaceNeighbour
Quad boxesOf(std::int32_t image) {
  return {image % 3 - 1.0, image / 3 % 3 - 1.0, image / 9 - 1.0, 0.0};
}

/// The same pair, seen from j.
SpaceLists::Kept swapped(SpaceLists::Kept pair) {
  std::swap(pair.i, pair.j);
  for (Vector* of : {&pair.memory.normal, &pair.memory.spring, &pair.memory.angle,
                     &pair.result.tangential, &pair.result.rolling})
    *of = -1.0 * *of;
  return pair;
}

template <class A, class B>
bool earlier(const A& a, const B& b) {
  return a.i < b.i || (a.i == b.i && a.j < b.j);
}

}  // namespace

SpaceLists::SpaceLists(std::size_t moving, std::size_t parts, const SpaceBox& box, Skin skin,
                       double range, const SpaceRecords& records, const SpaceKernels& kernels)
    : moving_(moving),
      skin_(skin),
      range_(range),
      neighbours_(kernels.neighbours),
      choose_(kernels.choose),
      cells_(box),
      parts_(parts, Part(records)) {
  for (std::size_t image = 0; image < imageCount; ++image)
    image_.push_back(cells_.boxes(boxesOf(static_cast<std::int32_t>(image))));
}

void SpaceLists::update(std::span<const Quad> position, std::span<const double> travel,
                        std::size_t stepsSince, ThreadTeam& team) {
  skin_.beginUpdate(stepsSince);
  requireFinite(position);
  skin_.allow(travel, allowance_);
  team.run([&](std::size_t part) {
    for (NearPairs& pairs : parts_[part].near) pairs.rememberTouching();
    parts_[part].skinUsed = skinUsed(part, position);
  });
  double used = 0.0;
  for (const Part& part : parts_) used = std::max(used, part.skinUsed);
  if (!(used <= 0.5 * skin_.skin())) {
    skin_.tune(counts(), used);
    rebuild(position, team);
  }
  choose(position, team);
  skin_.endRefresh(counts());
}

void SpaceLists::restore(std::vector<Kept> touching, std::span<const Quad> position,
                         std::span<const double> travel, ThreadTeam& team) {
  skin_.beginUpdate(0);
  requireFinite(position);
  skin_.allow(travel, allowance_);
  std::ranges::sort(touching, [](const Kept& a, const Kept& b) { return earlier(a, b); });
  for (std::size_t part = 0, begin = 0; part < parts(); ++part) {
    const auto ofPart = [&](std::size_t k) {
      return isUpTo(part, static_cast<std::size_t>(touching[k].i));
    };
    std::size_t end = begin;
    while (end < touching.size() && ofPart(end)) ++end;
    std::array<std::vector<Kept>, 2> lists;
    for (; begin < end; ++begin)
      lists[isUpTo(part, static_cast<std::size_t>(touching[begin].j)) ? 0 : 1].push_back(
          touching[begin]);
    for (std::size_t list = 0; list < 2; ++list) parts_[part].near[list].remember(lists[list]);
  }
  rebuild(position, team);
  choose(position, team);
}

void SpaceLists::renumber(std::span<const std::int32_t> newNumber, std::span<const Quad> position,
                          std::span<const double> travel, ThreadTeam& team) {
  std::vector<Kept> kept = touching();
  for (Kept& pair : kept) {
    pair.i = newNumber[static_cast<std::size_t>(pair.i)];
    if (pair.j < static_cast<std::int32_t>(moving_))
      pair.j = newNumber[static_cast<std::size_t>(pair.j)];
    if (pair.j < pair.i) pair = swapped(pair);
  }
  restore(std::move(kept), position, travel, team);
}

void SpaceLists::rebuild(std::span<const Quad> position, ThreadTeam& team) {
  skin_.beginRebuild();
  double largest = 0.0;
  for (const Quad& place : position) largest = std::max(largest, place.w);
  cells_.sort(position, 2.0 * largest + range_ + skin_.skin());
  team.run([&](std::size_t part) { collect(part, position); });
  built_.assign(position.begin(), position.end());
  skin_.endRebuild();
}

std::vector<SpaceLists::Kept> SpaceLists::touching() {
  std::vector<Kept> found;
  forNear([&](const SpacePairs& pairs) {
    for (std::size_t p = 0; p < pairs.count; ++p)
      if (pairs.touches[p] != 0)
        found.push_back(
            {pairs.i[p], pairs.j[p], pairs.contacts.memory(p), pairs.contacts.result(p)});
  });
  std::ranges::sort(found, [](const Kept& a, const Kept& b) { return earlier(a, b); });
  return found;
}

PairCounts SpaceLists::counts() const {
  PairCounts counts;
  for (const Part& part : parts_) {
    counts.far += part.far.size();
    for (const NearPairs& pairs : part.near) {
      counts.touching += pairs.beforeI.size();
      counts.near += pairs.i.size();
    }
  }
  return counts;
}

void SpaceLists::requireFinite(std::span<const Quad> position) const {
  for (std::size_t i = 0; i < position.size(); ++i)
    if (!std::isfinite(position[i].x + position[i].y + position[i].z)) throw NotFinite{i};
}

double SpaceLists::skinUsed(std::size_t part, std::span<const Quad> position) const {
  if (built_.size() != position.size()) return std::numeric_limits<double>::infinity();
  double farthest = 0.0;
  const auto [begin, end] = members(part, position.size());
  for (std::size_t i = begin; i < end; ++i)
    farthest =
        std::max(farthest, length(vectorOf(position[i]) - vectorOf(built_[i])) + allowance_[i]);
  return farthest;
}

/// The far pairs of a part.
void SpaceLists::collect(std::size_t part, std::span<const Quad> position) {
  auto& [far, row, farBegin, chosen, near, used] = parts_[part];
  far.clear();
  farBegin.assign(1, 0);
  row.resize(position.size() + 1);
  const double reach = range_ + skin_.skin();
  const SpaceCellsView view = cells_.view();
  for (std::size_t i = partBegin(part); i < partBegin(part + 1); ++i) {
    const Quad mine = cells_.inBox(i, position[i]);
    std::size_t found = 0;
    cells_.around(i, [&](std::size_t begin, std::size_t end) {
      found += neighbours_(view, mine, static_cast<std::int32_t>(i), begin, end, reach,
                           row.data() + found);
    });
    far.insert(far.end(), row.begin(), row.begin() + static_cast<std::ptrdiff_t>(found));
    farBegin.push_back(static_cast<std::int32_t>(far.size()));
  }
}

void SpaceLists::choose(std::span<const Quad> position, ThreadTeam& team) {
  place_.resize(position.size());
  team.run([&](std::size_t part) {
    const auto [begin, end] = members(part, position.size());
    for (std::size_t i = begin; i < end; ++i) {
      place_[i] = cells_.inBox(i, position[i]);
      place_[i].w += allowance_[i] + 0.5 * range_;
    }
  });
  team.run([&](std::size_t part) { chooseNear(part, position); });
}

/// The near pairs of a part.
void SpaceLists::chooseNear(std::size_t number, std::span<const Quad> position) {
  Part& part = parts_[number];
  const std::size_t first = partBegin(number);
  part.chosen.resize(part.far.size() + 1);
  const std::size_t count = choose_({first, partBegin(number + 1) - first, part.farBegin.data(),
                                     part.far.data(), place_.data(), image_.data()},
                                    part.chosen.data());
  sortChosen(part, count);
  std::size_t across = 0;
  const auto farPair = [&](std::size_t p) -> const SpaceNeighbour& {
    return part.far[static_cast<std::size_t>(part.chosen[p].pair)];
  };
  const auto isAcross = [&](std::size_t p) {
    return !isUpTo(number, static_cast<std::size_t>(farPair(p).j));
  };
  if (parts() > 1)
    for (std::size_t p = 0; p < count; ++p) across += isAcross(p);
  part.near[0].makeRoom(count - across, false);
  part.near[1].makeRoom(across, true);
  const std::array<SpacePairs, 2> listed{part.near[0].view(), part.near[1].view()};
  std::array<std::size_t, 2> at{};
  // Both are in one order, so that one walk through both finds every pair that touches.
  std::array<std::size_t, 2> next{};
  for (std::size_t p = 0; p < count; ++p) {
    const std::size_t list = across > 0 && isAcross(p) ? 1 : 0, n = at[list]++;
    NearPairs& near = part.near[list];
    const SpaceNeighbour& pair = farPair(p);
    near.i[n] = part.chosen[p].i;
    near.j[n] = pair.j;
    const Quad &a = cells_.winding(static_cast<std::size_t>(near.i[n])),
               &b = cells_.winding(static_cast<std::size_t>(pair.j)), image = boxesOf(pair.image);
    const Quad boxes{a.x - b.x + image.x, a.y - b.y + image.y, a.z - b.z + image.z, 0.0};
    near.shiftOf[n] = 0;
    if (!isZero(vectorOf(boxes))) {
      near.shiftOf[n] = static_cast<std::int32_t>(near.shifts.size());
      near.shifts.push_back(cells_.boxes(boxes));
    }
    std::size_t& kept = next[list];
    const std::size_t last = near.beforeI.size();
    const auto isBefore = [&] {
      return near.beforeI[kept] < near.i[n] ||
             (near.beforeI[kept] == near.i[n] && near.beforeJ[kept] < near.j[n]);
    };
    while (kept < last && isBefore()) ++kept;
    const double reach = position[static_cast<std::size_t>(near.i[n])].w +
                         position[static_cast<std::size_t>(near.j[n])].w + range_;
    const bool touches =
        kept < last && near.beforeI[kept] == near.i[n] && near.beforeJ[kept] == near.j[n];
    listed[list].setTouches(n, touches, reach);
    if (!touches) continue;
    const SpaceContactView before = near.before.view();
    listed[list].contacts.set(n, before.memory(kept), before.result(kept));
  }
}

/// Into ascending j: those of one i are together, and few.
void SpaceLists::sortChosen(Part& part, std::size_t count) {
  std::vector<SpaceChoice>& chosen = part.chosen;
  const auto partner = [&](std::size_t at) {
    return part.far[static_cast<std::size_t>(chosen[at].pair)].j;
  };
  for (std::size_t p = 1; p < count; ++p)
    for (std::size_t at = p;
         at > 0 && chosen[at - 1].i == chosen[at].i && partner(at) < partner(at - 1); --at)
      std::swap(chosen[at], chosen[at - 1]);
}

SpacePairs SpaceLists::NearPairs::view() {
  return {i.size(),        i.data(),       j.data(),
          shifts.data(),   shiftOf.data(), within.data(),
          contacts.view(), touches.data(), pushes.empty() ? nullptr : pushes.data()};
}

void SpaceLists::NearPairs::rememberTouching() {
  beforeI.clear();
  beforeJ.clear();
  for (std::size_t p = 0; p < i.size(); ++p) {
    if (touches[p] == 0) continue;
    beforeI.push_back(i[p]);
    beforeJ.push_back(j[p]);
  }
  before.resize(beforeI.size());
  const SpaceContactView from = contacts.view(), to = before.view();
  for (std::size_t p = 0, n = 0; p < i.size(); ++p)
    if (touches[p] != 0) to.set(n++, from.memory(p), from.result(p));
}

void SpaceLists::NearPairs::remember(const std::vector<Kept>& touching) {
  beforeI.clear();
  beforeJ.clear();
  before.resize(touching.size());
  for (const Kept& pair : touching) {
    before.view().set(beforeI.size(), pair.memory, pair.result);
    beforeI.push_back(pair.i);
    beforeJ.push_back(pair.j);
  }
}

/// @param apart  what pairs do is left to others
void SpaceLists::NearPairs::makeRoom(std::size_t count, bool apart) {
  i.resize(count);
  j.resize(count);
  shifts.assign(1, Quad{});
  shiftOf.resize(count);
  within.resize(count);
  touches.resize(count);
  if (contacts.size() < count) {
    contacts.resize(count);
    if (apart) pushes.resize(count);
  }
}

}  // namespace grain
