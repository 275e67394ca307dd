#pragma once

#include <filesystem>
#include <vector>

namespace crossgrain::inline cases {

/// Engines that come with the program as engine files (engine_file.hpp): engines/FOLDER/*.toml of
/// the data folder, in the order of their paths. One whose program is missing is known all the
/// same, and refused with what there is to install.
std::vector<std::filesystem::path> shelvedEngines();

}  // namespace crossgrain::inline cases
