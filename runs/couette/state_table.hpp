#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "runs/couette/agreement_table.hpp"

namespace crossgrain::inline runs {

/// results.json's "regimes": for every pair the packings that both have a regime for, and those on
/// which it is not the same: {a, b, kind, packings, differ: [index]}. Asked before any mean is
/// taken: a difference of means over different regimes says nothing of either.
nlohmann::json regimesOf(const nlohmann::json& runs, const std::vector<ComparedPair>& pairs);

/// results.json's "steadiness": per engine and watched series {engine, quantity, verdict, change,
/// half_width, excluded, packings, drifting: [index of runs that drift by themselves]}.
///
/// From 4 packings on the packing is a random effect: the mean of the runs' changes, with Student's
/// t over packings, which needs no model of a run's own noise. Its level is shared out over the
/// watched series (Bonferroni), so that a steady engine is called drifting in at most 1 −
/// confidence of reports. With fewer packings all runs must say the same, each by its own interval;
/// else it cannot be told.
nlohmann::json steadinessOf(const nlohmann::json& runs, const std::vector<std::string>& engines,
                            double confidence);

}  // namespace crossgrain::inline runs
