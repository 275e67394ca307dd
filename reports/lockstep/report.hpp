#pragma once

#include <string>
#include <vector>

#include "reports/common/figure.hpp"
#include "reports/common/pages.hpp"
#include "results/lockstep.hpp"

namespace crossgrain::reports {

std::string lockstepPage(const LockstepResults& results, const Illustrations& shown);

/// lockstep_separation: separation over time, each engine beside what the yardstick's change does.
std::vector<Figure> lockstepFigures(const LockstepResults& results);

/// engine,verdict,equivalent,time_s,median_d,largest_d,yardstick_d,equivalent_then,starts,sticking,
/// sliding,new,opening,wall,first_after_s,first_until_s,first_disk,first_partner,first_contact,
/// forces_missing,forces_extra,normal_force_difference,tangential_force_difference,term,
/// term_amount,term_unexplained,reason,wall_s,equivalent_low,equivalent_high,read,beyond,share_high
/// One row for each engine and time; an engine that was not measured is one row.
std::string lockstepCsv(const LockstepResults& results);

}  // namespace crossgrain::reports
