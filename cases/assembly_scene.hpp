#pragma once

#include "cases/case.hpp"

namespace crossgrain::inline cases {

/// The disks of an assembly's packing: its groups in their order or those of a file, with stream
/// `packing` of the case's seed.
Disks assemblyDisks(const Case& setup, int packing);

/// Those disks between the assembly's walls, which have moved for so long [s].
Scene assemblyScene(const Case& setup, Disks disks, double wallTime, double dt);

/// The scene of an assembly case, of packing 0. Disks of its groups in their order, one body per
/// wall group.
/// @throws BadInput for a start that no engine can be blamed for: see checkStart()
Scene assemblyScene(const Case& setup);

/// @throws BadInput for a start that no engine can be blamed for: see checkStart()
void checkAssemblyStart(const Case& setup, const Scene& scene);

/// All files of its start likewise, before anything runs; each by its name and line.
/// @throws BadInput
void checkStartFiles(const Case& setup);

/// How long an assembly is watched [s].
double assemblyDuration(const Case& setup);

}  // namespace crossgrain::inline cases
