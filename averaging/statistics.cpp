#include "averaging/statistics.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

namespace crossgrain::inline averaging {

namespace {

constexpr std::size_t fewestSamples = 4;
constexpr double tausPerMode = 8.0;
constexpr std::size_t mostModes = 8;

double autocovariance(std::span<const double> deviation, std::size_t lag) {
  double sum = 0.0;
  for (std::size_t t = 0; t + lag < deviation.size(); ++t) sum += deviation[t] * deviation[t + lag];
  return sum / static_cast<double>(deviation.size());
}

/// Sums of two neighbouring lags, as long as they are positive, and none above the one before it
/// (Geyer 1992, section 3.3). No series is worth more than its length here.
double correlationTime(std::span<const double> deviation, double variance) {
  double sum = -0.5;
  double last = std::numeric_limits<double>::infinity();
  for (std::size_t lag = 0; lag + 1 < deviation.size() / 2; lag += 2) {
    const double pair = autocovariance(deviation, lag) + autocovariance(deviation, lag + 1);
    if (!(pair > 0.0)) break;
    last = std::min(last, pair / variance);
    sum += last;
  }
  return std::max(sum, 0.5);
}

/// Square of the cosine coefficient of mode k, by the recurrence cos(n+1)θ = 2 cos θ cos nθ −
/// cos(n−1)θ.
double modePower(std::span<const double> deviation, std::size_t k) {
  const double n = static_cast<double>(deviation.size());
  const double step = std::numbers::pi * static_cast<double>(k) / n;
  double now = std::cos(0.5 * step);
  double before = now;  // cos(−½θ)
  double sum = 0.0;
  for (const double x : deviation) {
    sum += x * now;
    before = std::exchange(now, 2.0 * std::cos(step) * now - before);
  }
  return 2.0 / n * sum * sum;
}

}  // namespace

MeanEstimate estimateMean(std::span<const double> series) {
  if (series.empty()) throw std::invalid_argument("statistics: the mean of an empty series");
  const double n = static_cast<double>(series.size());
  MeanEstimate result;
  result.mean = std::accumulate(series.begin(), series.end(), 0.0) / n;
  result.nEff = 1.0;
  result.dof = 1.0;
  result.tau = n;
  if (series.size() < fewestSamples) return result;
  const auto [low, high] = std::ranges::minmax(series);
  if (low == high) {
    result.standardError = 0.0;
    return result;
  }

  std::vector<double> deviation(series.begin(), series.end());
  for (double& x : deviation) x -= result.mean;
  const double variance = autocovariance(deviation, 0);
  result.tau = correlationTime(deviation, variance);
  const auto modes = static_cast<std::size_t>(
      std::clamp(n / (tausPerMode * result.tau), 1.0, static_cast<double>(mostModes)));
  double density = 0.0;
  for (std::size_t k = 1; k <= modes; ++k) density += modePower(deviation, k);
  density /= static_cast<double>(modes);
  result.dof = static_cast<double>(modes);
  result.resolved = modes > 1;
  if (result.resolved) result.nEff = n / (2.0 * result.tau);
  result.standardError = std::sqrt(density / n);
  return result;
}

double studentQuantile(double confidence, double dof) {
  return gsl_cdf_tdist_Pinv(0.5 * (1.0 + confidence), dof);
}

std::optional<double> halfWidth(const MeanEstimate& estimate, double confidence) {
  if (!estimate.standardError) return std::nullopt;
  return studentQuantile(confidence, estimate.dof) * *estimate.standardError;
}

}  // namespace crossgrain::inline averaging
