#pragma once

#include <unistd.h>

#include <utility>

namespace crossgrain::inline support {

/// A file descriptor that closes itself. Opened with O_CLOEXEC it is not inherited by a program
/// that is started meanwhile: a sibling that held our end of a worker's pipe would keep that worker
/// from seeing its end.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() { reset(); }
  Descriptor(Descriptor&& other) noexcept : fd_(other.release()) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int get() const { return fd_; }
  int release() { return std::exchange(fd_, -1); }
  void reset() {
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
  }

 private:
  int fd_;
};

}  // namespace crossgrain::inline support
