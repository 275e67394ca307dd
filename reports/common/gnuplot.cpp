#include "reports/common/gnuplot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "support/files.hpp"

extern char** environ;

namespace crossgrain::reports {

namespace {

/// Both outputs of the child go to one log in its working folder; it reads nothing.
class SpawnActions {
 public:
  SpawnActions(const std::filesystem::path& dir, const char* log) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addchdir_np(&actions_, dir.c_str());
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, log, O_WRONLY | O_CREAT | O_TRUNC,
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

/// gnuplot's last word on what stopped it.
std::string lastLine(const std::string& log) {
  const auto end = log.find_last_not_of(" \r\n");
  if (end == std::string::npos) return "it says nothing";
  const auto before = log.find_last_of("\r\n", end);
  const auto begin = before == std::string::npos ? 0 : before + 1;
  return log.substr(log.find_first_not_of(' ', begin), end + 1 - begin);
}

}  // namespace

void runGnuplot(const std::vector<std::string>& scripts, const std::filesystem::path& dir) {
  if (scripts.empty()) return;
  static constexpr const char* log = "gnuplot.log";
  std::vector<std::string> words = {"gnuplot", "-d"};
  words.insert(words.end(), scripts.begin(), scripts.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  const SpawnActions actions(dir, log);
  pid_t child = 0;
  const int error =
      posix_spawnp(&child, "gnuplot", actions.get(), nullptr, arguments.data(), environ);
  if (error != 0)
    throw GnuplotError(
        fmt::format("gnuplot cannot be started ({}): the report is without plots; install gnuplot "
                    "(gnuplot-nox) and rebuild it with crossgrain report",
                    std::generic_category().message(error)));
  const int status = waitFor(child);
  const std::string said = readFile(dir / log).value_or("");
  if (status != 0)
    throw GnuplotError(fmt::format("gnuplot failed in {}: {}", dir.string(), lastLine(said)));
  if (said.empty()) std::filesystem::remove(dir / log);
}

}  // namespace crossgrain::reports
