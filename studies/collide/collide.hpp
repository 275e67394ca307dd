#pragma once

#include <vector>

#include "cases/case.hpp"
#include "results/collision.hpp"
#include "studies/core/study.hpp"

namespace crossgrain::inline studies {

struct CollideOptions {
  bool strict = false;
};

/// Two-particle collisions: sweeps of every case and variant of a file, or of all collisions of a
/// folder, against the oracle.
extern const Study<CollideOptions, CollideResults> collideStudy;

/// Runs the sweep of every variant and time step of a collision case on every engine and scores the
/// whole curve against the oracle of the same planar problem. Finished cases are kept in the store
/// at once, and loaded from there.
/// @param variants  one case per variant, from one file or several
/// @throws BadInput, UnsupportedScene, Interrupted
CollideResults collideEngines(const std::vector<Case>& variants, const RunCommand& command,
                              RunStore& store);

}  // namespace crossgrain::inline studies
