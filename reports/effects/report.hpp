#pragma once

#include <string>
#include <vector>

#include "reports/common/figure.hpp"
#include "reports/common/pages.hpp"
#include "results/effects.hpp"

namespace crossgrain::reports {

std::string effectsPage(const EffectsResults& results, const Illustrations& shown);

/// Every plot of a study of effects, for each engine k = 1, 2, …: effects_k_cost, what each costs
/// and changes; effects_k_profile_FIELD, with and without.
std::vector<Figure> effectFigures(const EffectsResults& results);

/// engine,effect,time_ratio,field,ring,change,stderr, then r_tilde,reference,unit,resolved,
/// p_adjusted,smallest_resolvable,family_level,packings,stderr_kind,time_ratio_stderr,step_s,
/// contacts_per_step,precision,status,reason
/// One row per field and ring; a variant that has none is one row with its status.
std::string effectsCsv(const EffectsResults& results);

}  // namespace crossgrain::reports
