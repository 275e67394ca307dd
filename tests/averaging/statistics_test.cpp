#include "averaging/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

namespace crossgrain {
namespace {

using std::numbers::pi;

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

/// A damped oscillation, x(t+1) = 2r cos(w) x(t) − r² x(t−1) + noise, from a long way back.
std::vector<double> oscillating(std::mt19937_64& generator, double r, double w, int length) {
  std::normal_distribution<double> normal;
  std::vector<double> series;
  double x = 0.0, before = 0.0;
  for (int t = -static_cast<int>(20.0 / (1.0 - r)); t < length; ++t) {
    before = std::exchange(x, 2.0 * r * std::cos(w) * x - r * r * before + normal(generator));
    if (t >= 0) series.push_back(x);
  }
  return series;
}

/// Fast noise of variance 1 on a slow part of variance `share`: what rings of a shear cell look
/// like.
std::vector<double> fastAndSlow(std::mt19937_64& generator, double slow, double share, int length) {
  std::vector<double> series = autoregressive(generator, 0.5, length);
  const std::vector<double> part = autoregressive(generator, slow, length);
  const double scale = std::sqrt(share * (1.0 - slow * slow) / (1.0 - 0.5 * 0.5));
  for (std::size_t t = 0; t < series.size(); ++t) series[t] += scale * part[t];
  return series;
}

struct Coverage {
  double covered = 0.0, resolved = 0.0, nEff = 0.0;
};

/// Of 95 % bars about series whose true mean is 0.
template <class Make>
Coverage coverageOf(Make make, int repeats) {
  std::mt19937_64 generator(12);
  Coverage result;
  for (int k = 0; k < repeats; ++k) {
    const MeanEstimate estimate = estimateMean(make(generator));
    result.covered += std::abs(estimate.mean) < halfWidth(estimate, 0.95).value();
    result.resolved += estimate.resolved;
    result.nEff += estimate.nEff;
  }
  result.covered /= repeats;
  result.resolved /= repeats;
  result.nEff /= repeats;
  return result;
}

Coverage coverage(double phi, double lengthInTau, int repeats) {
  const int length = static_cast<int>(std::lround(lengthInTau * tauOf(phi)));
  return coverageOf([&](auto& generator) { return autoregressive(generator, phi, length); },
                    repeats);
}

/// 2000 repeats leave a binomial error of 0.5 %.
constexpr int repeats = 2000;

TEST(EstimateMean, BarsOfLongSeriesCoverWhatTheySay) {
  for (const double phi : {0.0, 0.3, 0.8, 0.95})
    for (const double lengthInTau : {50.0, 100.0, 400.0}) {
      const Coverage c = coverage(phi, lengthInTau, repeats);
      EXPECT_GE(c.covered, 0.93) << "phi " << phi << " N/tau " << lengthInTau;
      EXPECT_LE(c.covered, 0.97) << "phi " << phi << " N/tau " << lengthInTau;
    }
}

TEST(EstimateMean, SlowPartsBelowFastNoiseAreSeen) {
  // The slow part has τ = 49.5 and a fifth, then a twentieth of the variance. A window of a few
  // integrated times ends long before it: the error was a quarter too small at any length.
  for (const double share : {0.25, 0.05})
    for (const double lengthInTau : {50.0, 200.0}) {
      const int length = static_cast<int>(std::lround(lengthInTau * tauOf(0.98)));
      const Coverage c = coverageOf(
          [&](auto& generator) { return fastAndSlow(generator, 0.98, share, length); }, 1000);
      EXPECT_GE(c.covered, 0.93) << "share " << share << " N/tau " << lengthInTau;
      EXPECT_LE(c.covered, 0.97) << "share " << share << " N/tau " << lengthInTau;
    }
}

TEST(EstimateMean, OscillatingSeriesCoverToo) {
  // 30 periods of an oscillation that dies out within one: τ = 20, far more than the period says.
  const Coverage c =
      coverageOf([](auto& generator) { return oscillating(generator, 0.95, 0.05, 2000); }, repeats);
  EXPECT_GE(c.covered, 0.93);
  EXPECT_LE(c.covered, 0.97);
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
  EXPECT_EQ(estimate.dof, 8.0);
  EXPECT_TRUE(estimate.resolved);
}

TEST(EstimateMean, TheErrorIsRightInTheMeanSquare) {
  // White noise of unit variance: E[se²] = 1/N exactly; 400 repeats of 8 degrees of freedom leave
  // √(2/3200) = 2.5 %.
  std::mt19937_64 generator(16);
  double square = 0.0;
  for (int k = 0; k < 400; ++k) {
    const MeanEstimate estimate = estimateMean(autoregressive(generator, 0.0, 500));
    square += *estimate.standardError * *estimate.standardError / 400.0;
  }
  EXPECT_NEAR(square * 500.0, 1.0, 0.1);
}

TEST(EstimateMean, ShortSeriesSayThatTheyAreShort) {
  // Where bars do not cover: 88 % at 5 correlation times, 92 % at 10.
  EXPECT_GE(coverage(0.95, 5.0, repeats).covered, 0.87);
  EXPECT_GE(coverage(0.95, 10.0, repeats).covered, 0.90);
  // A drift over the whole series is one sample.
  std::vector<double> drift;
  for (int t = 0; t < 400; ++t) drift.push_back(t / 399.0);
  const MeanEstimate estimate = estimateMean(drift);
  EXPECT_FALSE(estimate.resolved);
  EXPECT_EQ(estimate.nEff, 1.0);
  // A ramp's slowest mode holds (2/π²)²·2 = 0.0821 of the 1/12 that is the variance of a uniform.
  EXPECT_NEAR(*estimate.standardError, std::sqrt(8.0) / (pi * pi), 1e-3);
  EXPECT_GT(halfWidth(estimate, 0.95).value(), 3.0);
}

TEST(EstimateMean, AlternatingSeriesAreNotOverrated) {
  // The mean of ±1 in turn is known to 1/N, one sample left over at an end.
  std::vector<double> series;
  for (int t = 0; t < 100; ++t) series.push_back(t % 2 == 0 ? 1.0 : -1.0);
  const MeanEstimate estimate = estimateMean(series);
  EXPECT_LE(estimate.nEff, 100.0);
  EXPECT_NEAR(*estimate.standardError, 0.01, 0.003);
}

TEST(EstimateMean, AFrozenSeriesIsOneSampleAndFewSamplesGiveNoBar) {
  const MeanEstimate estimate = estimateMean(std::vector(50, 3.25));
  EXPECT_EQ(estimate.mean, 3.25);
  EXPECT_EQ(estimate.standardError, 0.0);
  EXPECT_EQ(estimate.nEff, 1.0);
  EXPECT_FALSE(estimate.resolved);
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
