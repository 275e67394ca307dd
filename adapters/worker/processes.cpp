#include <fmt/format.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>
#include <vector>

#include "adapters/worker/process.hpp"
#include "support/descriptor.hpp"

namespace crossgrain {
namespace {

/// Of all processes, or of one's threads (/proc/PID/task); in ascending order.
std::vector<pid_t> numbersIn(const std::string& folder) {
  std::vector<pid_t> all;
  std::error_code gone;
  for (std::filesystem::directory_iterator each(folder, gone), end; !gone && each != end;
       each.increment(gone)) {
    const std::string name = each->path().filename().string();
    if (std::ranges::all_of(name, [](char c) { return c >= '0' && c <= '9'; }))
      all.push_back(std::atoi(name.c_str()));
  }
  std::ranges::sort(all);
  return all;
}

/// Content of a file of /proc; as far as it could be read, where its process ends meanwhile.
std::string contentOf(const std::string& file) {
  std::ostringstream content;
  content << std::ifstream(file, std::ios::binary).rdbuf();  // unlike iterators it does not throw
  return content.str();
}

/// As the process was started with; empty where it has none, has ended, is within exec or is the
/// kernel's.
std::string environmentOf(pid_t process) {
  return contentOf(fmt::format("/proc/{}/environ", process));
}

/// Fields of /proc/PID/stat, or of a thread's, by their numbers in proc(5), from 3 on; empty where
/// it is gone.
class Stat {
 public:
  explicit Stat(const std::string& folder) {
    const std::string text = contentOf(folder + "/stat");
    // Field 2 is the program's name in brackets, in which anything may stand.
    std::istringstream rest(text.substr(std::min(text.rfind(')'), text.size())));
    std::string field;
    for (rest >> field; rest >> field;) fields_.push_back(field);
  }
  std::string field(std::size_t number) const {
    return number - 3 < fields_.size() ? fields_[number - 3] : "";
  }

 private:
  std::vector<std::string> fields_;
};

/// A program has replaced its memory and has not yet got its environment there: env_start, field
/// 50, is 0. So it is of kernel threads and of what may not be read; these have no readable
/// program.
bool isWithinExec(pid_t process) {
  std::error_code unreadable;
  const std::string folder = fmt::format("/proc/{}", process);
  return Stat(folder).field(50) == "0" &&
         !std::filesystem::read_symlink(folder + "/exe", unreadable).empty();
}

bool hasVariable(const std::string& environment, const std::string& variable) {
  for (std::size_t at = environment.find(variable); at != std::string::npos;
       at = environment.find(variable, at + 1)) {
    const std::size_t end = at + variable.size();
    if ((at == 0 || environment[at - 1] == '\0') &&
        (end == environment.size() || environment[end] == '\0'))
      return true;
  }
  return false;
}

struct Search {
  bool found = false;
  bool withinExec = false;    ///< one was: its environment, and so its mark, is not there yet
  std::vector<pid_t> unseen;  ///< listed, and without an environment when looked at; ascending
};

Search killOnce(const std::string& variable, const std::function<void()>& listed) {
  const std::vector<pid_t> all = numbersIn("/proc");
  if (listed) listed();
  Search search;
  for (const pid_t pid : all) {
    if (pid == ::getpid()) continue;
    // Opened before its environment is read: its number may pass to another process, the
    // descriptor does not.
    const Descriptor process(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0)));
    const std::string environment = process.get() < 0 ? "" : environmentOf(pid);
    if (environment.empty()) {
      search.unseen.push_back(pid);
      search.withinExec |= isWithinExec(pid);
    }
    if (hasVariable(environment, variable))
      search.found |= ::syscall(SYS_pidfd_send_signal, process.get(), SIGKILL, nullptr, 0) == 0;
  }
  return search;
}

}  // namespace

void killMarkedProcesses(const std::string& mark, const std::function<void()>& listed) {
  const std::string variable = fmt::format("{}={}", workerMark, mark);
  // Where others start programs all the time, one of theirs is unseen now and then, seldom in each.
  constexpr int most = 30;
  std::vector<pid_t> unseenBefore;
  for (int k = 0; k < most; ++k) {
    Search search = killOnce(variable, listed);
    if (k > 0 && !search.found && !search.withinExec &&
        std::ranges::includes(unseenBefore, search.unseen))
      return;
    unseenBefore = std::move(search.unseen);
  }
}

GroupActivity activityOf(pid_t group) {
  GroupActivity activity;
  for (const pid_t pid : numbersIn("/proc")) {
    const std::string folder = fmt::format("/proc/{}", pid);
    const Stat stat(folder);
    if (stat.field(5) != std::to_string(group)) continue;
    for (const pid_t thread : numbersIn(folder + "/task")) {
      const std::string state = Stat(fmt::format("{}/task/{}", folder, thread)).field(3);
      activity.computes |= state == "R" || state == "D";
    }
    for (const std::size_t time : {14, 15})  // utime, stime [clock ticks]
      activity.cpuSeconds += std::atof(stat.field(time).c_str()) / double(::sysconf(_SC_CLK_TCK));
  }
  return activity;
}

}  // namespace crossgrain
