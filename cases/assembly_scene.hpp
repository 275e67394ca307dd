#pragma once

#include "cases/case.hpp"

namespace crossgrain {

/// The scene of an assembly case. Disks of its groups in their order, one body per wall group.
/// @throws BadInput for a start that no engine can be blamed for: see checkStart()
Scene assemblyScene(const Case& setup);

/// How long an assembly is watched [s].
double assemblyDuration(const Case& setup);

/// Where a point of an assembly's scene would be at time t, were it not mirrored, turned, shifted
/// and boosted [m].
Vec2 undoneAt(const Assembly& assembly, const Vec2& position, double t);

}  // namespace crossgrain
