#pragma once

#include <string>

#include "results/diff.hpp"

/// What a diff found, for the command line.
namespace crossgrain::reports {

/// "same bits", "same to rounding", "same law", "differs, like 2.1 % of k_n", "not measured".
std::string verdictInWords(const DiffRow& row, const LockstepRules& rules);

/// All of it, a paragraph for each engine.
std::string diffInWords(const DiffResults& results);

}  // namespace crossgrain::reports
