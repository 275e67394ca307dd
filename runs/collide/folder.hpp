#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cases/case.hpp"
#include "results/head.hpp"

namespace crossgrain::inline runs {

/// Every collision of a folder's case files (*.toml), by file name; cases of other kinds are left
/// out.
/// @throws BadInput for a file that cannot be read, two cases of one name, and a folder without any
std::vector<Case> collisionsOf(const std::filesystem::path& folder,
                               const std::vector<std::string>& overrides);

/// What a folder's cases are together.
CaseHead headOfFolder(const std::filesystem::path& folder, const std::vector<Case>& variants);

}  // namespace crossgrain::inline runs
