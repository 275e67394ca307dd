#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reports/common/report.hpp"
#include "results/causes.hpp"

/// Causes of differences in words (results/causes.hpp).
namespace crossgrain::reports {

/// Of a difference: a part below it is not named by itself.
inline constexpr double leastNamed = 0.01;

/// A difference and its parts, which add up to it; all in one unit.
struct CauseAccount {
  struct Part {
    std::string name;
    double value = 0.0;
    bool declared = true;
  };
  double whole = 0.0;
  std::vector<Part> parts = {};
  double interaction = 0.0, remainder = 0.0;
  std::string remainderName = {};  ///< empty, with no parts: no cause is shown

  /// Name, as in case files, of the part that makes most of the difference, the remainder's where
  /// that makes more; empty: none does.
  std::string largest() const;
};

/// An option, a constant or an effect as people read it: "dashpot+spring_reset" → "dashpot with
/// spring reset", "mu" → "µ".
std::string termWords(const std::string& name);

/// "spring update 0.139 (not declared), lever arm 0.001, implementation < 0.001": the largest
/// first, what works against the whole with a minus sign, all with the digits of the whole; what is
/// below a hundredth of it together as "others".
std::string accountWords(const CauseAccount& account);

/// "Ψ_f of mine is 0.14 lower than grain's at Ψ_i = 0.35: spring update 0.139, lever arm 0.001,
/// implementation < 0.001 (1 limit = 0.02)"
/// @param what   the quantity, "Ψ_f"
/// @param where  "at Ψ_i = 0.35"; empty: it has no place
/// @param unit   empty: none
/// @param limit  in the unit, and its word: "limit", "margin"
std::string causeSentence(const std::string& what, const std::string& engine,
                          const std::string& reference, const std::string& where,
                          const CauseAccount& account, const std::string& unit,
                          const std::optional<double>& limit, const char* limitIs);

/// "spring update after → before (not declared)"
std::string differenceWords(const CauseName& difference);

/// "mine differs from the law that it declares as if spring update were before, not after. It
/// reports, beside options of the law: rounding." Empty: it does not.
std::string undeclaredSentence(const std::string& engine, const Causes& causes,
                               const std::optional<EffectiveParameters>& effective);

/// Sentences that hold for all numbers of a pair: which interact, how far the path goes, what was
/// not attributed and why. Empty: there is nothing to be said.
std::string causesNote(const Causes& causes);

/// Visits the parts of a difference, then its interaction and remainder: (name, words, value);
/// words are none of the last two. @tparam Own  QuantityCauses or EndpointCauses
template <class Own>
void forParts(const Causes& causes, const Own& own, auto&& visit) {
  for (std::size_t k = 0; k < own.parts.size(); ++k)
    visit(causes.differences[k].name, causes.differences[k], own.parts[k]);
  visit("interaction", CauseName{}, own.interaction);
  visit(causes.remainder, CauseName{}, own.remainder);
}

/// A difference over x and its parts, the last of them what is left.
struct StackedCauses {
  std::string name, xLabel, yLabel;
  Numbers x, whole;
  Numbers error = {};                                       ///< of the whole; empty: none
  std::vector<std::pair<std::string, Numbers>> parts = {};  ///< by name
};

/// Differences as lines, their parts as bands one on the other, a panel each. A part has one
/// colour, what is left is grey.
Figure stackedFigure(const std::string& name, const std::string& title, const std::string& caption,
                     const std::vector<StackedCauses>& all);

/// Options among these differences and what they mean: terms that a reader may not know, with the
/// documents that say more. They are named and not linked to, as a report has no place of its own.
Table causeTerms(const std::vector<const Causes*>& all);

/// To that table's row of a difference; empty: it has none, as constants, effects and remainders.
std::string termLink(const std::string& difference);

}  // namespace crossgrain::reports
