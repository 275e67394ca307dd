#include "support/program.hpp"

#include <unistd.h>

#include <cstdlib>
#include <sstream>

namespace crossgrain::inline support {

bool isProgram(const std::filesystem::path& path) {
  std::error_code none;
  return std::filesystem::is_regular_file(path, none) && ::access(path.c_str(), X_OK) == 0;
}

bool isOnPath(const std::string& program) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (isProgram(std::filesystem::path(folder) / program)) return true;
  return false;
}

}  // namespace crossgrain::inline support
