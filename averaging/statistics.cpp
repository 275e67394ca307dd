#include "averaging/statistics.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace crossgrain {

namespace {

constexpr std::size_t fewestSamples = 4;
constexpr double windowInTau = 5.0;
constexpr double shortestInTau = 10.0;

double autocovariance(std::span<const double> deviation, std::size_t lag) {
  double sum = 0.0;
  for (std::size_t t = 0; t + lag < deviation.size(); ++t) sum += deviation[t] * deviation[t + lag];
  return sum / static_cast<double>(deviation.size() - lag);
}

struct Correlation {
  double tau = 0.5;
  std::size_t window = 0;
  bool resolved = false;
};

/// Sums ρ until the window is five times the sum, or the series is too short for what was summed.
Correlation correlationOf(std::span<const double> deviation, double variance) {
  const double n = static_cast<double>(deviation.size());
  Correlation result;
  while (static_cast<double>(result.window) < windowInTau * result.tau) {
    ++result.window;
    result.tau += autocovariance(deviation, result.window) / variance;
    if (shortestInTau * result.tau > n || 2 * result.window >= deviation.size()) return result;
  }
  // Anticorrelation can push the sum to 0 and below; no series is worth more than its length here.
  result.tau = std::max(result.tau, 0.5);
  result.resolved = true;
  return result;
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
  const Correlation correlation = correlationOf(deviation, variance);
  result.tau = correlation.tau;
  result.resolved = correlation.resolved;
  if (!result.resolved) {
    result.standardError = std::sqrt(variance * n / (n - 1.0));
    return result;
  }
  const double window = 2.0 * static_cast<double>(correlation.window) + 1.0;
  const double tau = correlation.tau * (1.0 + window / n);
  result.tau = tau;
  result.nEff = std::max(n / (2.0 * tau), 1.0);
  result.dof = std::max(n / window, 1.0);
  result.standardError = std::sqrt(variance / result.nEff);
  return result;
}

double studentQuantile(double confidence, double dof) {
  return gsl_cdf_tdist_Pinv(0.5 * (1.0 + confidence), dof);
}

std::optional<double> halfWidth(const MeanEstimate& estimate, double confidence) {
  if (!estimate.standardError) return std::nullopt;
  return studentQuantile(confidence, estimate.dof) * *estimate.standardError;
}

}  // namespace crossgrain
