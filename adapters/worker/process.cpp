#include "adapters/worker/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <mutex>
#include <semaphore>
#include <string_view>
#include <system_error>
#include <thread>

#include "support/descriptor.hpp"
#include "support/interrupt.hpp"

namespace crossgrain {

using namespace std::chrono_literals;
namespace {

/// A value of workerMark that no other worker has.
std::string newWorkerMark() {
  static std::atomic<unsigned> count{0};
  return fmt::format("{}-{}-{}", ::getpid(), ++count,
                     std::chrono::system_clock::now().time_since_epoch().count());
}

class Launcher {
 public:
  Launcher() {
    std::thread([this] { serve(); }).detach();
  }

  pid_t launch(const std::function<pid_t()>& work) {
    const std::scoped_lock one(mutex_);
    work_ = &work;
    asked_.release();
    done_.acquire();
    return launched_;
  }

  const pid_t process = ::getpid();

 private:
  [[noreturn]] void serve() {
    for (;;) {
      asked_.acquire();
      launched_ = (*work_)();
      done_.release();
    }
  }

  std::mutex mutex_;  ///< one who asks at a time
  std::binary_semaphore asked_{0}, done_{0};
  const std::function<pid_t()>* work_ = nullptr;
  pid_t launched_ = -1;
};

/// Forks in the one thread of this process that never ends, whoever asks: the kernel ties a child
/// that is to die with its parent to the *thread* that forked it (PR_SET_PDEATHSIG).
/// @param work  forks, and returns what fork() returned; in the child it does not return
pid_t inTheLastingThread(const std::function<pid_t()>& work) {
  static std::mutex mutex;
  // Never deleted: its thread waits until the process is gone. A fork of this process without exec,
  // as tests make, has no such thread and gets one of its own.
  static Launcher* known = nullptr;
  const std::scoped_lock lock(mutex);
  if (!known || known->process != ::getpid()) known = new Launcher;
  return known->launch(work);
}

[[noreturn]] void systemFailure(const std::string& what, int error) {
  throw std::runtime_error(fmt::format("{}: {}", what, std::generic_category().message(error)));
}

struct ChildSide {
  int requests, replies, log, nothing, failure;
  const char* folder;    ///< empty: where the parent is
  std::uint64_t memory;  ///< [bytes]; 0: no limit but the parent's
  pid_t parent;
};

/// A limit of the child's own, within what it may have.
void limit(__rlimit_resource resource, rlim_t most) {
  rlimit own{};
  ::getrlimit(resource, &own);
  own.rlim_cur = std::min(most, own.rlim_max);
  ::setrlimit(resource, &own);
}

/// Between fork and exec only async-signal-safe calls are allowed: another thread of the parent may
/// have held any lock at the moment of the fork.
[[noreturn]] void becomeChild(const ChildSide& side, char* const* argv, char* const* environment) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != side.parent) ::_exit(127);  // the parent died before prctl

  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::signal(SIGPIPE, SIG_DFL);
  limit(RLIMIT_FSIZE, longestFile);
  if (side.memory > 0) limit(RLIMIT_AS, side.memory);

  // First out of the way of 0 … 4, then into place; dup2 clears close-on-exec.
  const int requests = ::fcntl(side.requests, F_DUPFD_CLOEXEC, 10);
  const int replies = ::fcntl(side.replies, F_DUPFD_CLOEXEC, 10);
  const int log = ::fcntl(side.log, F_DUPFD_CLOEXEC, 10);
  const int nothing = ::fcntl(side.nothing, F_DUPFD_CLOEXEC, 10);
  const int failure = ::fcntl(side.failure, F_DUPFD_CLOEXEC, 10);
  if (::dup2(nothing, 0) >= 0 && ::dup2(log, 1) >= 0 && ::dup2(log, 2) >= 0 &&
      ::dup2(requests, 3) >= 0 && ::dup2(replies, 4) >= 0) {
    ::close_range(5, UINT_MAX, CLOSE_RANGE_CLOEXEC);  // what libraries opened without the flag
    if (*side.folder == '\0' || ::chdir(side.folder) == 0) ::execvpe(argv[0], argv, environment);
  }
  const int error = errno;
  [[maybe_unused]] const ssize_t written = ::write(failure, &error, sizeof error);
  ::_exit(127);
}

