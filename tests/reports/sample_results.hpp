#pragma once

#include <filesystem>

#include <nlohmann/json.hpp>

#include "results/collision.hpp"
#include "results/compare.hpp"
#include "results/cost.hpp"
#include "results/effects.hpp"
#include "results/stability.hpp"

/// Made-up results in the layout of docs/results.md, for tests of the report and for looking at
/// its pages: nothing in them was simulated.
namespace crossgrain::sample {

/// Three engines, a mirror, one engine that refused and one run that failed, text that HTML and
/// gnuplot must not take literally, and absent numbers here and there.
CompareResults compareResults(int packings, int disks);

/// Results of `average`: one run of one source, nothing run by crossgrain.
CompareResults averageResults();

/// One field at one radius under two weights, which meet at one diameter.
RevResults revResults();

/// Two laws, several time steps, a sweep without points.
CollideResults collideResults();

/// The same on nine engines, with an answer to every question.
CollideResults manyCollideResults();

/// One engine whose friction changes one ring of one field, whose bottom friction changes nothing,
/// and which refuses a third switch.
EffectsResults effectsResults(int packings);

/// Two hard cases on two engines: every verdict once.
StabilityResults stabilityResults();

/// One engine that is its law, one whose tangential damping is off, one without a mirror.
LockstepResults lockstepResults();

/// Three engines of known order and cost, a scheme that claims an order it does not have, failures
/// past the stability limit, points that the budget did not allow, one engine that refused.
CostResults costResults();

/// Text that users may put into a name or reason.
inline constexpr const char* awkward = "odd <b>\"name\"</b> & `touch pwned` {x 'y' _z";

}  // namespace crossgrain::sample
