#pragma once

#include "reports/common/report.hpp"
#include "results/compare.hpp"
#include "results/lockstep_text.hpp"

namespace crossgrain::reports {

using results::describe;  // beside those here

/// Plot: lockstep_separation, the difference over time beside what the reference perturbation does.
/// Table: lockstep.csv (docs/results.md).
Report reportOf(const LockstepResults& results);

/// The tables of its page, and how to read them.
Blocks lockstepTables(const LockstepFindings& findings);
List lockstepReading(const LockstepFindings& findings);

/// Whether an engine has the law that it declares: ε_eq as a share of the reference constant.
/// @param row  null: it was not compared with a mirror
OverviewCell lockstepCell(const LockstepRow* row, const LockstepRules& rules, bool isMirror);

/// "one and another follow the laws that they declare; a third was not measured."
std::string leadOf(const LockstepFindings& findings);

}  // namespace crossgrain::reports
