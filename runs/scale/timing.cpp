#include "runs/scale/timing.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "runs/common/engine_access.hpp"
#include "runs/common/engine_running.hpp"
#include "runs/scale/plan.hpp"

namespace crossgrain::inline runs {

namespace {

/// For one answer [s]: loading, or a tenth of the steps, a hundred times slower than `grain`.
double patience(const ScalePoint& point) {
  const auto disks = static_cast<double>(point.disks);
  return 60.0 + 1e-3 * disks + 2.5e-7 * disks * static_cast<double>(point.steps);
}

/// In so many pieces that Ctrl-C is heard on the largest cells, too.
void advanceSteps(Engine& engine, const Realised& realised, std::uint64_t from, std::uint64_t to) {
  constexpr std::uint64_t pieces = 10;
  const std::uint64_t piece = std::max<std::uint64_t>(1, (to - from) / pieces);
  for (std::uint64_t at = from; at < to; at += piece)
    advanceInPieces(engine, realised, static_cast<double>(at) * realised.dt,
                    static_cast<double>(std::min(at + piece, to)) * realised.dt);
}

}  // namespace

void timeSteps(ScalePoint& point, const EngineEntry& entry, const std::string& sharing, Case scaled,
               const Scene& scene, const std::filesystem::path& scratch) {
  scaled.run.timeout = std::max(scaled.run.timeout, patience(point));
  if (!sharing.empty()) scaled.engines[entry.name][sharing] = static_cast<double>(point.workers);
  const auto worker = startNew(entry, scratch, scaled.run.timeout);
  Engine& engine = *worker;
  const Realised realised = loadScene(engine, entry, scaled, scene);

  const std::uint64_t warmUp = warmUpSteps(point.steps), end = warmUp + point.steps;
  advanceSteps(engine, realised, 0, warmUp);
  const Stats before = engine.stats();
  advanceSteps(engine, realised, warmUp, end);
  const Stats after = engine.stats();
  const auto steps = static_cast<double>(after.steps - before.steps);
  point.seconds.push_back((after.wallSeconds - before.wallSeconds) / steps);
  point.contacts =
      static_cast<double>(after.contactEvaluations - before.contactEvaluations) / steps;
  if (const auto memory = mostMemoryOf(engine))
    point.memory = std::max(point.memory.value_or(0.0), static_cast<double>(*memory));
  point.dt = realised.dt;
  point.precision = realised.precision;
  point.differs.clear();
  for (const Deviation& deviation : realised.deviations) point.differs.push_back(deviation.name);
}

std::optional<std::string> lackOfMemory(const std::vector<ScalePoint>& points, std::size_t k) {
  const ScalePoint& point = points[k];
  const ScalePoint* smaller = nullptr;
  for (std::size_t before = 0; before < k; ++before) {
    const ScalePoint& other = points[before];
    if (other.engine == point.engine && other.memory && other.disks < point.disks &&
        (other.workers == 1 || other.workers == point.workers))
      smaller = &other;
  }
  const auto available = availableMemory();
  if (!smaller || !available) return std::nullopt;
  const double expected = expectedMemory(point.disks, smaller->disks, *smaller->memory);
  // Of a small cell most is the program itself, which does not grow.
  constexpr std::size_t telling = 100'000;
  if (smaller->disks < telling || expected < static_cast<double>(*available)) return std::nullopt;
  return fmt::format(
      "by what {} disks took it would take {:.3g} GB of memory, and {:.3g} GB are available",
      smaller->disks, 1e-9 * expected, 1e-9 * static_cast<double>(*available));
}

}  // namespace crossgrain::inline runs
