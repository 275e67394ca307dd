#pragma once

#include <cstddef>
#include <vector>

#include "adapters/files/file_snapshots.hpp"

/// Particles of a file that are wall disks of the case: nobody but their place says so.
namespace crossgrain::files {

/// Their rows: of all of the case's wall disks in their order, or of none. Those of an assembly are
/// found by the place that the case prescribes at time t [s], or an image of it; those of a cell,
/// which may be at any angle, by their radius and their distance from the centre, and the target's
/// reference places become what follows from theirs.
/// @throws BadInput where some of them are there and others are not
template <int D>
std::vector<std::size_t> wallRows(const FileFrame& frame, const FileUnits& units,
                                  FileSceneOf<D>& target, double t);

}  // namespace crossgrain::files
