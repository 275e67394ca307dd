#pragma once

#include "runs/conformance/thesis_numbers.hpp"

namespace crossgrain::test {
using namespace crossgrain::conformance;

/// Table 3.2: the global volume fraction, and numbers of disks.
struct TableRow {
  double nu;
  int small, large;
};
inline constexpr TableRow table32[] = {{0.789, 2462, 404}, {0.791, 2469, 405}, {0.793, 2476, 406},
                                       {0.796, 2483, 407}, {0.798, 2490, 408}, {0.800, 2498, 409},
                                       {0.800, 2511, 400}, {0.802, 2520, 399}, {0.804, 2511, 410},
                                       {0.805, 2524, 404}, {0.807, 2518, 412}, {0.807, 2545, 394},
                                       {0.809, 2525, 414}, {0.810, 2538, 407}, {0.811, 2555, 399},
                                       {0.819, 2560, 418}, {0.828, 2588, 422}};

}  // namespace crossgrain::test
