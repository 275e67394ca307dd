#pragma once

#include <span>
#include <string_view>

#include "cases/case.hpp"

namespace crossgrain::inline cases {

/// A quantity of a Couette case itself. What a case file gives as a share of one still fits where
/// the case is extended to another wheel, rate or disk.
struct Scale {
  std::string_view name;     ///< as in the case file
  std::string_view unit;     ///< as fields of profiles.csv have it
  std::string_view meaning;  ///< in symbols
  double (*of)(const Case& setup);
};

std::span<const Scale> scales();

/// A share of a scale, rounded to two digits: a margin is a choice, further digits would claim to
/// know better.
double fractionOf(const Scale& scale, double share, const Case& setup);

}  // namespace crossgrain::inline cases
