#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace crossgrain::inline studies {

/// What the text has to know of a snapshot in the file.
struct KeptSnapshot {
  double time;  ///< of positions [s]
  bool spins;
};

/// The XDMF 3 text that describes an HDF5 file of snapshots to ParaView: over time, points with
/// radius, velocity and spin ("disks") and those of the wall disks ("walls").
/// @param file  the HDF5 file's name, as seen from the text's own place
std::string snapshotXdmf(const std::string& file, std::size_t disks, std::size_t wallDisks,
                         const std::vector<KeptSnapshot>& snapshots);

}  // namespace crossgrain::inline studies
