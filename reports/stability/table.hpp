#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "reports/common/json_view.hpp"

/// Looking into the results of hard cases.
namespace crossgrain::reports {

/// A verdict and how it is shown everywhere.
struct VerdictLook {
  std::string_view name, mark, cssClass, colour;
};

/// From best to worst; "refused" is none of them: nothing was judged.
inline constexpr std::array verdictLooks = {VerdictLook{"refused", "–", "undecided", "#d5d9dd"},
                                            VerdictLook{"stable", "✓", "agree", "#8cc3e0"},
                                            VerdictLook{"degraded", "~", "degraded", "#f0d264"},
                                            VerdictLook{"unstable", "✗", "disagree", "#d55e00"}};

/// Its place in verdictLooks; unknown words are at the first.
std::size_t verdictRank(std::string_view verdict);

/// All variants of one hard case.
struct HardGroup {
  std::string name;
  std::vector<const Json*> variants;  ///< entries of results["cases"]
};
std::vector<HardGroup> hardGroups(const Json& results);

/// The run of that engine on that variant, or null.
const Json& runOf(const Json& results, const std::string& engine, const Json& variant);

/// Its worst run in a case, by verdict and then by value/limit; null without one.
const Json& worstRun(const Json& results, const std::string& engine, const HardGroup& group);

}  // namespace crossgrain::reports
