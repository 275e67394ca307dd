#include "averaging/trend.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "averaging/statistics.hpp"

namespace crossgrain {
namespace {

constexpr double confidence = 0.95, limit = 0.25;

/// About 10, x(t+1) = φ x(t) + noise, of unit standard deviation.
std::vector<double> noisy(std::mt19937_64& generator, double phi, int length) {
  std::normal_distribution<double> normal;
  std::vector<double> series;
  double x = normal(generator);
  for (int t = 0; t < length; ++t) {
    series.push_back(10.0 + x);
    x = phi * x + std::sqrt(1.0 - phi * phi) * normal(generator);
  }
  return series;
}

/// @param rise  from the first sample to the last
std::vector<double> tilted(std::vector<double> series, double rise) {
  const double last = static_cast<double>(series.size() - 1);
  for (std::size_t t = 0; t < series.size(); ++t)
    series[t] += rise * (static_cast<double>(t) / last - 0.5);
  return series;
}

struct BinFractions {
  double drifts = 0.0, notSeen = 0.0, cannotTell = 0.0;
};

template <class Make>
BinFractions sharesOf(Make make, int repeats) {
  std::mt19937_64 generator(5);
  BinFractions fractions;
  for (int k = 0; k < repeats; ++k) {
    const Drift verdict = relativeDrift(make(generator), confidence, limit).verdict;
    (verdict == Drift::drifts    ? fractions.drifts
     : verdict == Drift::notSeen ? fractions.notSeen
                                 : fractions.cannotTell) += 1.0 / repeats;
  }
  return fractions;
}

TEST(Trend, IsTheLeastSquaresLine) {
  // (0, 1, 2, 3, …) rises by N − 1 and leaves nothing.
  std::vector<double> line;
  for (int t = 0; t < 20; ++t) line.push_back(3.0 * t);
  const Trend trend = estimateTrend(line);
  EXPECT_NEAR(trend.change, 57.0, 1e-10);
  EXPECT_NEAR(trend.mean, 28.5, 1e-12);
  EXPECT_NEAR(trend.standardError.value(), 0.0, 1e-10);
  // Σ x t/Σ t² of a single kick in twenty samples, by hand: t = −9.5, N(N² − 1)/12 = 665.
  std::vector<double> kick(20, 0.0);
  kick.front() = 7.0;
  EXPECT_NEAR(estimateTrend(kick).change, -9.5 * 7.0 / 665.0 * 19.0, 1e-12);
}

TEST(Trend, ErrorIsRightInTheMeanSquare) {
  // White noise: variance of the slope is 12/N³ about, of the rise 12/N.
  std::mt19937_64 generator(1);
  double square = 0.0;
  for (int k = 0; k < 400; ++k) {
    const Trend trend = estimateTrend(noisy(generator, 0.0, 300));
    square += *trend.standardError * *trend.standardError / 400.0;
  }
  EXPECT_NEAR(square * 300.0 / 12.0, 1.0, 0.1);
}

TEST(RelativeDrift, WhiteNoiseIsRarelyCalledADrift) {
  // 5 % and three binomial errors of 4000 repeats.
  const BinFractions white = sharesOf([](auto& g) { return noisy(g, 0.0, 200); }, 4000);
  EXPECT_LE(white.drifts, 0.06);
  EXPECT_GT(white.notSeen, 0.9);  // 200 samples of 10 ± 1 exclude a quarter
}

TEST(RelativeDrift, CorrelatedNoiseIsNotMistaken) {
  // τ = 9.5: from 20 τ on about 7 % where 5 % are promised, for τ itself comes from the series.
  for (const int length : {190, 475, 1900}) {
    const BinFractions slow = sharesOf([&](auto& g) { return noisy(g, 0.9, length); }, 2000);
    EXPECT_LE(slow.drifts, 0.09) << length;
  }
  // A line's error that takes samples for independent calls most of these a drift.
  std::mt19937_64 generator(5);
  int naive = 0;
  for (int k = 0; k < 200; ++k)
    naive +=
        std::abs(estimateTrend(noisy(generator, 0.9, 475)).change) > 1.96 * std::sqrt(12.0 / 475.0);
  EXPECT_GT(naive, 100);
}

TEST(RelativeDrift, ALineIsFound) {
  // A rise of 4 in noise of 1: the rise's error is √(12/200) = 0.24.
  const BinFractions rising =
      sharesOf([](auto& g) { return tilted(noisy(g, 0.0, 200), 4.0); }, 200);
  EXPECT_GT(rising.drifts, 0.999);
  std::mt19937_64 generator(7);
  const RelativeDrift falls =
      relativeDrift(tilted(noisy(generator, 0.5, 400), -4.0), confidence, limit);
  EXPECT_EQ(falls.verdict, Drift::drifts);
  EXPECT_NEAR(*falls.change, -0.4, *falls.half);
  EXPECT_LT(*falls.half, 0.2);
}

TEST(RelativeDrift, AFallToNothingIsFoundThoughItIsNoLine) {
  // As the outer pressure of the thesis' cell: from 220 to 6 within the averaged time.
  std::vector<double> series;
  for (int t = 0; t < 400; ++t) series.push_back(220.0 * std::exp(-3.6 * t / 399.0));
  const RelativeDrift falls = relativeDrift(series, confidence, limit);
  EXPECT_EQ(falls.verdict, Drift::drifts);
  EXPECT_LT(*falls.change, -1.0);
}

TEST(RelativeDrift, AFallThatEndsEarlyIsFoundThoughMostOfItIsABend) {
  // The same over four rotations: 216 to 11 N/m², with noise of a tenth that is correlated over 3.
  const BinFractions falls = sharesOf(
      [](auto& g) {
        auto series = noisy(g, 0.7, 400);
        for (std::size_t t = 0; t < series.size(); ++t)
          series[t] = (10.0 + 210.0 * std::exp(-6.0 * static_cast<double>(t) / 399.0)) *
                      (1.0 + 0.1 * (series[t] - 10.0));
        return series;
      },
      400);
  EXPECT_GT(falls.drifts, 0.8);  // 85 %; with the bend as scatter alone none was
}

TEST(RelativeDrift, SlowNoiseIsNotTakenForAFall) {
  // Correlated over a fifth and a tenth of the series: it wanders, 9 to 15 % as a line would.
  for (const int length : {98, 195}) {
    const BinFractions slow = sharesOf([&](auto& g) { return noisy(g, 0.95, length); }, 2000);
    EXPECT_LE(slow.drifts, 0.17) << length;
  }
}

TEST(RelativeDrift, TooNoisyOrTooShort_CannotTell_Frozen_NoDrift) {
  const BinFractions wide = sharesOf(
      [](auto& g) {
        auto series = noisy(g, 0.0, 40);
        for (double& x : series) x -= 9.0;  // 1 ± 1: a quarter of it cannot be excluded
        return series;
      },
      400);
  EXPECT_GT(wide.cannotTell, 0.9);
  EXPECT_EQ(wide.notSeen, 0.0);
  // About three correlation times long: whatever it looks like, not "no drift seen".
  const BinFractions brief = sharesOf([](auto& g) { return noisy(g, 0.95, 60); }, 400);
  EXPECT_LT(brief.notSeen, 0.2);
  EXPECT_EQ(relativeDrift(std::vector(5, 1.0), confidence, limit).verdict, Drift::cannotTell);
  EXPECT_FALSE(relativeDrift(std::vector(5, 1.0), confidence, limit).change);
  EXPECT_EQ(relativeDrift({}, confidence, limit).verdict, Drift::cannotTell);
  EXPECT_EQ(relativeDrift(std::vector(50, 0.0), confidence, limit).verdict, Drift::cannotTell);
  const RelativeDrift frozen = relativeDrift(std::vector(100, 2.5), confidence, limit);
  EXPECT_EQ(frozen.verdict, Drift::notSeen);
  EXPECT_EQ(frozen.excluded, 0.0);
}

}  // namespace
}  // namespace crossgrain
