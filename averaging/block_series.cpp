#include "averaging/block_series.hpp"

#include <algorithm>

namespace crossgrain::inline averaging {

void BlockSeries::add(std::span<const double> sample) {
  for (std::size_t k = 0; k < width_; ++k) partial_[k] += sample[k];
  endSample();
}

void BlockSeries::endSample() {
  if (++inPartial_ < blockLength_) return;
  sums_.insert(sums_.end(), partial_.begin(), partial_.end());
  std::ranges::fill(partial_, 0.0);
  inPartial_ = 0;
  if (blocks() == most_) mergePairs();
}

void BlockSeries::mergePairs() {
  const std::size_t pairs = blocks() / 2;
  for (std::size_t b = 0; b < pairs; ++b)
    for (std::size_t k = 0; k < width_; ++k)
      sums_[b * width_ + k] = sums_[2 * b * width_ + k] + sums_[(2 * b + 1) * width_ + k];
  sums_.resize(pairs * width_);
  blockLength_ *= 2;
}

std::vector<double> BlockSeries::sums() const {
  std::vector<double> result = partial_;
  for (std::size_t b = 0; b < blocks(); ++b)
    for (std::size_t k = 0; k < width_; ++k) result[k] += sums_[b * width_ + k];
  return result;
}

std::vector<double> BlockSeries::means() const {
  std::vector<double> result = sums();
  for (double& mean : result) mean /= static_cast<double>(samples());
  return result;
}

}  // namespace crossgrain::inline averaging
