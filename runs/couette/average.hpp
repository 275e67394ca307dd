#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "cases/case.hpp"

namespace crossgrain::inline runs {

/// Averages the snapshots of an HDF5 file (README.md has its layout) with the rings and methods of
/// a Couette case. Nothing is run: of the case only cell, disks, averaging and the law's constants
/// count; cell and disks must be those of the file.
/// @return results.json, kind "average", of one engine and one packing
/// @throws BadInput naming the file and what does not fit
nlohmann::json averageSnapshots(const Case& setup, const std::filesystem::path& file,
                                const std::string& commandLine);

}  // namespace crossgrain::inline runs
