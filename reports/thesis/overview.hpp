#pragma once

#include "results/overview.hpp"
#include "results/thesis.hpp"

namespace crossgrain::reports {

/// Engines × claims: how each claim came out under its first reading, as claimCounts() has it, with
/// the figure that this rests on.
Overview thesisOverview(const ThesisResults& results);

}  // namespace crossgrain::reports
