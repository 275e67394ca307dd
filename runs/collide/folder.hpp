#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cases/case.hpp"

namespace crossgrain::inline runs {

/// Every collision of a folder's case files (*.toml), by file name; cases of other kinds are left
/// out.
/// @throws BadInput for a file that cannot be read, two cases of one name, and a folder without any
std::vector<Case> collisionsOf(const std::filesystem::path& folder,
                               const std::vector<std::string>& overrides);

/// Puts in place of the first case in results.json what a folder's cases are together.
void describeFolder(nlohmann::json& results, const std::filesystem::path& folder,
                    const std::vector<Case>& variants);

}  // namespace crossgrain::inline runs
