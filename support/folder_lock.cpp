#include "support/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <ctime>

#include "support/bad_input.hpp"
#include "support/files.hpp"

namespace crossgrain::inline support {

namespace fs = std::filesystem;

namespace {

/// Whether the open file is still the one of that name: a holder removes it when it is done.
bool isStill(int descriptor, const fs::path& file) {
  struct stat open {
  }, named{};
  return ::fstat(descriptor, &open) == 0 && ::stat(file.c_str(), &named) == 0 &&
         open.st_ino == named.st_ino && open.st_dev == named.st_dev;
}

/// File systems without locks; then there is none to be had.
bool cannotLock(int error) {
  return error == ENOLCK || error == ENOSYS || error == EOPNOTSUPP;
}

std::string describe(const std::string& holder) {
  return fmt::format("crossgrain {}, process {}, since {:%Y-%m-%d %H:%M:%S}", holder, ::getpid(),
                     fmt::localtime(std::time(nullptr)));
}

}  // namespace

std::optional<FolderLock> FolderLock::held(const fs::path& file, int kind,
                                           const std::string& holder) {
  for (;;) {
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0) throw OutputError(file, errno);
    if (::flock(descriptor, kind | LOCK_NB) != 0 && !cannotLock(errno)) {
      const int error = errno;
      ::close(descriptor);
      if (error == EINTR) continue;
      if (error != EWOULDBLOCK) throw OutputError(file, error);
      return std::nullopt;
    }
    if (!isStill(descriptor, file)) {
      ::close(descriptor);  // its holder removed it between our two calls
      continue;
    }
    // Its words are for people; on a full disk the lock holds without it.
    const std::string who = describe(holder);
    if (::ftruncate(descriptor, 0) == 0) [[maybe_unused]]
      const ssize_t written = ::write(descriptor, who.data(), who.size());
    return FolderLock(file, descriptor);
  }
}

std::optional<FolderLock> FolderLock::attempt(const fs::path& file, const std::string& holder) {
  return held(file, LOCK_EX, holder);
}

FolderLock FolderLock::ofFolder(const fs::path& folder, int kind, const std::string& holder) {
  if (auto lock = held(folder / name, kind, holder)) return *std::move(lock);
  const std::string who = readFile(folder / name).value_or("");
  throw BadInput(fmt::format("{}: in use by {}; wait until it has ended, or take another folder",
                             folder.string(), who.empty() ? "another crossgrain" : who));
}

FolderLock::FolderLock(const fs::path& folder, const std::string& holder)
    : FolderLock(ofFolder(folder, LOCK_EX, holder)) {}

FolderLock FolderLock::shared(const fs::path& folder, const std::string& holder) {
  return ofFolder(folder, LOCK_SH, holder);
}

void FolderLock::share() {
  ::flock(descriptor_, LOCK_SH);
}

/// The last one that has it removes it.
FolderLock::~FolderLock() {
  if (descriptor_ < 0) return;
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || cannotLock(errno)) ::unlink(file_.c_str());
  ::close(descriptor_);
}

}  // namespace crossgrain::inline support
