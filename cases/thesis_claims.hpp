#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// By what rules the thesis' claims are judged: cases/couette/thesis/claims.toml, fixed before the
/// runs are looked at.
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
  std::optional<double> low, high;  ///< both absent: told, not judged
  std::string why;

  bool judged() const { return low || high; }
};

struct ClaimRule {
  std::string id;      ///< "C7"
  std::string claim;   ///< in one sentence
  std::string rule;    ///< what is measured where, and when that reproduces or refutes the claim
  std::string figure;  ///< of the thesis, "figure 7.14"; empty: none
  /// What the thesis leaves open and may matter to it: "spacing", "mass", "radius", "tension".
  std::vector<std::string> readings;
  std::vector<ClaimNumber> numbers;
  std::vector<ClaimBand> figures;  ///< the first one stands for the claim

  /// @throws std::logic_error for a name that the rule has not
  double number(std::string_view name) const;
  const ClaimBand& band(std::string_view name) const;
  bool judgedUnder(std::string_view reading) const;
  /// Figures that have a band.
  int judgedFigures() const;
};

struct ClaimRules {
  std::string text;                 ///< the file, as it is
  std::vector<ClaimNumber> common;  ///< numbers of all rules
  std::vector<ClaimRule> claims;    ///< C1 … C27

  /// @throws std::logic_error for a name that there is not
  double number(std::string_view name) const;
  const ClaimRule& of(std::string_view id) const;
};

/// Reads the rules of all claims: each of C1 … C27 once, with all the numbers and figures that its
/// judgement needs and no others, every one of them with a reason.
/// @throws BadInput  with one line: where, what is there, what would be right
ClaimRules loadClaimRules(const std::filesystem::path& file);

/// The same of a text, that of `ClaimRules::text`. @throws BadInput
ClaimRules claimRulesOf(const std::string& text);

/// What judging a leg asks of its case; absent is what the text does not say.
struct LegChoices {
  std::optional<double> largeMass;  ///< of large disks [kg]
  std::optional<double> kt;         ///< [N/m]
};

/// Of a case as it was resolved (CaseHead::toml). @throws BadInput for what is not TOML
LegChoices legChoices(const std::string& caseToml);

}  // namespace crossgrain::inline cases
