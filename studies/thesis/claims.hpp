#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cases/thesis_claims.hpp"
#include "results/thesis.hpp"
#include "studies/thesis/claim_evidence.hpp"

namespace crossgrain::inline studies {

/// What a file of rules has to have: the numbers and figures of each claim's judgement.
const ClaimSchema& claimSchema();

/// What the runs and collisions say of each of the thesis' claims, by the rules.
///
/// A row per claim and engine under the default interpretation: that of the first case of the
/// family "packings"; and one per further interpretation that the claim is judged under and that
/// has finished runs. A claim whose runs are missing is *undecided* and says which cases it needs:
/// no claim is left out. Claims of the law, and of collisions, have rows of no engine ("-"); then
/// come those of each engine that collided. Nothing is run: the same results give the same rows.
std::vector<ClaimRow> judgeClaims(const ThesisResults& results, const ClaimRules& rules);

/// One claim for one engine by the runs of one interpretation. Absent of a claim about collisions.
std::optional<ClaimRow> judgeClaim(const ThesisResults& results, const ClaimRules& rules,
                                   const std::string& id, const std::string& engine,
                                   const std::string& mirror, const Interpretation& interpretation);

/// C1 and C2 of the law itself, which the reference case has. Rows of no engine.
std::vector<ClaimRow> judgeLaw(const ThesisResults& results, const ClaimRules& rules);

/// C1 of each engine, by its sweeps of cases/collision/figure-4-3.toml.
/// @param steps  per contact, those next to it; absent: the thesis' own
std::vector<ClaimRow> judgeCollisions(const CollideResults& collisions, const ClaimRules& rules,
                                      std::optional<double> steps = std::nullopt);

/// Gives each refuted row of the claims its reasons, as far as they are found:
/// - in which regime its runs were, and how the pressure changed from their first rotation to the
///   last;
/// - where else the figures that refute it lie in their bands, by the same rule: under other
///   interpretations, of runs in one regime, of one ν̄, at another rate or time (the last three of
///   the default alone), of collisions by the law itself and at other time steps;
/// - what somebody found, where all its conditions hold.
/// Rules stay as they are, and so do verdicts. Nothing is run.
void addReasons(const ThesisResults& results, const ClaimRules& rules, const ClaimReasons& found,
                std::vector<ClaimRow>& rows);

}  // namespace crossgrain::inline studies
