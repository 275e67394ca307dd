#pragma once

#include <span>
#include <string>

#include "cases/case.hpp"
#include "cases/effect_switch.hpp"
#include "results/effects.hpp"
#include "studies/core/study.hpp"
#include "studies/effects/step_times.hpp"

namespace crossgrain::inline studies {

/// Why an engine that runs the whole case has nothing to show for that switch: it lacks what would
/// be switched off, cannot do without it, or lacks what takes its place. Empty: it can.
std::string switchRefusal(const Capabilities& can, const Case& setup, const EffectSwitch& off);

struct EffectsOptions {};

/// Runs a case as it is and with each of its effects switched off, on every engine that can
/// do without it and on the case's packings; and times a step of each, one at a time. Everything
/// finished is kept in the store at once.
/// @throws BadInput, UnsupportedScene (an engine named cannot run the case itself), OutputError,
/// Interrupted
extern const Study<EffectsOptions, EffectsResults> effectsStudy;

/// Changes by one thing switched off in the profiles of an engine: switched − whole case, ring
/// by ring, mean over the packings that both have finished. Bars are those of paired differences,
/// sd/√P, or, of one packing, the two runs' own, which say nothing about other packings.
///
/// Fields with a margin in the case (all, if none has one) are judged: their rings are one family
/// of two-sided t tests under Holm's procedure, false alarms held to 1 − confidence, on ratios
/// where the margin is relative. p is adjusted; `resolved` says whether it is significant; low and
/// high are the ends of the interval that this rests on, which leaves out 0 exactly if it is;
/// `smallest` is the change that would just have been. All five are absent with fewer than 4
/// packings. `verdict` holds the change of a field, and of a ring, against its margin, as between
/// engines; so do the rows of endpoints, which are a family of their own.
EffectChanges effectChanges(const Case& setup, std::span<const FlowRun> runs,
                            const std::string& engine, const std::string& without);

}  // namespace crossgrain::inline studies
