#pragma once

#include "reports/common/report.hpp"
#include "results/lockstep.hpp"

namespace crossgrain::reports {

/// Plot: lockstep_separation, the difference over time beside what the yardstick's change does.
/// Table: lockstep.csv (docs/results.md).
Report reportOf(const LockstepResults& results);

/// The tables of its page, and how to read them.
Blocks lockstepTables(const LockstepFindings& findings);
List lockstepReading(const LockstepFindings& findings);

}  // namespace crossgrain::reports
