#include "averaging/block_series.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "averaging/statistics.hpp"

namespace crossgrain {
namespace {

BlockSeries filled(const std::vector<double>& series) {
  BlockSeries blocks(1);
  for (const double x : series) blocks.add(std::span(&x, 1));
  return blocks;
}

std::vector<double> meansOf(const BlockSeries& blocks) {
  std::vector<double> means;
  for (std::size_t b = 0; b < blocks.blocks(); ++b) means.push_back(blocks.blockMean(b, 0));
  return means;
}

/// x_t = ρ x_{t−1} + noise, τ = ½ (1 + ρ)/(1 − ρ)
std::vector<double> correlated(double rho, std::size_t length, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  std::vector<double> series{normal(generator)};
  while (series.size() < length)
    series.push_back(rho * series.back() + std::sqrt(1.0 - rho * rho) * normal(generator));
  return series;
}

TEST(BlockSeries, MergesPairsAndKeepsTheMean) {
  BlockSeries blocks(2);
  constexpr int samples = 2000;
  for (int t = 0; t < samples; ++t) {
    const double sample[] = {static_cast<double>(t), 1.0};
    blocks.add(sample);
    EXPECT_LT(blocks.blocks(), BlockSeries::mostBlocks);
    EXPECT_EQ(blocks.samples(), static_cast<std::size_t>(t) + 1);
  }
  EXPECT_EQ(blocks.blockLength(), 4u);  // merged at 512 and 1024 samples
  EXPECT_EQ(blocks.blocks(), 500u);
  EXPECT_DOUBLE_EQ(blocks.blockMean(2, 0), 9.5);  // 8, 9, 10, 11
  EXPECT_DOUBLE_EQ(blocks.means()[0], (samples - 1) / 2.0);
  EXPECT_DOUBLE_EQ(blocks.means()[1], 1.0);
}

TEST(BlockSeries, ManyNumbers_HaveFewerBlocks_SoThatTheyHaveRoom) {
  EXPECT_EQ(BlockSeries::blocksOf(1), BlockSeries::mostBlocks);
  EXPECT_EQ(BlockSeries::blocksOf(6 * 60), BlockSeries::mostBlocks);  // of a cell's rings
  EXPECT_EQ(BlockSeries::blocksOf(std::size_t{1} << 20), 128u);       // 2²⁷ numbers in all
  // A million bins, the most that a case may have, of some forty moments: not 160 GB.
  EXPECT_EQ(BlockSeries::blocksOf(40'000'000), BlockSeries::fewestBlocks);
}

TEST(BlockSeries, ShortSeriesAreKeptSampleBySample) {
  const auto series = correlated(0.5, 511, 1);
  EXPECT_EQ(meansOf(filled(series)), series);
}

TEST(BlockSeries, ErrorsOfTheMeanSurviveTheMerging) {
  // Long series of correlation times from ½ to 100 samples. The error from blocks against the one
  // from all samples: both scatter by some 10 %, so the mean ratio of 20 series is good to 5 %.
  for (const double rho : {0.0, 0.9, 0.99}) {
    double ratio = 0.0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const auto series = correlated(rho, 50'000, seed);
      const MeanEstimate whole = estimateMean(series);
      const MeanEstimate blocked = estimateMean(meansOf(filled(series)));
      ratio += *blocked.standardError / *whole.standardError / 20.0;
    }
    EXPECT_NEAR(ratio, 1.0, 0.05) << rho;
  }
}

}  // namespace
}  // namespace crossgrain
