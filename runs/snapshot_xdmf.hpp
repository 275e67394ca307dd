#pragma once

#include <string>
#include <vector>

#include "adapters/snapshot.hpp"

namespace crossgrain {

/// The XDMF 3 text that describes an HDF5 file of snapshots to ParaView: a temporal collection of
/// points with radius, velocity and spin, and one of the wall disks.
/// @param file  the HDF5 file's name, as seen from the text's own place
std::string snapshotXdmf(const std::string& file, std::size_t wallDisks,
                         const std::vector<Snapshot>& snapshots);

}  // namespace crossgrain
