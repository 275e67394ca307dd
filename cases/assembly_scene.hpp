#pragma once

#include "cases/case.hpp"

namespace crossgrain::inline cases {

/// The disks, or spheres, of an assembly's packing: its groups in their order or those of a file,
/// with stream `packing` of the case's seed.
/// @throws BadInput for a case of another dimension, as the next one
template <int D = 2>
DisksOf<D> assemblyDisks(const Case& setup, int packing);

/// Those disks between the assembly's walls, which have moved for so long [s].
template <int D = 2>
SceneOf<D> assemblyScene(const Case& setup, DisksOf<D> disks, double wallTime, double dt);

/// The scene of an assembly case, of packing 0. Disks of its groups in their order, one body per
/// wall group.
/// @throws BadInput for a start that no engine can be blamed for: see checkStart()
template <int D = 2>
SceneOf<D> assemblyScene(const Case& setup);

/// @throws BadInput for a start that no engine can be blamed for: see checkStart()
template <int D>
void checkAssemblyStart(const Case& setup, const SceneOf<D>& scene);

/// All files of its start likewise, before anything runs; each by its name and line.
/// @throws BadInput
template <int D>
void checkStartFiles(const Case& setup);

/// How long an assembly is watched [s].
double assemblyDuration(const Case& setup);

}  // namespace crossgrain::inline cases
