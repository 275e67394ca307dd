#pragma once

#include <string>
#include <vector>

#include "reports/common/figure.hpp"
#include "reports/common/pages.hpp"
#include "reports/common/pictures.hpp"
#include "results/stability.hpp"

/// What is written of hard cases.
namespace crossgrain::reports {

/// engine,case,verdict,measure,value,limit,unit,step,reason, then degraded_limit,variant,time_s
/// One row per engine, case and variant; step and time are those at which the limit was passed
/// first, or an engine that failed was seen last. The contract of reports/common/csv.hpp.
std::string stabilityCsv(const StabilityResults& results);

/// JUnit: a test for each engine and hard case: unstable ones failed; engines that broke down are
/// errors; what was refused is skipped.
std::string stabilityJunit(const StabilityResults& results);

/// stability_map, the verdicts of all; stability_CASE, the figure of a case over time where an
/// engine did not keep to its limit.
std::vector<Figure> stabilityFigures(const StabilityResults& results);

/// The worst moment of every run that is unstable, with its forces.
std::vector<Picture> stabilityPictures(const StabilityResults& results);

std::string stabilityPage(const StabilityResults& results, const Illustrations& shown);

}  // namespace crossgrain::reports
