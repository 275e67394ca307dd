#include "averaging/grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "averaging/areas.hpp"

namespace crossgrain::inline averaging {

Grid::Grid(const Vec2& low, const Vec2& high, int nx, int ny, double height,
           const std::optional<BoxOf<2>>& box)
    : low_(low), nx_(nx), ny_(ny), height_(height) {
  if (nx < 1 || ny < 1) throw std::invalid_argument("grid: at least one cell each way is needed");
  cell_ = (high - low).cwiseQuotient(Vec2(nx, ny));
  if (!cell_.allFinite() || !(cell_.minCoeff() > 0.0))
    throw std::invalid_argument("grid: the high corner must lie above and right of the low one");
  if (!std::isfinite(height) || !(height > 0.0))
    throw std::invalid_argument("grid: the height must be positive");
  for (int k = 0; box && k < 2; ++k) {
    if (!box->periodic[static_cast<std::size_t>(k)]) continue;
    period_[k] = box->high[k] - box->low[k];
    if (high[k] - low[k] > period_[k] * (1.0 + 1e-9))
      throw std::invalid_argument("grid: it is longer than the box along a periodic direction");
  }
}

std::size_t Grid::slotAt(const Vec2& x) const {
  Vec2 from = x - low_;
  for (int k = 0; k < 2; ++k)
    if (period_[k] > 0.0) from[k] -= period_[k] * std::floor(from[k] / period_[k]);
  const Vec2 place = from.cwiseQuotient(cell_);
  const bool inside = place.minCoeff() >= 0.0 && place.x() < nx_ && place.y() < ny_;
  return inside ? slot(static_cast<int>(place.x()), static_cast<int>(place.y())) : 0;
}

template <typename Within>
void Grid::fractionsOf(const Vec2& low, const Vec2& high, double whole, const Within& within,
                       BinFractions& fractions) const {
  // Before the cast: beyond what an int holds the other side of the range is as good.
  const auto first = [](double place, int count) {
    return static_cast<int>(std::floor(std::clamp(place, 0.0, static_cast<double>(count))));
  };
  const auto last = [](double place, int count) {
    return static_cast<int>(std::clamp(std::floor(place), -1.0, count - 1.0));
  };
  fractions.assign(1, {0, 0.0});
  double rest = 1.0;
  const auto addImage = [&](const Vec2& shift) {
    const Vec2 from = (low + shift - low_).cwiseQuotient(cell_);
    const Vec2 to = (high + shift - low_).cwiseQuotient(cell_);
    const auto below = [&](int i, int j) {
      return within(shift, Vec2(low_ + cell_.cwiseProduct(Vec2(i, j))));
    };
    for (int j = first(from.y(), ny_); j <= last(to.y(), ny_); ++j)
      for (int i = first(from.x(), nx_); i <= last(to.x(), nx_); ++i) {
        const double area = below(i + 1, j + 1) - below(i, j + 1) - below(i + 1, j) + below(i, j);
        const double fraction = std::max(area / whole, 0.0);
        fractions.push_back({slot(i, j), fraction});
        rest -= fraction;
      }
  };
  // The images that reach the grid; without a period the body itself.
  const Vec2 size = cell_.cwiseProduct(Vec2(nx_, ny_));
  std::array<double, 2> begin{}, end{};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto d = static_cast<Eigen::Index>(k);
    if (!(period_[d] > 0.0)) continue;
    begin[k] = std::ceil((low_[d] - high[d]) / period_[d]);
    end[k] = std::floor((low_[d] + size[d] - low[d]) / period_[d]);
  }
  for (double j = begin[1]; j <= end[1]; ++j)
    for (double i = begin[0]; i <= end[0]; ++i) addImage(period_.cwiseProduct(Vec2(i, j)));
  fractions.front().fraction = std::max(rest, 0.0);
}

void Grid::discFractions(const Vec2& x, double a, Edges, BinFractions& fractions) const {
  const auto within = [&](const Vec2& shift, const Vec2& place) {
    const Vec2 corner = (place - (x + shift)) / a;
    return quadrantArea(corner.x(), corner.y());
  };
  fractionsOf(x - Vec2(a, a), x + Vec2(a, a), std::numbers::pi, within, fractions);
}

void Grid::outlineFractions(const std::vector<Vec2>& outline, BinFractions& fractions) const {
  Vec2 low = outline.front(), high = low;
  for (const Vec2& vertex : outline) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  const auto within = [&](const Vec2& shift, const Vec2& place) {
    return quadrantArea(outline, place - shift);
  };
  fractionsOf(low, high, areaOf(outline), within, fractions);
}

}  // namespace crossgrain::inline averaging
