#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "cases/case.hpp"

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

/// Radii up to 1 : 10, masses up to 1 : 1000, factors q of the inertia from 0.4 to 0.5.
inline void drawPair(Draw& draw, Collision& to) {
  to.radius[0] = 1e-3 * draw.logarithmic(1.0, 10.0);
  to.radius[1] = 1e-3 * draw.logarithmic(1.0, 10.0);
  to.mass[0] = 1e-4;
  to.mass[1] = 1e-4 * draw.logarithmic(1.0, 1000.0);
  to.inertiaFactor = draw.uniform(0.4, 0.5);
}

}  // namespace crossgrain::test
