#include "runs/common/brief_timing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "adapters/worker/worker_engine.hpp"

namespace crossgrain::inline runs {

namespace {

/// VmHWM of /proc/PID/status (proc(5)), given in kB.
std::optional<std::size_t> mostMemoryOf(const Engine& engine) {
  const auto* const worker = dynamic_cast<const WorkerEngine*>(&engine);
  if (!worker || worker->pid() < 0) return std::nullopt;
  std::ifstream status(fmt::format("/proc/{}/status", worker->pid()));
  for (std::string word; status >> word;)
    if (std::size_t kilobytes = 0; word == "VmHWM:" && status >> kilobytes) return 1024 * kilobytes;
  return std::nullopt;
}

}  // namespace

BriefTiming briefTiming(Engine& engine, const EngineEntry& entry, const Case& setup,
                        const Scene& scene) {
  constexpr double enough = 0.1;  // s of steps
  constexpr int warmUp = 5, most = 2000;
  BriefTiming timing;
  timing.dt = loadScene(engine, entry, setup, scene).dt;
  engine.advance(warmUp * timing.dt);
  const double before = engine.stats().wallSeconds;
  double spent = 0.0;
  for (int more = 5; timing.steps < most && spent < enough; more *= 2) {
    timing.steps += more;
    engine.advance((warmUp + timing.steps) * timing.dt);
    spent = engine.stats().wallSeconds - before;
  }
  timing.secondsPerStep = spent / timing.steps;
  timing.memory = mostMemoryOf(engine);
  return timing;
}

}  // namespace crossgrain::inline runs
