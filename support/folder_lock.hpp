#pragma once

#include <filesystem>
#include <string>

namespace crossgrain::inline support {

/// Holds a folder for this process until the end of the scope: nobody else may write results into
/// it. The operating system keeps the lock, so that of a process that was killed is gone with it.
class FolderLock {
 public:
  /// @param holder  the command, for whoever is kept out: "compare"
  /// @throws BadInput saying which process holds the folder, and since when
  /// @throws OutputError if the folder cannot be written to
  FolderLock(const std::filesystem::path& folder, const std::string& holder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Name of the lock's file in the folder, there while it is held.
  static constexpr const char* name = ".crossgrain.lock";

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace crossgrain::inline support
