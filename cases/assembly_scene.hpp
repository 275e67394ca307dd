#pragma once

#include "cases/case.hpp"

namespace crossgrain::inline cases {

/// Places on a lattice, in diameters: row by row, from the origin to the right and upward.
/// @param spacing     between columns and between rows
/// @param triangular  odd rows are shifted by half a column
std::vector<Vec2> gridPlaces(int columns, int rows, const Vec2& spacing, bool triangular);

/// A triangle of rows of base, base − 1, … 1 disks, each in the gaps of the one below.
std::vector<Vec2> heapPlaces(int base, double spacing);

/// Places on a lattice in space, in diameters: layer by layer along z, each as gridPlaces() has it.
/// @param spacing      between columns, rows and layers
/// @param closePacked  odd rows are shifted by half a column, and odd layers by half a column and a
///                     third of a row: with spacing (1, √(3/4), √(2/3)) each sphere touches twelve
std::vector<Vec3> latticePlaces(const std::array<int, 3>& counts, const Vec3& spacing,
                                bool closePacked);

/// Places on circles about the z axis, in diameters, layer by layer along z: of radii inner,
/// inner + spacing … up to outer, on each as many as fit at that spacing.
/// @param layers  how many  @param rise  from one to the next
std::vector<Vec3> circlePlaces(double inner, double outer, double spacing, int layers, double rise);

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
