#pragma once

#include "reports/common/view.hpp"
#include "results/lockstep_findings.hpp"

namespace crossgrain::reports {

/// Sets view["lockstep"], what part_lockstep.mustache is filled from.
void addLockstep(Json& view, const LockstepFindings& findings);

}  // namespace crossgrain::reports
