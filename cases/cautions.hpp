#pragma once

#include <string>
#include <vector>

#include "cases/case.hpp"

namespace crossgrain::inline cases {

/// What a case can be expected to do that is hardly meant, one line each: it loads, and it runs.
/// Too few steps in a contact, a gas where a flow was wanted, squeezed disks, a rate that stresses
/// hang on, nothing that could be judged. Estimates: cell_estimates.hpp.
/// @param volumeFraction  of a Couette case's disks, ν̄
std::vector<std::string> cautions(const Case& setup, double volumeFraction);

}  // namespace crossgrain::inline cases
