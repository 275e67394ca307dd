#pragma once

#include <filesystem>
#include <vector>

#include "cases/case.hpp"

namespace crossgrain {

/// The case files (*.toml) of a folder, sorted. @throws BadInput if there is none
std::vector<std::filesystem::path> caseFilesIn(const std::filesystem::path& folder);

/// Reports tell cases by their names. @throws BadInput for a name that two files have
void requireOwnNames(const std::vector<Case>& cases);

}  // namespace crossgrain
