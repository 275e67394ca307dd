#pragma once

#include "oracle/collision_oracle.hpp"
#include "tests/support/pairs.hpp"

/// The pair of tests/support/ by the shorter names that tests of runs/ have for it.
namespace crossgrain::test {

inline constexpr double radius = smallRadius;
inline constexpr double mass = smallMass;
inline constexpr double contactTime = smallContactTime;

}  // namespace crossgrain::test

namespace test = crossgrain::test;
