#include "averaging/grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "averaging/areas.hpp"

namespace crossgrain::inline averaging {

Grid::Grid(const Vec2& low, const Vec2& high, int nx, int ny, double height)
    : low_(low), nx_(nx), ny_(ny), height_(height) {
  if (nx < 1 || ny < 1) throw std::invalid_argument("grid: at least one cell each way is needed");
  cell_ = (high - low).cwiseQuotient(Vec2(nx, ny));
  if (!cell_.allFinite() || !(cell_.minCoeff() > 0.0))
    throw std::invalid_argument("grid: the high corner must lie above and right of the low one");
  if (!std::isfinite(height) || !(height > 0.0))
    throw std::invalid_argument("grid: the height must be positive");
}

std::size_t Grid::slotAt(const Vec2& x) const {
  const Vec2 place = (x - low_).cwiseQuotient(cell_);
  const bool inside = place.minCoeff() >= 0.0 && place.x() < nx_ && place.y() < ny_;
  return inside ? slot(static_cast<int>(place.x()), static_cast<int>(place.y())) : 0;
}

void Grid::discFractions(const Vec2& x, double a, Edges, BinFractions& fractions) const {
  fractions.assign(1, {0, 0.0});
  const Vec2 from = (x - Vec2(a, a) - low_).cwiseQuotient(cell_);
  const Vec2 to = (x + Vec2(a, a) - low_).cwiseQuotient(cell_);
  const auto first = [](double place) {
    return static_cast<int>(std::floor(std::max(place, 0.0)));
  };
  const auto last = [](double place, int count) {
    return static_cast<int>(std::min(std::floor(place), count - 1.0));
  };
  const auto within = [&](int i, int j) {  // what lies below and left of corner (i, j)
    const Vec2 corner = (low_ + cell_.cwiseProduct(Vec2(i, j)) - x) / a;
    return quadrantArea(corner.x(), corner.y());
  };
  double rest = 1.0;
  for (int j = first(from.y()); j <= last(to.y(), ny_); ++j)
    for (int i = first(from.x()); i <= last(to.x(), nx_); ++i) {
      const double area = within(i + 1, j + 1) - within(i, j + 1) - within(i + 1, j) + within(i, j);
      const double fraction = std::max(area / std::numbers::pi, 0.0);
      fractions.push_back({slot(i, j), fraction});
      rest -= fraction;
    }
  fractions.front().fraction = std::max(rest, 0.0);
}

}  // namespace crossgrain::inline averaging
