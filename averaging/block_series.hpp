#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace crossgrain::inline averaging {

/// A long time series of many numbers at a time in bounded memory: sums over blocks of equal
/// length. When all blocks are full, pairs are merged and blocks get twice as long.
///
/// Merging keeps all that the error of a mean needs. Its variance is that of the block means
/// over their number, times twice their correlation time; blocks shorter than the correlation time
/// keep it visible, longer ones are independent, and both give the same error. Samples after the
/// last whole block, less than 1/256 of the series, count in the mean and not in the error. The
/// number of independent samples cannot come out larger than the number of blocks. Of so many
/// numbers that all blocks would take more than `mostNumbers` there are fewer.
class BlockSeries {
 public:
  static constexpr std::size_t mostBlocks = 512, fewestBlocks = 8;
  static constexpr std::size_t mostNumbers = std::size_t{1} << 27;  ///< of all blocks: 1 GB

  /// How many there are at most, a power of two, as they merge in pairs.
  static constexpr std::size_t blocksOf(std::size_t width) {
    std::size_t blocks = mostBlocks;
    while (blocks > fewestBlocks && blocks * width > mostNumbers) blocks /= 2;
    return blocks;
  }

  /// @param width numbers per sample
  explicit BlockSeries(std::size_t width) : BlockSeries(width, blocksOf(width)) {}
  BlockSeries(std::size_t width, std::size_t most)
      : width_(width), most_(most), partial_(width, 0.0) {}

  /// @pre sample has `width` numbers
  void add(std::span<const double> sample);
  /// The same number by number: what is added to a column belongs to the sample that then ends.
  double& now(std::size_t column) { return partial_[column]; }
  void endSample();

  std::size_t samples() const { return blocks() * blockLength_ + inPartial_; }
  std::size_t blocks() const { return width_ == 0 ? 0 : sums_.size() / width_; }
  std::size_t blockLength() const { return blockLength_; }

  /// Sum over one block, and its mean. @pre block < blocks()
  std::span<const double> sums(std::size_t block) const {
    return std::span(sums_).subspan(block * width_, width_);
  }
  double blockMean(std::size_t block, std::size_t column) const {
    return sums_[block * width_ + column] / static_cast<double>(blockLength_);
  }

  /// Sums over all samples, and their means. @pre samples() > 0
  std::vector<double> sums() const;
  std::vector<double> means() const;

 private:
  void mergePairs();

  std::size_t width_, most_;
  std::size_t blockLength_ = 1;
  std::size_t inPartial_ = 0;
  std::vector<double> partial_;
  std::vector<double> sums_;  ///< block by block
};

}  // namespace crossgrain::inline averaging
