#include "engines/grain/space_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace grain {
namespace {

using Vector = Vec3<double>;

/// Component by component; a Vec3 has no index.
template <class Component>
Vector each(const Component& component) {
  return {component(0, &Vector::x), component(1, &Vector::y), component(2, &Vector::z)};
}

}  // namespace

SpaceCells::SpaceCells(const SpaceBox& box) : box_(box) {
  length_ = quadOf(
      each([&](std::size_t k, auto axis) { return box.periodic[k] ? box.length.*axis : 0.0; }));
  half_ = quadOf(each([&](std::size_t k, auto axis) {
                   return box.periodic[k] ? 0.5 * box.length.*axis
                                          : std::numeric_limits<double>::infinity();
                 }),
                 std::numeric_limits<double>::infinity());
}

Quad SpaceCells::boxes(const Quad& count) const {
  return {count.x * length_.x, count.y * length_.y, count.z * length_.z, 0.0};
}

Quad SpaceCells::inBox(std::size_t i, const Quad& position) const {
  const Quad away = boxes(winding_[i]);
  return {position.x - away.x, position.y - away.y, position.z - away.z, position.w};
}

/// Cells of at least `size`, of the box along periodic directions, else of what the spheres take
/// up.
void SpaceCells::layOut(std::span<const Quad> position, double size) {
  Vector low = vectorOf(position[0]), high = low;
  for (const Quad& place : position) {
    low = {std::min(low.x, place.x), std::min(low.y, place.y), std::min(low.z, place.z)};
    high = {std::max(high.x, place.x), std::max(high.y, place.y), std::max(high.z, place.z)};
  }
  const Vector extent = each([&](std::size_t k, auto axis) {
    return box_.periodic[k] ? box_.length.*axis : high.*axis - low.*axis;
  });
  const auto fits = [&](double along) { return std::max(1.0, std::floor(along / size)); };
  // A sphere that flew far away must not blow the grid up: larger cells are slower, never wrong.
  const double most = 16.0 + 4.0 * static_cast<double>(position.size());
  while (fits(extent.x) * fits(extent.y) * fits(extent.z) > most) size *= 1.5;
  size_ = each([&](std::size_t k, auto axis) {
    count_[k] = static_cast<std::int32_t>(fits(extent.*axis));
    return std::max(extent.*axis / fits(extent.*axis), size * 1e-9);
  });
  low_ =
      each([&](std::size_t k, auto axis) { return box_.periodic[k] ? box_.low.*axis : low.*axis; });
}

SpaceCells::Cell SpaceCells::cellOf(const Quad& inBox) const {
  Cell cell{};
  const Vector place = vectorOf(inBox);
  each([&](std::size_t k, auto axis) {
    const double from = (place.*axis - low_.*axis) / size_.*axis;
    cell[k] = static_cast<std::int32_t>(std::clamp(from, 0.0, count_[k] - 1.0));
    return 0.0;
  });
  return cell;
}

void SpaceCells::sort(std::span<const Quad> position, double size) {
  const std::size_t all = position.size();
  winding_.resize(all);
  place_.resize(all + spareOfSorted);
  cellOf_.resize(all);
  sorted_.resize(all);
  begin_.assign(2, 0);
  if (all == 0) return;
  layOut(position, size);
  const auto cells = number({count_[0] - 1, count_[1] - 1, count_[2] - 1}) + 1;
  begin_.assign(cells + 1, 0);
  for (std::size_t i = 0; i < all; ++i) {
    const Vector place = vectorOf(position[i]);
    winding_[i] = quadOf(each([&](std::size_t k, auto axis) {
      if (!box_.periodic[k]) return 0.0;
      return std::floor((place.*axis - box_.low.*axis) / box_.length.*axis);
    }));
    cellOf_[i] = cellOf(inBox(i, position[i]));
    ++begin_[number(cellOf_[i]) + 1];
  }
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  std::vector<std::int32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t i = 0; i < all; ++i) {
    const auto at = static_cast<std::size_t>(next[number(cellOf_[i])]++);
    sorted_[at] = static_cast<std::int32_t>(i);
    place_[at] = inBox(i, position[i]);
  }
}

SpaceCells::Ranges SpaceCells::rangesAround(std::size_t direction, std::int32_t at) const {
  const std::int32_t count = count_[direction];
  const std::int32_t low = at - 1, high = at + 1, last = count - 1;
  if (!box_.periodic[direction]) return {{{{std::max(low, 0), std::min(high, last)}, {}}}, 1};
  if (count <= 3) return {{{{0, last}, {}}}, 1};
  if (low < 0) return {{{{0, high}, {last, last}}}, 2};
  if (high > last) return {{{{low, last}, {0, 0}}}, 2};
  return {{{{low, high}, {}}}, 1};
}

}  // namespace grain
