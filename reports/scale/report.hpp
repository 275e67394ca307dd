#pragma once

#include <string>

#include "reports/common/report.hpp"
#include "results/scale.hpp"

namespace crossgrain::reports {

/// Plots: scale_time, ns per disk and step against disks, a curve for each engine and number of
/// workers; scale_efficiency, strong and weak; scale_memory, bytes per disk. Table: scale.csv.
Report reportOf(const ScaleResults& results);

/// An engine per row: on the largest cell that it ran the time for a disk, what sharing is worth,
/// and how much memory it needs.
Overview scaleOverview(const ScaleResults& results);

/// A row per engine, size and number of workers for the terminal; what is absent is a dash.
std::string scaleText(const ScaleResults& results);

}  // namespace crossgrain::reports
