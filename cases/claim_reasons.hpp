#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/thesis_claims.hpp"

/// Reasons that somebody found for refuted claims: cases/couette/thesis/reasons.toml.
namespace crossgrain::inline cases {

/// What must be true of a figure for a reason to hold.
struct ReasonCondition {
  std::string claim;   ///< "C4"; the reason's own where the file does not say
  std::string figure;  ///< by the rule's name: "pressure_late"
  std::optional<double> above, below;
};

struct ClaimReason {
  std::string claim;                  ///< "C26"
  std::string engine;                 ///< empty: any
  std::vector<ReasonCondition> when;  ///< all of them; never empty
  std::string text;                   ///< a sentence
  std::string evidence;               ///< what it rests on: "figure 7.14, history.csv"
};

struct ClaimReasons {
  std::string text;  ///< the file, as it is
  std::vector<ClaimReason> reasons;
};

/// @param rules  whose claims and figures the file may name
/// @throws BadInput  with one line: where, what is there, what would be right
ClaimReasons loadClaimReasons(const std::filesystem::path& file, const ClaimRules& rules);

/// The same of a text; none of an empty one. @throws BadInput
ClaimReasons claimReasonsOf(const std::string& text, const ClaimRules& rules);

}  // namespace crossgrain::inline cases
