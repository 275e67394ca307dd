#pragma once

#include "results/lockstep.hpp"
#include "results/overview.hpp"

namespace crossgrain::reports {

/// Whether an engine is the law that it declares: ε_eq as a share of the yardstick.
/// @param row  null: nobody held it against a mirror
OverviewCell lockstepCell(const LockstepRow* row, const LockstepRules& rules, bool isMirror);

/// An engine per row; its law, forces on one state, how far it parts, the deviation found.
Overview lockstepOverview(const LockstepResults& results);

}  // namespace crossgrain::reports
