#pragma once

#include <string>

#include "reports/common/overview.hpp"
#include "results/regression.hpp"

/// Results of diff and replay, for the command line.
namespace crossgrain::reports {

/// "same bits", "same to rounding", "same law", "differs, like 2.1 % of k_n", "not measured".
std::string describe(const DiffRow& row, const LockstepRules& rules);

/// All of it, a paragraph for each engine.
std::string diffText(const DiffResults& results);

/// Engines × (windows, collisions, averages, declared), and what follows.
Overview diffOverview(const DiffResults& results);

std::string replayText(const ReplayResults& results);

}  // namespace crossgrain::reports
