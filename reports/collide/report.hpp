#pragma once

#include <string>
#include <vector>

#include "reports/collide/table.hpp"
#include "reports/common/report.hpp"

namespace crossgrain::reports {

/// Table: collisions.csv, one row per collision; a sweep without any is one row with its status,
/// its reason and no numbers. Checks: one for each sweep and quantity that the case has a limit
/// for.
Report reportOf(const CollideResults& results);

/// An engine per row, a group of quantities per column: the largest error as a share of its limit;
/// and who passes, what causes differences, what is next.
Overview collideOverview(const CollideResults& results);

/// collision_1, collision_2, … in the order of the cases, each with its collision_1_energy.
std::vector<Figure> collideFigures(const CollideResults& results);

/// "✗ 3 of 4": how an engine's sweeps in some variants came out.
Verdict stateOf(const Tally& tally);
/// "4 of 24 passed", "refused"
std::string headline(const Tally& tally);

/// The tables of one case: a row per variant; per variant and mirror; per engine and time step.
Table variantTable(const CollideResults& results, const CaseGroup& group);
Table mirrorTable(const CaseGroup& group, const std::vector<EngineRow>& engines);
Table scoreTable(const CaseGroup& group);

}  // namespace crossgrain::reports
