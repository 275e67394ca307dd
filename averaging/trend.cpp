#include "averaging/trend.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "averaging/statistics.hpp"

namespace crossgrain::inline averaging {

namespace {

constexpr std::size_t fewestTrendSamples = 12;  ///< degrees 0 … 9 and some to spare
constexpr double tausPerTrendMode = 16.0;
constexpr double fewestTrendModes = 3.0, mostTrendModes = 8.0;
constexpr int lastBend = 3;          ///< highest degree of what may belong to a drift
constexpr double steepEnough = 4.0;  ///< intervals beside bends that an unresolved drift exceeds

/// Orthonormal polynomials over N equidistant points, one after the other: x p_k less its part
/// along p_(k−1), for the points lie evenly about 0.
class GramPolynomials {
 public:
  explicit GramPolynomials(std::size_t points)
      : x_(points),
        before_(points, 0.0),
        now_(points, 1.0 / std::sqrt(static_cast<double>(points))) {
    std::iota(x_.begin(), x_.end(), -0.5 * static_cast<double>(points - 1));
  }

  /// The polynomial of the next degree, from 1 on.
  std::span<const double> next() {
    std::vector<double> raised(x_.size());
    double along = 0.0, norm = 0.0;
    for (std::size_t t = 0; t < x_.size(); ++t) along += x_[t] * now_[t] * before_[t];
    for (std::size_t t = 0; t < x_.size(); ++t) {
      raised[t] = x_[t] * now_[t] - along * before_[t];
      norm += raised[t] * raised[t];
    }
    for (double& value : raised) value /= std::sqrt(norm);
    before_ = std::move(now_);
    now_ = std::move(raised);
    return now_;
  }

 private:
  std::vector<double> x_, before_, now_;
};

double product(std::span<const double> a, std::span<const double> b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

Trend estimateTrend(std::span<const double> series) {
  if (series.empty()) throw std::invalid_argument("trend: the trend of an empty series");
  const double n = static_cast<double>(series.size());
  Trend result;
  result.mean = std::accumulate(series.begin(), series.end(), 0.0) / n;
  if (series.size() < fewestTrendSamples) return result;

  if (const auto [low, high] = std::ranges::minmax(series); low == high) {
    // Nothing but rounding would be left to fit a line to.
    result.standardError = result.errorBesideBends = 0.0;
    result.dof = fewestTrendModes;
    result.resolved = true;
    return result;
  }

  GramPolynomials polynomials(series.size());
  std::vector<double> rest(series.begin(), series.end());
  const std::span<const double> line = polynomials.next();
  const double rise = product(line, series);
  for (std::size_t t = 0; t < rest.size(); ++t) rest[t] -= result.mean + rise * line[t];
  // p_1 rises by N − 1 over √(N(N² − 1)/12).
  const double span = (n - 1.0) / std::sqrt(n * (n * n - 1.0) / 12.0);
  result.change = span * rise;

  const double tau = estimateMean(rest).tau;
  result.resolved = n >= tausPerTrendMode * tau;
  result.dof =
      std::clamp(std::floor(n / (tausPerTrendMode * tau)), fewestTrendModes, mostTrendModes);
  double scatter = 0.0, besideBends = 0.0;
  for (int k = 0; k < static_cast<int>(mostTrendModes); ++k) {
    const double coefficient = product(polynomials.next(), rest);
    const int degree = k + 2;
    if (k < static_cast<int>(result.dof)) scatter += coefficient * coefficient / result.dof;
    if (degree > lastBend && degree <= lastBend + static_cast<int>(fewestTrendModes))
      besideBends += coefficient * coefficient / fewestTrendModes;
  }
  result.standardError = span * std::sqrt(scatter);
  result.errorBesideBends = span * std::sqrt(besideBends);
  return result;
}

RelativeDrift relativeDrift(std::span<const double> series, double confidence, double limit) {
  RelativeDrift result;
  if (series.empty()) return result;
  const Trend trend = estimateTrend(series);
  if (!trend.standardError || trend.mean == 0.0) return result;
  const double quantile = studentQuantile(confidence, trend.dof);
  const double scale = std::abs(trend.mean);
  result.change = trend.change / scale;
  result.half = quantile * *trend.standardError / scale;
  if (!trend.resolved) {
    const double beside = studentQuantile(confidence, fewestTrendModes) * *trend.errorBesideBends;
    result.half = std::min(*result.half, steepEnough * beside / scale);
  }
  result.excluded = std::abs(*result.change) + *result.half;
  if (std::abs(*result.change) > *result.half)
    result.verdict = Drift::drifts;
  else if (trend.resolved && *result.excluded <= limit)
    result.verdict = Drift::notSeen;
  return result;
}

}  // namespace crossgrain::inline averaging
