#pragma once

#include "results/lockstep.hpp"
#include "results/overview.hpp"

namespace crossgrain::reports {

/// Whether an engine has the law that it declares: ε_eq as a share of the reference constant.
/// @param row  null: it was not compared with a mirror
OverviewCell lockstepCell(const LockstepRow* row, const LockstepRules& rules, bool isMirror);

/// What differs only where the law leaves the order of impacts open is borderline.
Verdict lockstepState(const LockstepRow& row, const LockstepRules& rules);

/// An engine per row: its law, forces on one state, differences early and late, the deviation
/// found.
Overview lockstepOverview(const LockstepResults& results);

}  // namespace crossgrain::reports
