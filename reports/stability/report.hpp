#pragma once

#include <vector>

#include "reports/common/report.hpp"
#include "results/stability.hpp"

namespace crossgrain::reports {

/// Table: stability.csv, one row per engine, case and variant. Checks: one for each engine and hard
/// case; unstable ones failed, engines that broke down are errors, what was refused is skipped.
Report reportOf(const StabilityResults& results);

/// An engine per row, a family of hard cases per column: runs that stayed stable, of those judged.
Overview stabilityOverview(const StabilityResults& results);

/// stability_map, the verdicts of all; stability_CASE, the measure over time where an engine
/// passed its limit.
std::vector<Figure> stabilityFigures(const StabilityResults& results);

/// The worst moment of every run that is unstable, with its forces.
std::vector<Picture> stabilityPictures(const StabilityResults& results);

}  // namespace crossgrain::reports
