#include "adapters/worker/stray_processes.hpp"

#include <fmt/format.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>

#include "support/descriptor.hpp"

namespace crossgrain {
namespace {

namespace fs = std::filesystem;

/// Whether that is in its environment as it was started.
bool hasVariable(const fs::path& process, const std::string& variable) {
  std::ifstream in(process / "environ", std::ios::binary);
  const std::string all{std::istreambuf_iterator<char>(in), {}};
  for (std::size_t at = all.find(variable); at != std::string::npos;
       at = all.find(variable, at + 1)) {
    const std::size_t end = at + variable.size();
    if ((at == 0 || all[at - 1] == '\0') && (end == all.size() || all[end] == '\0')) return true;
  }
  return false;
}

/// @returns whether any was found
bool killOnce(const std::string& variable) {
  bool found = false;
  std::error_code gone;
  for (fs::directory_iterator each("/proc", gone), end; !gone && each != end;
       each.increment(gone)) {
    const std::string name = each->path().filename().string();
    if (!std::ranges::all_of(name, [](char c) { return c >= '0' && c <= '9'; })) continue;
    const pid_t pid = std::atoi(name.c_str());
    if (pid == ::getpid()) continue;
    // Held before it is looked at: its number may pass to a stranger, the descriptor does not.
    const Descriptor process(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0)));
    if (process.get() < 0 || !hasVariable(each->path(), variable)) continue;
    found |= ::syscall(SYS_pidfd_send_signal, process.get(), SIGKILL, nullptr, 0) == 0;
  }
  return found;
}

}  // namespace

std::string newWorkerMark() {
  static std::atomic<unsigned> count{0};
  return fmt::format("{}-{}-{}", ::getpid(), ++count,
                     std::chrono::system_clock::now().time_since_epoch().count());
}

void killMarkedProcesses(const std::string& mark) {
  const std::string variable = fmt::format("{}={}", workerMark, mark);
  // One that was being forked while we looked is found the next time.
  constexpr int rounds = 10;
  for (int k = 0; k < rounds && killOnce(variable); ++k) {
  }
}

}  // namespace crossgrain
