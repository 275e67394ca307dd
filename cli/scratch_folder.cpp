#include "cli/scratch_folder.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <stdexcept>

namespace crossgrain {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder() {
  std::string name = (fs::temp_directory_path() / "crossgrain-XXXXXX").string();
  if (!::mkdtemp(name.data()))
    throw std::runtime_error(fmt::format("{}: cannot be made", fs::temp_directory_path().string()));
  path = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path, ignored);
}

}  // namespace crossgrain
