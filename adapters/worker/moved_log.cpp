#include "adapters/worker/moved_log.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

#include "support/descriptor.hpp"

namespace crossgrain {

void moveLog(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (from == to) return;
  const auto require = [&](bool done) {
    if (!done)
      throw std::runtime_error(
          fmt::format("{}: {}", from.string(), std::generic_category().message(errno)));
  };
  // The worker may have put anything there: a link would be cut where it points to, a pipe would
  // hold who opens it.
  const Descriptor log(::open(from.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  require(log.get() >= 0 && ::fstat(log.get(), &status) == 0);
  if (!S_ISREG(status.st_mode)) throw std::runtime_error(from.string() + ": is no regular file");
  require(::rename(from.c_str(), to.c_str()) == 0);
  if (status.st_size == 0) return;
  std::filesystem::copy_file(to, from);
  require(::ftruncate(log.get(), 0) == 0);
}

}  // namespace crossgrain