/// As exec takes them: null at the end.
std::vector<char*> pointers(const std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (const std::string& text : texts) all.push_back(const_cast<char*>(text.c_str()));
  all.push_back(nullptr);
  return all;
}

/// This process' environment and what the call adds, with another HOME where its own cannot be
/// used.
std::vector<std::string> environmentOf(const ProgramCall& call, const std::string& mark,
                                       const std::filesystem::path& otherHome) {
  const char* home = std::getenv("HOME");
  std::error_code missing;
  const bool usable =
      home && std::filesystem::is_directory(home, missing) && ::access(home, W_OK | X_OK) == 0;
  std::vector<std::string> variables;
  for (char** each = environ; *each; ++each) {
    const std::string_view variable = *each;
    const std::string name(variable.substr(0, variable.find('=')));
    if ((usable || name != "HOME") && name != workerMark && !call.environment.contains(name))
      variables.emplace_back(variable);
  }
  for (const auto& [name, value] : call.environment) variables.push_back(name + "=" + value);
  variables.push_back(fmt::format("{}={}", workerMark, mark));
  if (!usable && !call.environment.contains("HOME"))
    variables.push_back("HOME=" + otherHome.string());
  return variables;
}

int millisecondsUntil(ChildProcess::Clock::time_point deadline) {
  const auto left =
      std::chrono::ceil<std::chrono::milliseconds>(deadline - ChildProcess::Clock::now());
  return static_cast<int>(std::clamp<long long>(left.count(), 0, INT_MAX));
}

/// Waits until the descriptor has one of the events. What is nearly there when the user interrupts
/// is waited for, as a run can then keep where it is. @throws ProcessTimeout, Interrupted
void await(int fd, short events, ChildProcess::Clock::time_point deadline) {
  constexpr auto slice = 100ms, patience = 1000ms;
  pollfd entry{fd, events, 0};
  for (bool stopping = false;;) {
    const auto wake = std::min(deadline, ChildProcess::Clock::now() + slice);
    const int ready = ::poll(&entry, 1, millisecondsUntil(wake));
    if (ready > 0) return;
    if (ready < 0 && errno != EINTR) systemFailure("poll", errno);
    if (ChildProcess::Clock::now() >= deadline) {
      if (stopping) throw Interrupted();
      throw ProcessTimeout("no answer");
    }
    if (!interrupted() || stopping) continue;
    stopping = true;
    deadline = std::min(deadline, ChildProcess::Clock::now() + patience);
  }
}

std::string describeExit(const siginfo_t& info) {
  if (info.si_code == CLD_EXITED) return fmt::format("exit status {}", info.si_status);
  const char* name = ::sigdescr_np(info.si_status);
  return fmt::format("signal {} ({})", info.si_status, name ? name : "unknown");
}

}  // namespace

