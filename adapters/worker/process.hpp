#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "adapters/program_call.hpp"

namespace crossgrain {

/// The child did not answer in time.
struct ProcessTimeout : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The child ended, or closed its end of the conversation.
struct ProcessEnded : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The child's line is longer than it may be.
struct OversizedMessage : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// No file that a child writes grows beyond this [bytes], its log included: a child that prints
/// without end fills no disk. The contacts of 30 million disks fit in.
inline constexpr std::uint64_t longestFile = std::uint64_t{4} << 30;

/// The variable in a worker's environment, and so in that of all that it starts, by which they are
/// found again in whatever process group, session or parent they are.
inline constexpr const char* workerMark = "CROSSGRAIN_WORKER";

/// Kills every process whose environment has workerMark with this value, children that are being
/// born included. Not found: what has an environment of its own making or belongs to another user,
/// and everything where there is no /proc.
///
/// Marked processes descend from marked ones alone. One search lists all processes and then looks
/// at each. A process that ends in between shows no environment and may have left a child that was
/// not listed, so the search is repeated until it finds none and every process without an
/// environment was so in the search before: whatever children it left were listed.
/// @param listed  for tests: called in every search between the list and the first look
void killMarkedProcesses(const std::string& mark, const std::function<void()>& listed = {});

/// Whether the processes of a group compute, and for how long they have.
struct GroupActivity {
  double cpuSeconds = 0.0;  ///< of all that are there [s]
  bool computes = false;    ///< a thread runs, waits for its turn on a processor, or for a disk
};
GroupActivity activityOf(pid_t group);

/// A child process that is spoken to in lines: it reads them from descriptor 3 and answers on
/// descriptor 4. Its input is empty, its output and error go to a log file.
///
/// It has a process group of its own, so that a terminal's Ctrl-C does not reach it, and the whole
/// group is killed when this object goes, and so are children that have left it, as far as they are
/// found by a variable in their environment. It does not outlive this process either: the kernel
/// kills it (Linux' PR_SET_PDEATHSIG). Any thread may make it, and another end it.
///
///   ChildProcess ── sendLine ── receiveLine ── … ── closeInput ── waitForExit ── ~ChildProcess
class ChildProcess {
 public:
  using Clock = std::chrono::steady_clock;

  /// Starts the program without a shell. Where HOME is no folder that can be written, the child's
  /// is the folder of its log: there are programs that do not start without.
  /// @throws std::runtime_error if it cannot be started: why
  ChildProcess(const ProgramCall& call, const std::filesystem::path& log);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// @throws ProcessTimeout, ProcessEnded, Interrupted
  void sendLine(const std::string& line, Clock::time_point deadline);

  /// The next line without its end.
  /// @param longest  that it may be [bytes]; little more than that is ever kept
  /// @throws ProcessTimeout, ProcessEnded, OversizedMessage, Interrupted
  std::string receiveLine(Clock::time_point deadline, std::size_t longest);

  /// Line that the child has written, or begun, and that is not received yet; empty: none.
  std::string unasked();

  /// It has not ended yet.
  bool isAlive() const;

  /// The child's descriptor 3 comes to its end.
  void closeInput();

  /// Whether the child ended by itself within that time.
  bool waitForExit(std::chrono::milliseconds patience);

  /// Kills the child's whole process group, what else it started, and waits until the child has
  /// gone.
  void kill();

  /// How it ended: "exit status 3", "signal 11 (Segmentation fault)"; empty while it runs.
  const std::string& exitText() const { return exitText_; }

  pid_t pid() const { return pid_; }

 private:
  void reap();

  pid_t pid_ = -1;  ///< also the process group
  int in_ = -1;     ///< our end of the child's descriptor 3
  int out_ = -1;    ///< our end of the child's descriptor 4
  std::string received_;
  std::string mark_;  ///< in the environment of all that it starts
  std::string exitText_;
};

}  // namespace crossgrain
