#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "cases/case.hpp"
#include "cases/effect_switch.hpp"
#include "runs/options.hpp"
#include "runs/step_times.hpp"

namespace crossgrain {

/// Why an engine that runs the whole case has nothing to show for that switch: it lacks what would
/// be switched off, cannot do without it, or lacks what takes its place. Empty: it can.
std::string switchRefusal(const Capabilities& can, const Case& setup, const EffectSwitch& off);

/// Runs a Couette case as it is and with each of its effects switched off, on every engine that can
/// do without it and on the case's packings; and times a step of each, one at a time. Everything
/// finished is kept in out/runs at once. @returns results.json of kind "effects"
/// @throws BadInput, UnsupportedScene (an engine named cannot run the case itself), OutputError,
/// Interrupted
nlohmann::json measureEffects(const Case& setup, const RunCommand& command, const TimingPlan& plan);

}  // namespace crossgrain
