#pragma once

#include <string>

#include "adapters/snapshot.hpp"
#include "cases/case.hpp"

namespace crossgrain::inline runs {

/// What every point past a stability limit begins its reason with: such a failure is a result.
inline constexpr const char* beyondLimit = "beyond its stability limit";

/// Whether a packing has blown up: a position is no number, a disk has left the cell, or the disks'
/// rms speed exceeds ten times the rim's ΩR_i, which nothing in the cell is driven faster than.
/// Says which, after `beyondLimit`; empty if not.
std::string blowUp(const Case& setup, const Snapshot& seen);

/// The smallest step at which a packing may be unstable [s]: 2/ω of a disk held by six others, six
/// times as stiff as a pair (Gershgorin: ω² ≤ 6 · 2 k_n/m).
double packingLimit(const Case& setup);

}  // namespace crossgrain::inline runs
