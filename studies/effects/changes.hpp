#pragma once

#include <span>
#include <string>

#include "cases/case.hpp"
#include "results/effects.hpp"

namespace crossgrain::inline studies {

/// What switching one thing off changes in the profiles of an engine: switched − whole case, ring
/// by ring, mean over the packings that both have finished. Bars are those of paired differences,
/// sd/√P, or, of one packing, the two runs' own, which say nothing about other packings.
///
/// Fields with a margin in the case (all, if none has one) are judged: their rings are one family
/// of two-sided t tests under Holm's procedure, false alarms held to 1 − confidence, on ratios
/// where the margin is relative. p is adjusted; `resolved` says whether it is significant; low and
/// high are the ends of the interval that this rests on, which leaves out 0 exactly if it is;
/// `smallest` is the change that would just have been. All five are absent with fewer than 4
/// packings. `verdict` holds the change of a field, and of a ring, against its margin, as between
/// engines.
EffectChanges effectChanges(const Case& setup, std::span<const FlowRun> runs,
                            const std::string& engine, const std::string& without);

}  // namespace crossgrain::inline studies
