#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/common/report.hpp"
#include "results/stability.hpp"

namespace crossgrain::reports {

/// Table: stability.csv, one row per engine, case and variant. Checks: one for each engine and hard
/// case; unstable ones failed, engines that broke down are errors, what was refused is skipped.
Report reportOf(const StabilityResults& results);

/// stability_map, the verdicts of all; stability_CASE, the measure over time where an engine
/// passed its limit.
std::vector<Figure> stabilityFigures(const StabilityResults& results);

/// The worst moment of every run that is unstable, with its forces.
std::vector<Picture> stabilityPictures(const StabilityResults& results);

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

/// Its worst run in a case; null without one.
const StabilityRun* worstRun(const StabilityResults& results, const std::string& engine,
                             const HardGroup& group);

}  // namespace crossgrain::reports
