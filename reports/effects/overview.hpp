#pragma once

#include "results/effects.hpp"
#include "results/overview.hpp"

namespace crossgrain::reports {

/// An effect per row; for each engine what a step without it saves, and what that changes most.
Overview effectsOverview(const EffectsResults& results);

}  // namespace crossgrain::reports
