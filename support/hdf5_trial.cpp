#include "support/hdf5_trial.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <new>
#include <string>

#include "support/bad_input.hpp"
#include "support/descriptor.hpp"
#include "support/hdf5_file.hpp"
#include "support/interrupt.hpp"

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
  const std::uintmax_t reported = std::filesystem::file_size(file, unknown);
  const rlim_t size = unknown ? 0 : reported;
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

/// Waits until the trial is over; the user need not. What waits for a file system that does not
/// answer takes no CPU time, so that only this ends it.
/// @returns its status, as waitpid() has it; −1: nobody knows  @throws Interrupted
int await(int answer, pid_t child) {
  constexpr int patience = 100;  // [ms]
  pollfd entry{answer, POLLIN, 0};
  for (int status = 0;;) {
    ::poll(&entry, 1, patience);
    const pid_t ended = ::waitpid(child, &status, WNOHANG);
    if (ended == child) return status;
    if (ended < 0 && errno != EINTR) return -1;
    if (!interrupted()) continue;
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    throw Interrupted();
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
  if (::pipe2(pipe, O_CLOEXEC | O_NONBLOCK) != 0) throw BadInput("no pipe for a trial");
  const pid_t child = forkWithLibrary();
  if (child == 0) {
    setBounds(file);
    readAndExit(read, pipe[1]);
  }
  ::close(pipe[1]);
  const Descriptor answer(pipe[0]);
  const int status = child > 0 ? await(answer.get(), child) : -1;
  const std::string said = whatWasSaid(answer.get());
  if (child < 0) throw BadInput(fmt::format("{}: no process for a trial", file.string()));
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  if (WIFEXITED(status) && WEXITSTATUS(status) == threw && !said.empty()) throw BadInput(said);
  throw BadInput(fmt::format("{}: is damaged: HDF5 does not get to the end of it", file.string()));
}

}  // namespace crossgrain::inline support
