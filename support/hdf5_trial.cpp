#include "support/hdf5_trial.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <new>
#include <stdexcept>
#include <string>

#include "support/hdf5_file.hpp"

namespace crossgrain::inline support {
namespace {

constexpr int threw = 3;  ///< exit status; what it said is in the pipe

void bound(int resource, rlim_t most) {
  const rlimit both{most, most};
  ::setrlimit(resource, &both);
}

/// A gigabyte beyond what the program has by then, and what a file of that size may hold packed.
/// CPU time, which a busy machine does not make longer: 5 s, and 1 s for 20 MB of the file.
void setBounds(const std::filesystem::path& file) {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  std::error_code unknown;
  const std::uintmax_t told = std::filesystem::file_size(file, unknown);
  const rlim_t size = unknown ? 0 : told;
  bound(RLIMIT_AS,
        pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + (rlim_t{1} << 30) + 64 * size);
  bound(RLIMIT_CPU, 5 + size / 20'000'000);
  bound(RLIMIT_CORE, 0);
}

/// In the new process. What the C library or sanitizers say when they give up is for nobody.
[[noreturn]] void readAndExit(const std::function<void()>& read, int answer) {
  if (const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC); nowhere >= 0)
    ::dup2(nowhere, STDERR_FILENO);
  try {
    read();
    ::_exit(0);
  } catch (const std::bad_alloc&) {
    ::_exit(1);
  } catch (const std::exception& error) {
    const std::string what = error.what();
    // A line is shorter than what a pipe holds.
    static_cast<void>(!::write(answer, what.data(), std::min<std::size_t>(what.size(), 4096)));
    ::_exit(threw);
  }
}

std::string whatWasSaid(int answer) {
  std::string said(4096, '\0');
  const ssize_t size = ::read(answer, said.data(), said.size());
  said.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return said;
}

}  // namespace

void tryReading(const std::filesystem::path& file, const std::function<void()>& read) {
  int pipe[2];
  if (::pipe2(pipe, O_CLOEXEC) != 0) throw std::runtime_error("no pipe for a trial");
  const pid_t child = forkWithLibrary();
  if (child == 0) {
    setBounds(file);
    readAndExit(read, pipe[1]);
  }
  ::close(pipe[1]);
  int status = -1;
  if (child > 0)
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
  const std::string said = whatWasSaid(pipe[0]);
  ::close(pipe[0]);
  if (child < 0) throw std::runtime_error(fmt::format("{}: no process for a trial", file.string()));
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  if (WIFEXITED(status) && WEXITSTATUS(status) == threw && !said.empty())
    throw std::runtime_error(said);
  throw std::runtime_error(
      fmt::format("{}: is damaged: HDF5 does not get to the end of it", file.string()));
}

}  // namespace crossgrain::inline support
