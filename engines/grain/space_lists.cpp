#include "engines/grain/space_lists.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engines/grain/pair_lists.hpp"

namespace grain {
namespace {

using Vector = Vec3<double>;

/// Component by component; a Vec3 has no index.
template <class Component>
Vector each(const Component& component) {
  return {component(0, &Vector::x), component(1, &Vector::y), component(2, &Vector::z)};
}

double square(const Vector& v) {
  return dot(v, v);
}

}  // namespace

Vec3<double> SpaceBox::shift(const Vector& apart) const {
  return each([&](std::size_t k, auto axis) {
    const double side = length.*axis, along = apart.*axis;
    // Most pairs are nearest as they are.
    if (!periodic[k] || std::abs(along) < 0.5 * side) return 0.0;
    return side * std::round(along / side);
  });
}

SpaceLists::SpaceLists(std::size_t moving, const SpaceBox& box, Skin skin, double range)
    : moving_(moving), box_(box), skin_(skin), range_(range) {}

void SpaceLists::update(std::span<const Quad> position, std::span<const double> travel,
                        std::size_t stepsSince) {
  skin_.beginUpdate(stepsSince);
  requireFinite(position);
  skin_.allow(travel, allowance_);
  carried_ = touching();
  const PairCounts counts{carried_.size(), i_.size(), far_.size()};
  if (const double used = skinUsed(position); !(used <= 0.5 * skin_.skin())) {
    skin_.tune(counts, used);
    rebuild(position);
  }
  choose(position);
  skin_.endRefresh({carried_.size(), i_.size(), far_.size()});
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

/// Cells of at least `reach`, of the box along periodic directions, else of what the spheres take
/// up.
void SpaceLists::sortIntoCells(std::span<const Quad> position, double reach) {
  Vector low = vectorOf(position[0]), high = low;
  for (const Quad& place : position) {
    low = {std::min(low.x, place.x), std::min(low.y, place.y), std::min(low.z, place.z)};
    high = {std::max(high.x, place.x), std::max(high.y, place.y), std::max(high.z, place.z)};
  }
  const Vector extent = each([&](std::size_t k, auto axis) {
    return box_.periodic[k] ? box_.length.*axis : high.*axis - low.*axis;
  });
  const auto fits = [&](double along) { return std::max(1.0, std::floor(along / reach)); };
  // A sphere that flew far away must not blow the grid up: larger cells are slower, never wrong.
  const double most = 16.0 + 4.0 * static_cast<double>(position.size());
  while (fits(extent.x) * fits(extent.y) * fits(extent.z) > most) reach *= 1.5;
  cells_.size = each([&](std::size_t k, auto axis) {
    cells_.count[k] = static_cast<std::int32_t>(fits(extent.*axis));
    return std::max(extent.*axis / fits(extent.*axis), reach * 1e-9);
  });
  cells_.low =
      each([&](std::size_t k, auto axis) { return box_.periodic[k] ? box_.low.*axis : low.*axis; });
  cellOf_.resize(position.size());
  const std::size_t cells = static_cast<std::size_t>(cells_.count[0]) *
                            static_cast<std::size_t>(cells_.count[1]) *
                            static_cast<std::size_t>(cells_.count[2]);
  cells_.begin.assign(cells + 1, 0);
  cells_.sorted.resize(position.size());
  const auto number = [&](const std::array<std::int32_t, 3>& cell) {
    return static_cast<std::size_t>((cell[2] * cells_.count[1] + cell[1]) * cells_.count[0] +
                                    cell[0]);
  };
  for (std::size_t i = 0; i < position.size(); ++i) {
    const Vector place = vectorOf(position[i]);
    each([&](std::size_t k, auto axis) {
      double from = (place.*axis - cells_.low.*axis) / cells_.size.*axis;
      const double count = cells_.count[k];
      if (box_.periodic[k]) from -= count * std::floor(from / count);
      cellOf_[i][k] = static_cast<std::int32_t>(std::clamp(std::floor(from), 0.0, count - 1.0));
      return 0.0;
    });
    ++cells_.begin[number(cellOf_[i]) + 1];
  }
  std::partial_sum(cells_.begin.begin(), cells_.begin.end(), cells_.begin.begin());
  std::vector<std::int32_t> next(cells_.begin.begin(), cells_.begin.end() - 1);
  for (std::size_t i = 0; i < position.size(); ++i)
    cells_.sorted[static_cast<std::size_t>(next[number(cellOf_[i])]++)] =
        static_cast<std::int32_t>(i);
}

void SpaceLists::collect(std::span<const Quad> position) {
  far_.clear();
  if (position.empty()) return;
  double largest = 0.0;
  for (const Quad& place : position) largest = std::max(largest, place.w);
  sortIntoCells(position, 2.0 * largest + range_ + skin_.skin());
  std::vector<Far> row;
  for (std::size_t i = 0; i < moving_; ++i) {
    row.clear();
    // The cells around, each once, of a direction with few cells too.
    std::array<std::array<std::int32_t, 3>, 3> around;
    std::array<std::size_t, 3> ways{};
    for (std::size_t k = 0; k < 3; ++k)
      for (std::int32_t step = -1; step <= 1; ++step) {
        std::int32_t at = cellOf_[i][k] + step;
        const std::int32_t count = cells_.count[k];
        if (box_.periodic[k]) at = (at + count) % count;
        if (at < 0 || at >= count) continue;
        const auto known = around[k].begin() + static_cast<std::ptrdiff_t>(ways[k]);
        if (std::find(around[k].begin(), known, at) == known) around[k][ways[k]++] = at;
      }
    for (std::size_t z = 0; z < ways[2]; ++z)
      for (std::size_t y = 0; y < ways[1]; ++y)
        for (std::size_t x = 0; x < ways[0]; ++x) {
          const auto cell = static_cast<std::size_t>(
              (around[2][z] * cells_.count[1] + around[1][y]) * cells_.count[0] + around[0][x]);
          for (std::int32_t at = cells_.begin[cell]; at < cells_.begin[cell + 1]; ++at) {
            const std::int32_t j = cells_.sorted[static_cast<std::size_t>(at)];
            if (j <= static_cast<std::int32_t>(i)) continue;
            const Quad& b = position[static_cast<std::size_t>(j)];
            const Vector apart = vectorOf(position[i]) - vectorOf(b);
            const Vector shift = box_.shift(apart);
            const double reach = position[i].w + b.w + range_ + skin_.skin();
            if (square(apart - shift) < reach * reach)
              row.push_back({static_cast<std::int32_t>(i), j, quadOf(shift)});
          }
        }
    std::ranges::sort(row, {}, &Far::j);
    far_.insert(far_.end(), row.begin(), row.end());
  }
}

void SpaceLists::choose(std::span<const Quad> position) {
  i_.clear();
  j_.clear();
  shift_.clear();
  kept_.clear();
  results_.clear();
  touches_.clear();
  // Both are in one order, so that one walk through both finds every pair that touches.
  auto next = carried_.begin();
  const auto numbers = [](const auto& pair) { return std::pair(pair.i, pair.j); };
  for (const Far& pair : far_) {
    const Quad &a = position[static_cast<std::size_t>(pair.i)],
               &b = position[static_cast<std::size_t>(pair.j)];
    const double within = a.w + b.w + range_ + allowance_[static_cast<std::size_t>(pair.i)] +
                          allowance_[static_cast<std::size_t>(pair.j)];
    if (!(square(vectorOf(a) - vectorOf(b) - vectorOf(pair.shift)) < within * within)) continue;
    while (next != carried_.end() && numbers(*next) < numbers(pair)) ++next;
    const bool touched = next != carried_.end() && numbers(*next) == numbers(pair);
    i_.push_back(pair.i);
    j_.push_back(pair.j);
    shift_.push_back(pair.shift);
    kept_.push_back(touched ? next->memory : SpaceMemory<double>{});
    results_.push_back(touched ? next->result : SpaceResult{});
    touches_.push_back(touched);
  }
}

SpacePairs SpaceLists::near() {
  return {i_.size(),    i_.data(),       j_.data(),      shift_.data(),
          kept_.data(), results_.data(), touches_.data()};
}

}  // namespace grain
