#include "reports/render/gnuplot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <span>
#include <sstream>
#include <system_error>
#include <thread>

#include "support/busy_time.hpp"
#include "support/files.hpp"

extern char** environ;

namespace crossgrain::reports {

namespace {

constexpr const char* logName = "gnuplot.log";

/// Both outputs of a child go to one log in its working folder; it reads nothing.
class SpawnActions {
 public:
  SpawnActions(const std::filesystem::path& dir, const char* log) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addchdir_np(&actions_, dir.c_str());
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, log, O_WRONLY | O_CREAT | O_APPEND,
                                     0666);
    posix_spawn_file_actions_adddup2(&actions_, STDOUT_FILENO, STDERR_FILENO);
  }
  ~SpawnActions() { posix_spawn_file_actions_destroy(&actions_); }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;

  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

int waitFor(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return -1;
  return status;
}

/// How a child ended: "it ended with status 2", "signal 9 ended it", or nothing to say.
std::string endOf(int status) {
  if (status == -1) return "its end is not known";
  if (WIFSIGNALED(status)) return fmt::format("signal {} ended it", WTERMSIG(status));
  return WEXITSTATUS(status) == 0 ? ""
                                  : fmt::format("it ended with status {}", WEXITSTATUS(status));
}

/// gnuplot's last word on what stopped it; a warning did not, and where nothing else is said memory
/// is what it most often lacks.
std::string lastLine(const std::string& log) {
  std::string last;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);) {
    const auto begin = line.find_first_not_of(" \r");
    if (begin == std::string::npos) continue;
    line = line.substr(begin, line.find_last_not_of(" \r") + 1 - begin);
    if (line.find("arning: ") == std::string::npos) last = line;
  }
  return last.empty() ? "it says nothing, as where memory is short" : last;
}

/// One process that draws some of the scripts. @returns its id
pid_t startGnuplot(std::span<const std::string> scripts, const std::filesystem::path& dir) {
  std::vector<std::string> words = {"gnuplot", "-d"};
  words.insert(words.end(), scripts.begin(), scripts.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  const SpawnActions actions(dir, logName);
  pid_t child = 0;
  const int error =
      posix_spawnp(&child, "gnuplot", actions.get(), nullptr, arguments.data(), environ);
  if (error != 0)
    throw GnuplotError(
        fmt::format("gnuplot cannot be started ({}): the report is without plots; install gnuplot "
                    "(gnuplot-nox) and rebuild it with crossgrain report",
                    std::generic_category().message(error)),
        error != ENOENT);
  return child;
}

/// Where a share of several begins.
std::size_t shareBegin(std::size_t share, std::size_t shares, std::size_t all) {
  return all * share / shares;
}

}  // namespace

void runGnuplot(const std::vector<std::string>& scripts, const std::filesystem::path& dir) {
  if (scripts.empty()) return;
  const BusyTime::Piece drawing(drawingTime());
  // A start takes as long as three plots.
  const std::size_t shares = std::clamp<std::size_t>(
      scripts.size() / 4, 1, std::max(1U, std::thread::hardware_concurrency()));
  std::filesystem::remove(dir / logName);
  std::vector<pid_t> children;
  for (std::size_t share = 0; share < shares; ++share) {
    const std::size_t begin = shareBegin(share, shares, scripts.size());
    const std::size_t end = shareBegin(share + 1, shares, scripts.size());
    children.push_back(startGnuplot(std::span(scripts).subspan(begin, end - begin), dir));
  }
  std::string failed;
  for (const pid_t child : children)
    if (const std::string end = endOf(waitFor(child)); !end.empty()) failed = end;
  const std::string said = readFile(dir / logName).value_or("");
  if (!failed.empty())
    throw GnuplotError(
        fmt::format("gnuplot failed in {} ({}): {}", dir.string(), failed, lastLine(said)));
  if (said.empty()) std::filesystem::remove(dir / logName);
}

}  // namespace crossgrain::reports
