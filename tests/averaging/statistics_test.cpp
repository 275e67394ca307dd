#include "averaging/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

namespace crossgrain {
namespace {

/// x(t+1) = φ x(t) + unit noise, from its stationary distribution. τ = ½(1 + φ)/(1 − φ), true mean
/// 0.
std::vector<double> autoregressive(std::mt19937_64& generator, double phi, int length) {
  std::normal_distribution<double> normal;
  std::vector<double> series;
  double x = normal(generator) / std::sqrt(1.0 - phi * phi);
  for (int t = 0; t < length; ++t) {
    series.push_back(x);
    x = phi * x + normal(generator);
  }
  return series;
}

double tauOf(double phi) {
  return 0.5 * (1.0 + phi) / (1.0 - phi);
}

struct Coverage {
  double covered = 0.0, resolved = 0.0, nEff = 0.0;
};

Coverage coverage(double phi, double lengthInTau, int repeats) {
  std::mt19937_64 generator(12);
  Coverage result;
  for (int k = 0; k < repeats; ++k) {
    const auto series =
        autoregressive(generator, phi, static_cast<int>(std::lround(lengthInTau * tauOf(phi))));
    const MeanEstimate estimate = estimateMean(series);
    result.covered += std::abs(estimate.mean) < halfWidth(estimate, 0.95).value();
    result.resolved += estimate.resolved;
    result.nEff += estimate.nEff;
  }
  result.covered /= repeats;
  result.resolved /= repeats;
  result.nEff /= repeats;
  return result;
}

TEST(EstimateMean, BarsOfCorrelatedSeriesCoverWhatTheySay) {
  for (const double phi : {0.3, 0.8, 0.95})
    for (const double lengthInTau : {50.0, 100.0, 400.0}) {
      const Coverage c = coverage(phi, lengthInTau, 1000);
      EXPECT_GE(c.covered, 0.92) << "phi " << phi << " N/tau " << lengthInTau;
      EXPECT_LE(c.covered, 0.98) << "phi " << phi << " N/tau " << lengthInTau;
    }
}

TEST(EstimateMean, EffectiveNumberIsLengthOverTwiceTau) {
  // AR(1) has τ = ½(1 + φ)/(1 − φ); 5 % for the estimate's bias and the scatter of 200 repeats.
  const Coverage c = coverage(0.8, 1000.0, 200);
  EXPECT_NEAR(c.nEff / 500.0, 1.0, 0.05);
}

TEST(EstimateMean, WhiteNoiseIsWorthNearlyItsLength) {
  std::mt19937_64 generator(13);
  const MeanEstimate estimate = estimateMean(autoregressive(generator, 0.0, 10000));
  EXPECT_NEAR(estimate.tau, 0.5, 0.1);
  EXPECT_NEAR(*estimate.standardError, 0.01, 0.001);
  EXPECT_TRUE(estimate.resolved);
}

TEST(EstimateMean, ShortSeriesSayThatTheyAreShort) {
  // Eight correlation times: about as often as not it cannot tell; bars still cover in nine of ten.
  const Coverage c = coverage(0.95, 8.0, 1000);
  EXPECT_GE(c.covered, 0.90);
  // A drift over the whole series is one sample.
  std::vector<double> drift;
  for (int t = 0; t < 400; ++t) drift.push_back(t / 399.0);
  const MeanEstimate estimate = estimateMean(drift);
  EXPECT_FALSE(estimate.resolved);
  EXPECT_EQ(estimate.nEff, 1.0);
  EXPECT_NEAR(*estimate.standardError, 1.0 / std::sqrt(12.0), 0.01);  // scatter of the uniform
  EXPECT_GT(halfWidth(estimate, 0.95).value(), 3.0);
}

TEST(EstimateMean, AlternatingSeriesAreNotOverrated) {
  std::vector<double> series;
  for (int t = 0; t < 100; ++t) series.push_back(t % 2 == 0 ? 1.0 : -1.0);
  const MeanEstimate estimate = estimateMean(series);
  EXPECT_LE(estimate.nEff, 100.0);
  EXPECT_GT(*estimate.standardError, 0.09);
}

TEST(EstimateMean, AFrozenSeriesIsOneSample) {
  const std::vector<double> series(50, 3.25);
  const MeanEstimate estimate = estimateMean(series);
  EXPECT_EQ(estimate.mean, 3.25);
  EXPECT_EQ(estimate.standardError, 0.0);
  EXPECT_EQ(estimate.nEff, 1.0);
  EXPECT_FALSE(estimate.resolved);
}

TEST(EstimateMean, TooFewSamplesGiveNoBar) {
  EXPECT_FALSE(estimateMean(std::vector{1.0, 2.0, 3.0}).standardError);
  EXPECT_THROW(estimateMean(std::vector<double>{}), std::invalid_argument);
}

TEST(StudentQuantile, TabulatedValues) {
  // Any table of Student's t, two-sided 95 %: 12.706 (1), 3.182 (3), 2.228 (10), 1.960 (∞).
  EXPECT_NEAR(studentQuantile(0.95, 1.0), 12.706, 5e-4);
  EXPECT_NEAR(studentQuantile(0.95, 3.0), 3.182, 5e-4);
  EXPECT_NEAR(studentQuantile(0.95, 10.0), 2.228, 5e-4);
  EXPECT_NEAR(studentQuantile(0.95, 1e6), 1.960, 5e-4);
}

}  // namespace
}  // namespace crossgrain
