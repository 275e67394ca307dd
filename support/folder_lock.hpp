#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace crossgrain::inline support {

/// Holds a folder for this process until the end of the scope: no other may write results into
/// it. The operating system keeps the lock, so that of a process that was killed is gone with it.
class FolderLock {
 public:
  /// @param holder  the command, for whoever is kept out: "compare"
  /// @throws BadInput saying which process holds the folder, and since when
  /// @throws OutputError if the folder cannot be written to
  FolderLock(const std::filesystem::path& folder, const std::string& holder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept
      : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}
  FolderLock& operator=(FolderLock&&) = delete;

  /// Holds a file of any name; absent while another holds it. @throws OutputError
  static std::optional<FolderLock> attempt(const std::filesystem::path& file,
                                           const std::string& holder);
  /// From now on others may share it, by shared(), and have it while anyone does.
  void share();
  /// A lock that another process has shared, or that is free. @throws BadInput, OutputError
  static FolderLock shared(const std::filesystem::path& folder, const std::string& holder);

  /// Name of the lock's file in the folder, there while it is held.
  static constexpr const char* name = ".crossgrain.lock";

 private:
  FolderLock(std::filesystem::path file, int descriptor)
      : file_(std::move(file)), descriptor_(descriptor) {}
  static std::optional<FolderLock> held(const std::filesystem::path& file, int kind,
                                        const std::string& holder);
  /// @throws BadInput where another holds it
  static FolderLock ofFolder(const std::filesystem::path& folder, int kind,
                             const std::string& holder);

  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace crossgrain::inline support
