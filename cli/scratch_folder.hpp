#pragma once

#include <filesystem>

namespace crossgrain {

/// A folder of this process' own, gone at the end of the scope.
struct ScratchFolder {
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path path;
};

}  // namespace crossgrain
