#include "averaging/volumes.hpp"

#include <gsl/gsl_integration.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <span>
#include <vector>

#include "averaging/areas.hpp"

namespace crossgrain::inline averaging {

namespace {

constexpr double wholeSphere = 4.0 * std::numbers::pi / 3.0;

/// Gauss and Legendre's nodes t, as sin ½πt and with that substitution's weights.
struct SliceNodes {
  static constexpr std::size_t count = 24;
  std::array<double, count> place, weight;
};

const SliceNodes& sliceNodes() {
  static const SliceNodes made = [] {
    const std::unique_ptr<gsl_integration_glfixed_table, void (*)(gsl_integration_glfixed_table*)>
        table(gsl_integration_glfixed_table_alloc(SliceNodes::count),
              gsl_integration_glfixed_table_free);
    SliceNodes result{};
    constexpr double quarter = 0.5 * std::numbers::pi;
    for (std::size_t k = 0; k < SliceNodes::count; ++k) {
      double t = 0.0, weight = 0.0;
      gsl_integration_glfixed_point(-1.0, 1.0, k, &t, &weight, table.get());
      result.place[k] = std::sin(quarter * t);
      result.weight[k] = quarter * std::cos(quarter * t) * weight;
    }
    return result;
  }();
  return made;
}

/// ∫ area(z, √(1 − z²)) dz from low to high, piece by piece between the slices whose circle has one
/// of these radii. Where it touches an edge the area grows as (z − z₀)^3/2; the substitution makes
/// that a whole power.
double overSlices(double low, double high, std::span<const double> touchingRadii,
                  const auto& area) {
  low = std::max(low, -1.0);
  high = std::min(high, 1.0);
  if (!(low < high)) return 0.0;
  std::vector<double> ends = {low, high};
  const auto split = [&](double z) {
    if (z > low && z < high) ends.push_back(z);
  };
  split(0.0);  // where the largest circle all but touches
  for (const double radius : touchingRadii)
    if (radius > 0.0 && radius < 1.0)
      for (const double sign : {-1.0, 1.0}) split(sign * std::sqrt(1.0 - radius * radius));
  std::ranges::sort(ends);
  double sum = 0.0;
  for (std::size_t piece = 0; piece + 1 < ends.size(); ++piece) {
    const double half = 0.5 * (ends[piece + 1] - ends[piece]);
    if (half == 0.0) continue;
    const double middle = 0.5 * (ends[piece + 1] + ends[piece]);
    for (std::size_t k = 0; k < SliceNodes::count; ++k) {
      const double z = middle + half * sliceNodes().place[k];
      sum += half * sliceNodes().weight[k] * area(std::sqrt(std::max(1.0 - z * z, 0.0)));
    }
  }
  return sum;
}

}  // namespace

double fractionBelow(double z) {
  const double x = std::clamp(z, -1.0, 1.0);
  return 0.5 + 0.25 * x * (3.0 - x * x);
}

double fractionWithin(const Vec3& low, const Vec3& high) {
  std::array<int, 3> order = {0, 1, 2};  // cut directions first
  const auto isCut = [&](int k) { return low[k] > -1.0 || high[k] < 1.0; };
  const auto cuts = std::ranges::partition(order, isCut).begin() - order.begin();
  if (cuts == 0) return 1.0;
  const auto [i, j, k] = order;
  if (cuts == 1) return std::max(fractionBelow(high[i]) - fractionBelow(low[i]), 0.0);
  std::vector<double> touching;  // circles that reach a side or a corner
  for (const double x : {low[i], high[i]}) {
    touching.push_back(std::abs(x));
    for (const double y : {low[j], high[j]}) touching.push_back(std::hypot(x, y));
  }
  for (const double y : {low[j], high[j]}) touching.push_back(std::abs(y));
  const auto area = [&, i = i, j = j](double r) {
    if (r == 0.0) return 0.0;
    const auto quadrant = [&](double x, double y) { return quadrantArea(x / r, y / r); };
    return r * r *
           (quadrant(high[i], high[j]) - quadrant(low[i], high[j]) - quadrant(high[i], low[j]) +
            quadrant(low[i], low[j]));
  };
  return std::max(overSlices(low[k], high[k], touching, area) / wholeSphere, 0.0);
}

double fractionInCylinder(double s, double R, double low, double high) {
  if (R <= 0.0 || s - R >= 1.0) return 0.0;
  if (R - s >= 1.0) return std::max(fractionBelow(high) - fractionBelow(low), 0.0);
  const std::array touching = {std::abs(s - R), s + R};
  return overSlices(low, high, touching, [&](double r) { return commonArea(s, r, R); }) /
         wholeSphere;
}

}  // namespace crossgrain::inline averaging
