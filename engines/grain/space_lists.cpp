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

SpaceLists::SpaceLists(std::size_t moving, const SpaceBox& box, Skin skin, double range,
                       const SpaceKernels& kernels)
    : moving_(moving), skin_(skin), range_(range), kernels_(kernels), cells_(box) {
  for (std::size_t image = 0; image < imageCount; ++image)
    image_.push_back(cells_.boxes(boxesOf(static_cast<std::int32_t>(image))));
}

void SpaceLists::update(std::span<const Quad> position, std::span<const double> travel,
                        std::size_t stepsSince) {
  skin_.beginUpdate(stepsSince);
  requireFinite(position);
  skin_.allow(travel, allowance_);
  carried_ = touching();
  if (const double used = skinUsed(position); !(used <= 0.5 * skin_.skin())) {
    skin_.tune(counts(), used);
    rebuild(position);
  }
  choose(position);
  skin_.endRefresh(counts());
}

void SpaceLists::restore(std::vector<Kept> touching, std::span<const Quad> position,
                         std::span<const double> travel) {
  skin_.beginUpdate(0);
  requireFinite(position);
  skin_.allow(travel, allowance_);
  carried_ = std::move(touching);
  rebuild(position);
  choose(position);
}

void SpaceLists::renumber(std::span<const std::int32_t> newNumber, std::span<const Quad> position,
                          std::span<const double> travel) {
  std::vector<Kept> kept = touching();
  for (Kept& pair : kept) {
    pair.i = newNumber[static_cast<std::size_t>(pair.i)];
    if (pair.j < static_cast<std::int32_t>(moving_))
      pair.j = newNumber[static_cast<std::size_t>(pair.j)];
    if (pair.j < pair.i) pair = swapped(pair);
  }
  std::ranges::sort(kept, [](const Kept& a, const Kept& b) { return earlier(a, b); });
  restore(std::move(kept), position, travel);
}

void SpaceLists::rebuild(std::span<const Quad> position) {
  skin_.beginRebuild();
  collect(position);
  built_.assign(position.begin(), position.end());
  skin_.endRebuild();
}

std::vector<SpaceLists::Kept> SpaceLists::touching() const {
  std::vector<Kept> found;
  for (std::size_t p = 0; p < i_.size(); ++p)
    if (touches_[p] != 0) found.push_back({i_[p], j_[p], kept_[p], results_[p]});
  return found;
}

void SpaceLists::requireFinite(std::span<const Quad> position) const {
  for (std::size_t i = 0; i < position.size(); ++i)
    if (!std::isfinite(position[i].x + position[i].y + position[i].z)) throw NotFinite{i};
}

double SpaceLists::skinUsed(std::span<const Quad> position) const {
  if (built_.size() != position.size()) return std::numeric_limits<double>::infinity();
  double farthest = 0.0;
  for (std::size_t i = 0; i < built_.size(); ++i)
    farthest =
        std::max(farthest, length(vectorOf(position[i]) - vectorOf(built_[i])) + allowance_[i]);
  return farthest;
}

void SpaceLists::collect(std::span<const Quad> position) {
  far_.clear();
  farBegin_.assign(1, 0);
  row_.resize(position.size() + 1);
  double largest = 0.0;
  for (const Quad& place : position) largest = std::max(largest, place.w);
  const double reach = range_ + skin_.skin();
  cells_.sort(position, 2.0 * largest + reach);
  const SpaceCellsView view = cells_.view();
  for (std::size_t i = 0; i < moving_; ++i) {
    const Quad mine = cells_.inBox(i, position[i]);
    std::size_t found = 0;
    cells_.around(i, [&](std::size_t begin, std::size_t end) {
      found += kernels_.neighbours(view, mine, static_cast<std::int32_t>(i), begin, end, reach,
                                   row_.data() + found);
    });
    far_.insert(far_.end(), row_.begin(), row_.begin() + static_cast<std::ptrdiff_t>(found));
    farBegin_.push_back(static_cast<std::int32_t>(far_.size()));
  }
}

void SpaceLists::choose(std::span<const Quad> position) {
  place_.resize(position.size());
  for (std::size_t i = 0; i < position.size(); ++i) {
    place_[i] = cells_.inBox(i, position[i]);
    place_[i].w += allowance_[i] + 0.5 * range_;
  }
  chosen_.resize(far_.size() + 1);
  const std::size_t count = kernels_.choose(
      {moving_, farBegin_.data(), far_.data(), place_.data(), image_.data()}, chosen_.data());
  sortChosen(count);
  i_.resize(count);
  j_.resize(count);
  shift_.resize(count);
  touches_.resize(count);
  if (kept_.size() < count) {
    kept_.resize(count);
    results_.resize(count);
  }
  // Both are in one order, so that one walk through both finds every pair that touches.
  auto next = carried_.begin();
  for (std::size_t p = 0; p < count; ++p) {
    const SpaceNeighbour& pair = far_[static_cast<std::size_t>(chosen_[p].pair)];
    i_[p] = chosen_[p].i;
    j_[p] = pair.j;
    const Quad &a = cells_.winding(static_cast<std::size_t>(i_[p])),
               &b = cells_.winding(static_cast<std::size_t>(j_[p])), image = boxesOf(pair.image);
    shift_[p] = cells_.boxes({a.x - b.x + image.x, a.y - b.y + image.y, a.z - b.z + image.z, 0.0});
    const struct { std::int32_t i, j; } here{i_[p], j_[p]};
    while (next != carried_.end() && earlier(*next, here)) ++next;
    touches_[p] = next != carried_.end() && !earlier(here, *next);
    if (touches_[p] == 0) continue;
    kept_[p] = next->memory;
    results_[p] = next->result;
  }
}

/// Into ascending j: those of one i are together, and few.
void SpaceLists::sortChosen(std::size_t count) {
  const auto partner = [&](std::size_t at) {
    return far_[static_cast<std::size_t>(chosen_[at].pair)].j;
  };
  for (std::size_t p = 1; p < count; ++p)
    for (std::size_t at = p;
         at > 0 && chosen_[at - 1].i == chosen_[at].i && partner(at) < partner(at - 1); --at)
      std::swap(chosen_[at], chosen_[at - 1]);
}

SpacePairs SpaceLists::near() {
  return {i_.size(),    i_.data(),       j_.data(),      shift_.data(),
          kept_.data(), results_.data(), touches_.data()};
}

}  // namespace grain