ChildProcess::ChildProcess(const ProgramCall& call, const std::filesystem::path& log)
    : mark_(newWorkerMark()) {
  const std::vector<std::string> variables = environmentOf(call, mark_, log.parent_path());
  const std::vector<char*> arguments = pointers(call.argv), environment = pointers(variables);

  // A socket for the requests, because writing to it can be kept from raising SIGPIPE.
  int request[2], reply[2], failure[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, request) != 0)
    systemFailure("socketpair", errno);
  Descriptor requestOurs(request[0]), requestTheirs(request[1]);
  if (::pipe2(reply, O_CLOEXEC) != 0) systemFailure("pipe", errno);
  Descriptor replyOurs(reply[0]), replyTheirs(reply[1]);
  if (::pipe2(failure, O_CLOEXEC) != 0) systemFailure("pipe", errno);
  Descriptor failureOurs(failure[0]), failureTheirs(failure[1]);
  ::unlink(log.c_str());  // an earlier worker may have put a pipe or a link there
  // Appending: what is cut off while it runs stays cut off (WorkerEngine::moveTo).
  Descriptor logFile(::open(log.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_EXCL | O_CLOEXEC, 0644));
  if (logFile.get() < 0) systemFailure(log.string(), errno);
  Descriptor nothing(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  if (nothing.get() < 0) systemFailure("/dev/null", errno);

  const ChildSide side{requestTheirs.get(), replyTheirs.get(),   logFile.get(), nothing.get(),
                       failureTheirs.get(), call.folder.c_str(), call.memory,   ::getpid()};
  int failed = 0;  // errno is the forking thread's own
  pid_ = inTheLastingThread([&] {
    const pid_t child = ::fork();
    if (child == 0) becomeChild(side, arguments.data(), environment.data());
    if (child < 0) failed = errno;
    return child;
  });
  if (pid_ < 0) systemFailure("fork", failed);
  ::setpgid(pid_, pid_);  // here too: whichever comes first

  failureTheirs.reset();
  int error = 0;
  ssize_t count;
  do count = ::read(failureOurs.get(), &error, sizeof error);
  while (count < 0 && errno == EINTR);
  if (count > 0) {
    kill();
    systemFailure(fmt::format("cannot start {}", call.argv[0]), error);
  }
  in_ = requestOurs.release();
  out_ = replyOurs.release();
}

ChildProcess::~ChildProcess() {
  kill();
  closeInput();
  if (out_ >= 0) ::close(out_);
}

void ChildProcess::sendLine(const std::string& line, Clock::time_point deadline) {
  const std::string text = line + '\n';
  std::size_t sent = 0;
  while (sent < text.size()) {
    const ssize_t count =
        ::send(in_, text.data() + sent, text.size() - sent, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count >= 0)
      sent += static_cast<std::size_t>(count);
    else if (errno == EAGAIN)
      await(in_, POLLOUT, deadline);
    else if (errno != EINTR)
      throw ProcessEnded("it reads no more");
  }
}

std::string ChildProcess::receiveLine(Clock::time_point deadline, std::size_t longest) {
  std::size_t searched = 0;
  for (;;) {
    const std::size_t end = received_.find('\n', searched);
    if (end != std::string::npos && end <= longest) {
      std::string line = received_.substr(0, end);
      received_.erase(0, end + 1);
      return line;
    }
    if (received_.size() > longest) throw OversizedMessage("its line does not end");
    searched = received_.size();
    await(out_, POLLIN, deadline);
    char buffer[65536];
    const ssize_t count = ::read(out_, buffer, sizeof buffer);
    if (count == 0) throw ProcessEnded("it answers no more");
    if (count > 0)
      received_.append(buffer, static_cast<std::size_t>(count));
    else if (errno != EINTR)
      systemFailure("reading an answer", errno);
  }
}

std::string ChildProcess::unasked() {
  pollfd entry{out_, POLLIN, 0};
  if (received_.empty() && ::poll(&entry, 1, 0) > 0) {
    char buffer[256];
    const ssize_t count = ::read(out_, buffer, sizeof buffer);
    if (count > 0) received_.append(buffer, static_cast<std::size_t>(count));
  }
  return received_.substr(0, received_.find('\n'));
}

void ChildProcess::closeInput() {
  if (in_ >= 0) ::close(in_);
  in_ = -1;
}

bool ChildProcess::isAlive() const {
  siginfo_t info{};
  return pid_ > 0 &&
         ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         info.si_pid == 0;
}

bool ChildProcess::waitForExit(std::chrono::milliseconds patience) {
  const auto deadline = Clock::now() + patience;
  while (pid_ > 0) {
    // The zombie stays until reap(): its number must not pass to another process before the group's
    // end.
    siginfo_t info{};
    if (::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
        info.si_pid == pid_) {
      reap();
      return true;
    }
    if (Clock::now() >= deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

void ChildProcess::kill() {
  if (pid_ > 0) reap();
}

void ChildProcess::reap() {
  ::kill(-pid_, SIGKILL);  // the whole group, also what a worker left behind
  siginfo_t info{};
  while (::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED) != 0 && errno == EINTR) {
  }
  killMarkedProcesses(mark_);
  exitText_ = describeExit(info);
  pid_ = -1;
}

}  // namespace crossgrain
