#include "support/scratch_folder.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "support/bad_input.hpp"

namespace crossgrain::inline support {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder() {
  std::error_code none;
  const fs::path folder = fs::temp_directory_path(none);
  const char* wanted = std::getenv("TMPDIR");
  if (none)
    throw BadInput(fmt::format("TMPDIR = {}: there is no such folder for scratch files",
                               wanted ? wanted : "/tmp"));
  std::string name = (folder / "crossgrain-XXXXXX").string();
  if (!::mkdtemp(name.data()))
    throw BadInput(fmt::format("{}: no scratch folder can be made there; TMPDIR may name another",
                               folder.string()));
  path = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path, ignored);
}

}  // namespace crossgrain::inline support
