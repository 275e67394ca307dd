#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// By what rules the thesis' claims are judged, fixed before the runs are looked at, and reasons
/// that somebody found for refuted ones: cases/couette/thesis/claims.toml and reasons.toml.
namespace crossgrain::inline cases {

/// A number that a rule rests on besides its bands.
struct ClaimNumber {
  std::string name;  ///< "band_to"
  double value = 0.0;
  std::string why;
};

/// A figure that a claim comes to, and where it lies if the thesis is right.
struct ClaimBand {
  std::string name;                 ///< "width"
  std::string label;                ///< "C⁻¹"
  std::string unit;                 ///< empty: a number
  std::optional<double> low, high;  ///< both absent: reported, not judged
  std::string why;
  bool testable =
      true;  ///< false: nothing that is run says whether the thesis is right; `why` has why

  bool judged() const { return low || high; }
};

struct ClaimRule {
  std::string id;      ///< "C7"
  std::string claim;   ///< in one sentence
  std::string rule;    ///< what is measured where, and when that reproduces or refutes the claim
  std::string figure;  ///< of the thesis, "figure 7.14"; empty: none
  /// What the thesis leaves open and may matter to it: "spacing", "mass", "radius", "tension".
  std::vector<std::string> interpretations;
  std::vector<ClaimNumber> numbers;
  std::vector<ClaimBand> figures;  ///< the first one stands for the claim

  /// @throws std::logic_error for a name that the rule has not
  double number(std::string_view name) const;
  const ClaimBand& band(std::string_view name) const;
  bool judgedUnder(std::string_view interpretation) const;
  int judgedFigures() const;  ///< figures that have a band
};

struct ClaimRules {
  std::string text;                 ///< the file, as it is
  std::vector<ClaimNumber> common;  ///< numbers of all rules
  std::vector<ClaimRule> claims;    ///< C1 … C27

  /// @throws std::logic_error for a name that there is not
  double number(std::string_view name) const;
  const ClaimRule& of(std::string_view id) const;
};

/// What judging the claims asks of a file: each claim once, with these numbers and these figures,
/// in the order of reports.
struct ClaimNeeds {
  std::string id;
  std::vector<std::string> numbers, figures;
};
struct ClaimSchema {
  std::vector<std::string> common;
  std::vector<ClaimNeeds> claims;
};

/// Reads the rules, every number and figure with a reason.
/// @param schema  what there must be, and no more; null: whatever there is
/// @throws BadInput  with one line: where, what is there, what would be right
ClaimRules loadClaimRules(const std::filesystem::path& file, const ClaimSchema* schema);
/// The same of a text, that of `ClaimRules::text`. @throws BadInput
ClaimRules claimRulesOf(const std::string& text, const ClaimSchema* schema);

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

/// What judging a run asks of its case; absent is what the text does not say.
struct CaseConstants {
  std::optional<double> largeMass;  ///< of large disks [kg]
  std::optional<double> kt;         ///< [N/m]
};
/// Of a case as it was resolved (CaseHead::toml). @throws BadInput for what is not TOML
CaseConstants caseConstants(const std::string& caseToml);

}  // namespace crossgrain::inline cases
