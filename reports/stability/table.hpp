#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "results/stability.hpp"

/// Looking into the results of hard cases.
namespace crossgrain::reports {

/// How a verdict is shown everywhere.
struct VerdictStyle {
  std::string_view mark, cssClass, colour;
};
constexpr VerdictStyle styleOf(StabilityVerdict verdict) {
  constexpr std::array styles = {VerdictStyle{"○", "undecided", "#f2f4f5"},  // not run
                                 VerdictStyle{"–", "undecided", "#d5d9dd"},  // refused
                                 VerdictStyle{"✓", "agree", "#8cc3e0"},
                                 VerdictStyle{"~", "degraded", "#f0d264"},
                                 VerdictStyle{"✗", "disagree", "#d55e00"}};
  return styles[static_cast<std::size_t>(verdict)];
}

/// "✓ stable"
std::string inWords(StabilityVerdict verdict);

/// All variants of one hard case.
struct HardGroup {
  std::string name;
  std::vector<const HardCase*> variants;  ///< of the results
};
std::vector<HardGroup> hardGroups(const StabilityResults& results);

/// As a number to be shown.
inline std::optional<double> stepOf(const StabilityRun& run) {
  return run.step ? std::optional(static_cast<double>(*run.step)) : std::nullopt;
}

/// The run of that engine on that variant, or null.
const StabilityRun* runOf(const StabilityResults& results, const std::string& engine,
                          const HardCase& variant);

/// By verdict, then by value/limit.
bool isWorse(const StabilityRun& run, const StabilityRun& than);

/// Its worst run in a case; null without one.
const StabilityRun* worstRun(const StabilityResults& results, const std::string& engine,
                             const HardGroup& group);

}  // namespace crossgrain::reports
