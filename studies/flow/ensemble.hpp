#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "results/run.hpp"
#include "studies/flow/paired_runs.hpp"

/// Means of the runs of engines, over packings.
namespace crossgrain::inline studies {

/// The mean over packings of every profile, distribution, fit and head number of an engine's
/// finished runs with that switched off, with sd/√P as error; absent without a finished run.
std::optional<CouetteEnsemble> ensembleOf(std::span<const FlowRun> runs, const std::string& engine,
                                          const std::string& without);

/// Of those engines that finished a run of the case as it is.
std::vector<CouetteEnsemble> ensembleOf(std::span<const FlowRun> runs,
                                        const std::vector<std::string>& engines);

/// Of every pair that has any packing that both have a regime for. Asked before any mean is taken:
/// a difference of means over different regimes says nothing of either.
/// @param surrogates  who is evaluated through a mirror
std::vector<RegimesOfPair> regimesOf(std::span<const FlowRun> runs,
                                     const std::vector<ComparedPair>& pairs,
                                     const std::vector<SurrogateEngine>& surrogates = {});

/// Per engine and watched series.
///
/// From 4 packings on the packing is a random effect: the mean of the runs' changes, with Student's
/// t over packings, which needs no model of a run's own noise. Its level is shared out over the
/// watched series (Bonferroni), so that a steady engine is called drifting in at most 1 −
/// confidence of reports. With fewer packings all runs must say the same, each by its own interval;
/// else it is not known.
std::vector<EngineDrift> steadinessOf(std::span<const FlowRun> runs,
                                      const std::vector<std::string>& engines, double confidence);

}  // namespace crossgrain::inline studies
