#pragma once

#include <filesystem>

namespace crossgrain::inline support {

/// A folder of this process' own in the system's place for temporary files, gone at the end of the
/// scope. What killed processes left there is removed by the next one.
class ScratchFolder {
 public:
  /// @throws BadInput naming TMPDIR
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path path;

 private:
  int held_ = -1;  ///< descriptor whose lock shows that the process lives
};

}  // namespace crossgrain::inline support
