// Library for LD_PRELOAD: mishaps that the environment asks for, counted in each process. From
// write number FULL_DISK_AT to a file on, the disk is full; after CLOCK_BACK_AFTER calls for the
// time of day, the clock has been set back by an hour (monotonic clocks are not changed).
// FULL_DISK_COUNT names a file that gets the number of writes of each process that ends by itself.
// Writes that the C library makes by itself (fprintf) are not counted.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <ctime>
#include <string>

namespace {

std::atomic<long> writes;

/// Terminals, pipes and sockets are not on a disk.
bool onDisk(int fd) {
  struct stat what {};
  return fstat(fd, &what) == 0 && S_ISREG(what.st_mode);
}

bool findsNoRoom(int fd) {
  static const char* const at = std::getenv("FULL_DISK_AT");
  if (!onDisk(fd)) return false;
  const long number = ++writes;
  return at != nullptr && number >= std::atol(at);
}

template <typename Function, typename... Rest>
ssize_t unlessFull(const char* name, int fd, Rest... rest) {
  static const auto real = reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
  if (!findsNoRoom(fd)) return real(fd, rest...);
  errno = ENOSPC;
  return -1;
}

struct AtEnd {
  ~AtEnd() {
    const char* const file = std::getenv("FULL_DISK_COUNT");
    if (file == nullptr) return;
    const std::string line = std::to_string(writes) + "\n";
    const int fd = open(file, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (fd < 0) return;
    using Write = ssize_t(int, const void*, size_t);
    reinterpret_cast<Write*>(dlsym(RTLD_NEXT, "write"))(fd, line.data(), line.size());
    close(fd);
  }
} atEnd;

}  // namespace

extern "C" {

ssize_t write(int fd, const void* from, size_t bytes) {
  return unlessFull<ssize_t(int, const void*, size_t)>("write", fd, from, bytes);
}
ssize_t pwrite(int fd, const void* from, size_t bytes, off_t at) {
  return unlessFull<ssize_t(int, const void*, size_t, off_t)>("pwrite", fd, from, bytes, at);
}
ssize_t pwrite64(int fd, const void* from, size_t bytes, off64_t at) {
  return unlessFull<ssize_t(int, const void*, size_t, off64_t)>("pwrite64", fd, from, bytes, at);
}
ssize_t writev(int fd, const iovec* parts, int count) {
  return unlessFull<ssize_t(int, const iovec*, int)>("writev", fd, parts, count);
}
int clock_gettime(clockid_t clock, timespec* now) {
  static const auto real =
      reinterpret_cast<int (*)(clockid_t, timespec*)>(dlsym(RTLD_NEXT, "clock_gettime"));
  static const char* const after = std::getenv("CLOCK_BACK_AFTER");
  static std::atomic<long> looks;
  const int status = real(clock, now);
  if (clock == CLOCK_REALTIME && after != nullptr && ++looks > std::atol(after))
    now->tv_sec -= 3600;
  return status;
}
}
