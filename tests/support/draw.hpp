#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

namespace crossgrain::test {

/// Draws of the same bits everywhere: the standard's distributions may differ between libraries.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : bits_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(bits_() >> 11) * 0x1p-53);
  }
  double logarithmic(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  template <class T, std::size_t N>
  T oneOf(const T (&values)[N]) {
    return values[bits_() % N];
  }

 private:
  std::mt19937_64 bits_;
};

}  // namespace crossgrain::test
