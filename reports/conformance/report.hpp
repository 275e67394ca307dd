#pragma once

#include <string>

#include "reports/common/report.hpp"
#include "results/conformance.hpp"

/// Report for the author of an engine.
namespace crossgrain::reports {

Report reportOf(const ConformanceResults& results);

/// "mine (1): 38 of 39 checks passed, 1 failed, 2 skipped; 3 of 40 declared capabilities (8 %) not
/// examined."
std::string conformanceLead(const ConformanceResults& results);

/// "not examined: warm hand-over; setting dt, other than its default"; empty: everything was.
std::string conformanceNotExamined(const ConformanceResults& results);

/// "most likely: µ −30 %, …"; empty where nothing failed.
std::string conformanceCause(const ConformanceResults& results);

/// "failed: HeadOnCollision (two disks head on: …): e_n: 0.31, not 0.34, … (and 3 more)"
std::string conformanceSentence(const ConformanceRow& row);

}  // namespace crossgrain::reports
