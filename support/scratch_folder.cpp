#include "support/scratch_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <mutex>

#include "support/bad_input.hpp"

namespace crossgrain::inline support {

namespace fs = std::filesystem;

namespace {

constexpr const char* prefix = "crossgrain-scratch-";

/// Holds the folder for as long as the process lives, however that ends; −1: another one does.
int hold(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor >= 0 && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  if (descriptor >= 0) ::close(descriptor);
  return -1;
}

/// Those of processes that were killed. A folder that has just been made may not be held yet.
void removeAbandoned(const fs::path& folder) {
  constexpr auto settled = std::chrono::minutes(1);
  std::error_code ignored;
  for (fs::directory_iterator each(folder, ignored), end; !ignored && each != end;
       each.increment(ignored)) {
    const fs::directory_entry& entry = *each;
    if (!entry.path().filename().string().starts_with(prefix)) continue;
    std::error_code gone;
    const auto made = fs::last_write_time(entry.path(), gone);
    if (gone || fs::file_time_type::clock::now() - made < settled) continue;
    struct stat status {};
    if (::lstat(entry.path().c_str(), &status) != 0 || status.st_uid != ::geteuid()) continue;
    const int held = hold(entry.path());
    if (held < 0) continue;
    fs::remove_all(entry.path(), gone);
    ::close(held);
  }
}

}  // namespace

ScratchFolder::ScratchFolder() {
  std::error_code none;
  const fs::path folder = fs::temp_directory_path(none);
  const char* wanted = std::getenv("TMPDIR");
  if (none)
    throw BadInput(fmt::format("TMPDIR = {}: there is no such folder for scratch files",
                               wanted ? wanted : "/tmp"));
  static std::once_flag once;
  std::call_once(once, [&] { removeAbandoned(folder); });
  std::string name = (folder / (std::string(prefix) + "XXXXXX")).string();
  if (!::mkdtemp(name.data()))
    throw BadInput(fmt::format("{}: no scratch folder can be made there; TMPDIR may name another",
                               folder.string()));
  path = name;
  held_ = hold(path);
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path, ignored);
  if (held_ >= 0) ::close(held_);
}

}  // namespace crossgrain::inline support
