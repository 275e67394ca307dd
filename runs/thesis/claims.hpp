#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cases/thesis_claims.hpp"
#include "results/collision.hpp"
#include "results/thesis.hpp"
#include "runs/thesis/claims_scope.hpp"

namespace crossgrain::inline runs {

/// What the runs say of each of the thesis' claims, by the rules.
///
/// A row per claim and engine under the default reading: that of the first leg of the family
/// "packings"; and one per further reading that the claim is judged under and that has finished
/// runs. A claim whose runs are missing is *undecided* and says which legs it needs: no claim is
/// left out. Claims of collisions, and of the model, have rows of no engine ("-").
/// Nothing is run: the same results give the same rows.
std::vector<ClaimRow> judgeClaims(const ThesisResults& results, const ClaimRules& rules);

/// One claim for one engine by the runs of one reading. Absent of a claim about collisions.
std::optional<ClaimRow> judgeClaim(const ThesisResults& results, const ClaimRules& rules,
                                   const std::string& id, const std::string& engine,
                                   const std::string& carrier, const Reading& reading);

/// C1 of each engine, by its sweeps of cases/collision/figure-4-3.toml.
/// @param steps  per contact, those next to it; absent: the thesis' own
std::vector<ClaimRow> judgeCollisions(const CollideResults& collisions, const ClaimRules& rules,
                                      std::optional<double> steps = std::nullopt);

}  // namespace crossgrain::inline runs
