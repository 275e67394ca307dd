#pragma once

#include <vector>

#include "reports/common/report.hpp"
#include "results/effects.hpp"

namespace crossgrain::reports {

/// Table: effects.csv, one row per field and ring; a variant without any is one row with its
/// status.
Report reportOf(const EffectsResults& results);

/// An effect per row; for each engine what a step without it saves, and what that changes most.
Overview effectsOverview(const EffectsResults& results);

/// For each engine k = 1, 2, …: effects_k_cost, what each effect costs and changes;
/// effects_k_profile_FIELD, with and without.
std::vector<Figure> effectFigures(const EffectsResults& results);

}  // namespace crossgrain::reports
