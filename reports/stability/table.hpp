#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/overview.hpp"
#include "results/stability.hpp"

/// Looking into the results of hard cases.
namespace crossgrain::reports {

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

/// Whether these are transformed cases (studies/stability/transforms.hpp), not hard ones.
bool areTransforms(const StabilityResults& results);

}  // namespace crossgrain::reports
