#include "studies/thesis/claim_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "averaging/statistics.hpp"

namespace crossgrain::inline studies {
namespace {

/// Within-run errors rest on at most 8 modes (averaging/statistics.cpp).
constexpr double withinDof = 8.0;

int signOf(double x) {
  return (x > 0.0) - (x < 0.0);
}

/// Sizes of groups of equal numbers.
std::vector<double> tiesOf(std::vector<double> values) {
  std::map<double, double> counts;
  for (const double value : values) counts[value] += 1.0;
  std::vector<double> sizes;
  for (const auto& [value, count] : counts) sizes.push_back(count);
  return sizes;
}

template <typename Term>
double sumOver(const std::vector<double>& sizes, Term term) {
  return std::transform_reduce(sizes.begin(), sizes.end(), 0.0, std::plus(), term);
}

/// Var S of Kendall's S = Σ sign(Δx) sign(Δy) without a trend, ties accounted for.
double varianceOfS(double n, const std::vector<double>& ties, const std::vector<double>& others) {
  const auto full = [](double t) { return t * (t - 1.0) * (2.0 * t + 5.0); };
  const auto triple = [](double t) { return t * (t - 1.0) * (t - 2.0); };
  const auto pair = [](double t) { return t * (t - 1.0); };
  double variance = (full(n) - sumOver(ties, full) - sumOver(others, full)) / 18.0;
  if (n > 2.0) variance += sumOver(ties, triple) * sumOver(others, triple) / (9.0 * triple(n));
  return variance + sumOver(ties, pair) * sumOver(others, pair) / (2.0 * pair(n));
}

/// Sums of a regression line.
struct Line {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;

  void add(double px, double py) {
    n += 1.0;
    x += px;
    y += py;
    xx += px * px;
    xy += px * py;
  }
  double spread() const { return xx - x * x / n; }
  double together() const { return xy - x * y / n; }
};

/// What rounding leaves of the spread of equal x, relative to x².
constexpr double noSpread = 1e-12;

std::optional<double> slopeOf(const Line& line) {
  if (!(line.n > 1.0) || !(line.spread() > noSpread * line.xx)) return std::nullopt;
  return line.together() / line.spread();
}

}  // namespace

std::optional<double> Estimate::half(double confidence) const {
  if (basis == Basis::exact) return 0.0;
  if (!standardError) return std::nullopt;
  constexpr double many = 1e6;  // degrees of freedom from which t is normal
  return studentQuantile(confidence, std::min(dof, many)) * *standardError;
}

Estimate exactly(double value) {
  return {value, {}, std::numeric_limits<double>::infinity(), 0, Estimate::Basis::exact};
}

std::optional<Estimate> meanOver(std::span<const Measured> values) {
  if (values.empty()) return std::nullopt;
  const auto n = static_cast<double>(values.size());
  Estimate mean;
  mean.runs = static_cast<int>(values.size());
  for (const Measured& each : values) mean.value += each.value / n;
  if (values.size() == 1) {
    mean.basis = Estimate::Basis::within;
    mean.standardError = values.front().within;
    mean.dof = withinDof;
    return mean;
  }
  double squares = 0.0;
  for (const Measured& each : values) squares += std::pow(each.value - mean.value, 2);
  mean.standardError = std::sqrt(squares / (n * (n - 1.0)));
  mean.dof = n - 1.0;
  return mean;
}

std::optional<Estimate> rankTrend(std::span<const TrendPoint> points, int fewest) {
  if (static_cast<int>(points.size()) < std::max(fewest, 2)) return std::nullopt;
  int s = 0;
  std::vector<double> x, y;
  for (std::size_t i = 0; i < points.size(); ++i) {
    x.push_back(points[i].x);
    y.push_back(points[i].y);
    for (std::size_t j = 0; j < i; ++j)
      s += signOf(points[i].x - points[j].x) * signOf(points[i].y - points[j].y);
  }
  const auto n = static_cast<double>(points.size());
  const std::vector<double> xTies = tiesOf(x), yTies = tiesOf(y);
  const auto pairs = [n](const std::vector<double>& ties) {
    return 0.5 * (n * (n - 1.0) - sumOver(ties, [](double t) { return t * (t - 1.0); }));
  };
  const double scale = std::sqrt(pairs(xTies) * pairs(yTies));
  if (!(scale > 0.0)) return std::nullopt;
  Estimate tau;
  tau.value = s / scale;
  tau.standardError = std::sqrt(varianceOfS(n, xTies, yTies)) / scale;
  tau.runs = static_cast<int>(points.size());
  return tau;
}

std::optional<Estimate> commonSlope(std::span<const GroupedPoint> points) {
  std::map<std::size_t, Line> groups;
  double squares = 0.0;
  for (const GroupedPoint& at : points) {
    groups[at.group].add(at.x, at.y);
    squares += at.y * at.y;
  }
  double spread = 0.0, together = 0.0, xx = 0.0;
  for (const auto& [group, line] : groups) {
    spread += line.spread();
    together += line.together();
    xx += line.xx;
    squares -= line.y * line.y / line.n;
  }
  const double dof = static_cast<double>(points.size()) - static_cast<double>(groups.size()) - 1.0;
  if (!(spread > noSpread * xx) || !(dof > 0.0)) return std::nullopt;
  Estimate slope;
  slope.value = together / spread;
  slope.standardError = std::sqrt(std::max(0.0, squares - slope.value * together) / dof / spread);
  slope.dof = dof;
  slope.runs = static_cast<int>(points.size());
  return slope;
}

std::optional<Estimate> slopeOverRuns(std::span<const std::vector<TrendPoint>> runs) {
  if (runs.size() < 3) return std::nullopt;
  const auto slopeWithout = [&](std::size_t left) {
    Line line;
    for (std::size_t k = 0; k < runs.size(); ++k)
      if (k != left)
        for (const TrendPoint& at : runs[k]) line.add(at.x, at.y);
    return slopeOf(line);
  };
  const auto whole = slopeWithout(runs.size());
  if (!whole) return std::nullopt;
  std::vector<double> slopes;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const auto slope = slopeWithout(k);
    if (!slope) return std::nullopt;
    slopes.push_back(*slope);
  }
  const auto n = static_cast<double>(runs.size());
  const double mean = std::reduce(slopes.begin(), slopes.end()) / n;
  double squares = 0.0;
  for (const double slope : slopes) squares += std::pow(slope - mean, 2);
  Estimate slope;
  slope.value = *whole;
  slope.standardError = std::sqrt(squares * (n - 1.0) / n);
  slope.dof = n - 1.0;
  slope.runs = static_cast<int>(runs.size());
  return slope;
}

}  // namespace crossgrain::inline studies
