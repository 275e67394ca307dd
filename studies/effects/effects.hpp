#pragma once

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

/// Runs a Couette case as it is and with each of its effects switched off, on every engine that can
/// do without it and on the case's packings; and times a step of each, one at a time. Everything
/// finished is kept in the store at once.
/// @throws BadInput, UnsupportedScene (an engine named cannot run the case itself), OutputError,
/// Interrupted
extern const Study<EffectsOptions, EffectsResults> effectsStudy;

}  // namespace crossgrain::inline studies
