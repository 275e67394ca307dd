#pragma once

#include <filesystem>
#include <functional>

namespace crossgrain::inline support {

/// Reads a file that others made for trial, in a process of its own with bounds on memory and time.
/// HDF5 1.10.8 (Debian 12) does not get over every damaged file: it may crash, go round for ever,
/// or take all memory that there is.
/// @param read  what is going to be read of it, by Hdf5File; what it changes is lost
/// @throws BadInput, if it threw or did not come to an end; Interrupted
void tryReading(const std::filesystem::path& file, const std::function<void()>& read);

}  // namespace crossgrain::inline support
