#pragma once

#include <filesystem>

namespace crossgrain::inline support {

/// A folder of this process' own in the system's place for temporary files, gone at the end of the
/// scope.
class ScratchFolder {
 public:
  /// @throws BadInput naming TMPDIR
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path path;
};

}  // namespace crossgrain::inline support
