#pragma once

#include "stability/recording.hpp"

namespace crossgrain::inline stability {

/// Whether the engine has impulses where the scene has springs, so that a start with overlaps holds
/// no energy there but what it makes of them.
bool hasNoSprings(const Recording& run);

}  // namespace crossgrain::inline stability
