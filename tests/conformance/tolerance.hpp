#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adapters/vec2.hpp"

namespace crossgrain::test {

/// How far a value may be from what it should be: `absolute` or `relative` of the expected value,
/// whichever allows more. `why` is not optional.
struct Tolerance {
  double absolute;
  double relative;
  const char* why;
};

inline testing::AssertionResult within(double distance, double size, const Tolerance& allowed,
                                       const std::string& values) {
  const double limit = std::max(allowed.absolute, allowed.relative * size);
  if (distance <= limit) return testing::AssertionSuccess();  // a NaN is not
  return testing::AssertionFailure()
         << values
         << fmt::format(": off by {:.3g}, allowed are {:.3g} ({})", distance, limit, allowed.why);
}

inline testing::AssertionResult close(double actual, double expected, const Tolerance& allowed) {
  return within(std::abs(actual - expected), std::abs(expected), allowed,
                fmt::format("{:.17g} instead of {:.17g}", actual, expected));
}

inline testing::AssertionResult close(const Vec2& actual, const Vec2& expected,
                                      const Tolerance& allowed) {
  return within((actual - expected).norm(), expected.norm(), allowed,
                fmt::format("({:.17g}, {:.17g}) instead of ({:.17g}, {:.17g})", actual.x(),
                            actual.y(), expected.x(), expected.y()));
}

}  // namespace crossgrain::test
