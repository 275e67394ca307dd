#pragma once

#include <filesystem>
#include <string>

namespace crossgrain::inline support {

/// Whether a file is there that this user may execute.
bool isProgram(const std::filesystem::path& path);

/// Whether a program of that name is in one of PATH's folders.
bool isOnPath(const std::string& program);

}  // namespace crossgrain::inline support
