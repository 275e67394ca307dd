#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "adapters/vec2.hpp"

namespace crossgrain::conformance {

/// How far a value may be from what it should be: `absolute` or `relative` of the expected value,
/// whichever allows more. `why` is not optional.
struct Tolerance {
  double absolute;
  double relative;
  const char* why;
};

/// Whether two things are the same as far as they should be.
struct Comparison {
  std::string difference;  ///< empty: they are
};

inline Comparison within(double distance, double size, const Tolerance& allowed,
                         const std::string& values) {
  const double limit = std::max(allowed.absolute, allowed.relative * size);
  if (distance <= limit) return {};  // a NaN is not
  return {
      fmt::format("{}, off by {:.3g}, allowed {:.3g} ({})", values, distance, limit, allowed.why)};
}

inline Comparison close(double actual, double expected, const Tolerance& allowed) {
  return within(std::abs(actual - expected), std::abs(expected), allowed,
                fmt::format("{:.8g}, not {:.8g}", actual, expected));
}

inline Comparison close(const Vec2& actual, const Vec2& expected, const Tolerance& allowed) {
  return within((actual - expected).norm(), expected.norm(), allowed,
                fmt::format("({:.8g}, {:.8g}), not ({:.8g}, {:.8g})", actual.x(), actual.y(),
                            expected.x(), expected.y()));
}

}  // namespace crossgrain::conformance
