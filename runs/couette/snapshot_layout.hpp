#pragma once

#include <cstddef>
#include <string>

namespace crossgrain::inline runs {

/// "/snapshot-NNN", counted from 0: the group of a snapshot in an HDF5 file.
std::string snapshotGroup(std::size_t k);

}  // namespace crossgrain::inline runs
