#include "studies/core/engine_running.hpp"

#include <fmt/format.h>
#include <sys/types.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "adapters/worker/worker_engine.hpp"
#include "studies/core/engine_access.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline studies {

double advanceInPieces(Engine& engine, const EffectiveParameters& effective, double from, double to,
                       const std::function<void(double)>& between) {
  const double piece = 2000.0 * effective.dt;
  double reached = from;
  for (double now = from; now < to;) {
    if (between) between(now);
    throwIfInterrupted();
    const double next = std::min(to, now + piece);
    reached = engine.advance(next);
    if (!(std::abs(reached - next) <= effective.dt)) {
      discardWorker(engine);
      throw EngineFailure(fmt::format("{}: asked for t = {:g} s it stopped at {:g} s",
                                      effective.engine, next, reached));
    }
    now = next;
  }
  return reached;
}

StepCost costBetween(const Stats& before, const Stats& after) {
  StepCost cost;
  cost.steps = after.steps - before.steps;
  const auto steps = static_cast<double>(cost.steps);
  const double wall = after.wallSeconds - before.wallSeconds,
               processor = after.cpuSeconds - before.cpuSeconds;
  cost.wall = wall / steps;
  cost.processor = (processor > 0.0 ? processor : wall) / steps;
  if (after.contactEvaluations > before.contactEvaluations)
    cost.contacts =
        static_cast<double>(after.contactEvaluations - before.contactEvaluations) / steps;
  return cost;
}

StepCost briefSteps(Engine& engine, double dt, double enough, std::uint64_t most) {
  constexpr std::uint64_t first = 16;
  std::uint64_t steps = 0;
  for (std::uint64_t stretch = first;; stretch *= 2) {
    const Stats before = engine.stats();
    engine.advance(static_cast<double>(steps += stretch) * dt);
    const StepCost cost = costBetween(before, engine.stats());
    const double took = cost.processor * static_cast<double>(cost.steps);
    // The first steps of some engines compile them.
    const bool warm = stretch > first || took >= 10.0 * enough;
    if ((warm && took >= enough) || stretch >= most) return cost;
  }
}

namespace {

struct RunningProcess {
  pid_t pid = 0, parent = 0;
  std::size_t most = 0;  ///< [bytes]
};

/// The number after `key` in a file of lines like "VmHWM:   1234 kB".
std::optional<std::size_t> numberAfter(const std::filesystem::path& file, const std::string& key) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(key)) return std::stoull(line.substr(key.size()));
  return std::nullopt;
}

std::vector<RunningProcess> runningProcesses() {
  std::vector<RunningProcess> all;
  std::error_code gone;
  for (std::filesystem::directory_iterator each("/proc", gone), end; !gone && each != end;
       each.increment(gone)) {
    const std::string name = each->path().filename().string();
    if (!std::ranges::all_of(name, [](char c) { return c >= '0' && c <= '9'; })) continue;
    const auto status = each->path() / "status";
    const auto parent = numberAfter(status, "PPid:"), most = numberAfter(status, "VmHWM:");
    if (parent && most)
      all.push_back(
          {static_cast<pid_t>(std::stol(name)), static_cast<pid_t>(*parent), 1024 * *most});
  }
  return all;
}

}  // namespace

std::optional<std::size_t> mostMemoryOf(const Engine& engine) {
  const auto* const worker = dynamic_cast<const WorkerEngine*>(&engine);
  if (!worker || worker->pid() < 0) return std::nullopt;
  const std::vector<RunningProcess> all = runningProcesses();
  std::vector<pid_t> family = {worker->pid()};
  std::size_t sum = 0;
  for (std::size_t k = 0; k < family.size(); ++k)
    for (const RunningProcess& process : all) {
      if (process.pid == family[k]) sum += process.most;
      if (process.parent == family[k]) family.push_back(process.pid);
    }
  if (sum == 0) return std::nullopt;
  return sum;
}

std::optional<std::size_t> availableMemory() {
  const auto kilobytes = numberAfter("/proc/meminfo", "MemAvailable:");
  return kilobytes ? std::optional(1024 * *kilobytes) : std::nullopt;
}

}  // namespace crossgrain::inline studies
