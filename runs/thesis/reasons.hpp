#pragma once

#include <vector>

#include "cases/claim_reasons.hpp"
#include "cases/thesis_claims.hpp"
#include "results/thesis.hpp"

namespace crossgrain::inline runs {

/// Gives each refuted row of the claims its reasons, as far as they are found:
/// - in which regime its runs were, and how the pressure changed from their first rotation to the
///   last;
/// - where else the figures that refute it lie in their bands, by the same rule: under other
///   readings, of runs in one regime, of one ν̄, at another rate or time (the last three of the
///   default reading alone), of collisions by the law itself and at other time steps;
/// - what somebody found, where all its conditions hold.
/// Rules stay as they are, and so do verdicts. Nothing is run.
void addReasons(const ThesisResults& results, const ClaimRules& rules, const ClaimReasons& found,
                std::vector<ClaimRow>& rows);

}  // namespace crossgrain::inline runs
