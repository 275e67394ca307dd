#pragma once

#include "cases/case.hpp"
#include "studies/flow/snapshot_file.hpp"

namespace crossgrain::inline studies {

/// Snapshots of one cell averaged with the rings of another give numbers without meaning. Held
/// against the case are what the file says of disks (how many of each radius, their masses; not
/// where the case takes them from a packing file), wall disks (how many, radius, distance from the
/// axis), the wheel's rate and where the disks' centres are. What the file does not hold is not
/// asked for.
/// @throws BadInput naming the file and all that does not fit, in one line
void requireFit(const SnapshotReader& reader, const Case& setup);

/// Every snapshot of the file can be true of its disks (adapters/audit.hpp), as far as a file says:
/// not its time step, nor how walls were to move, and its numbers may be of single precision.
/// @throws BadInput naming the file, the snapshot and what cannot be
void requireSound(const SnapshotReader& reader, const Case& setup);

}  // namespace crossgrain::inline studies
