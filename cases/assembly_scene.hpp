#pragma once

#include "cases/case.hpp"

namespace crossgrain::inline cases {

/// The scene of an assembly case. Disks of its groups in their order, one body per wall group.
/// @throws BadInput for a start that no engine can be blamed for: see checkStart()
Scene assemblyScene(const Case& setup);

/// How long an assembly is watched [s].
double assemblyDuration(const Case& setup);

}  // namespace crossgrain::inline cases
