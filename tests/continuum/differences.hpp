#pragma once

#include <algorithm>
#include <cmath>

#include "continuum/cosserat_solution.hpp"

namespace crossgrain::test {

/// The largest differences of two solutions over ξ.
struct FieldDifferences {
  double stress = 0.0;  ///< of s, q and m
  double flow = 0.0;    ///< of u and ω, relative to their own value at that ξ
};

inline FieldDifferences differences(const CosseratSolution& one, const CosseratSolution& other) {
  FieldDifferences most;
  constexpr int places = 101;
  for (int k = 0; k < places; ++k) {
    const double xi = static_cast<double>(k) / (places - 1);
    const CosseratPoint a = one.at(xi), b = other.at(xi);
    most.stress =
        std::max({most.stress, std::abs(a.s - b.s), std::abs(a.q - b.q), std::abs(a.m - b.m)});
    most.flow = std::max(most.flow, std::abs(a.omega / b.omega - 1.0));
    if (k < places - 1) most.flow = std::max(most.flow, std::abs(a.u / b.u - 1.0));  // u(1) = 0
  }
  return most;
}

}  // namespace crossgrain::test
