#include "support/regular_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace crossgrain::inline support {

// O_NONBLOCK: opening a pipe would wait for who writes to it.
RegularFile::RegularFile(const std::filesystem::path& file)
    : RegularFile(Descriptor(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC))) {}

RegularFile::RegularFile(Descriptor in) : in_(std::move(in)) {
  if (in_.get() < 0) return;
  struct stat status {};
  const bool regular = ::fstat(in_.get(), &status) == 0 && S_ISREG(status.st_mode);
  state_ = regular ? State::open : State::special;
  if (regular) size_ = static_cast<std::size_t>(status.st_size);
}

std::size_t RegularFile::read(std::size_t offset, std::span<std::byte> bytes) const {
  std::size_t done = 0;
  while (state_ == State::open && done < bytes.size()) {
    const ssize_t got = ::pread(in_.get(), bytes.data() + done, bytes.size() - done,
                                static_cast<off_t>(offset + done));
    if (got > 0)
      done += static_cast<std::size_t>(got);
    else if (got == 0 || errno != EINTR)
      break;
  }
  return done;
}

}  // namespace crossgrain::inline support
