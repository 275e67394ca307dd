#include "studies/scale/timing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <tuple>

#include "studies/core/engine_access.hpp"
#include "studies/core/engine_running.hpp"
#include "support/bad_input.hpp"
#include "support/input_file.hpp"

namespace crossgrain::inline studies {

std::vector<PlannedTiming> plannedPoints(const ScalePlan& plan, const std::vector<bool>& shares) {
  const std::size_t largest = std::ranges::max(plan.disks);
  std::vector<PlannedTiming> points;
  for (std::size_t engine = 0; engine < shares.size(); ++engine)
    for (const std::size_t disks : plan.disks) {
      points.push_back({disks, engine, 1});
      if (!shares[engine]) continue;
      for (const int workers : plan.workers) {
        points.push_back({disks, engine, workers});
        const std::size_t more = disks * static_cast<std::size_t>(workers);
        if (more <= largest) points.push_back({more, engine, workers});
      }
    }
  const auto order = [](const PlannedTiming& point) {
    return std::tuple(point.disks, point.engine, point.workers);
  };
  std::ranges::sort(points, {}, order);
  const auto repeated = std::ranges::unique(points);
  points.erase(repeated.begin(), repeated.end());
  return points;
}

std::uint64_t stepsFor(std::size_t disks) {
  constexpr std::uint64_t diskSteps = 20'000'000, least = 50;
  return std::max(least, diskSteps / disks);
}

std::uint64_t warmUpSteps(std::uint64_t timed) {
  return std::max<std::uint64_t>(5, timed / 10);
}

double expectedMemory(std::size_t disks, std::size_t fewer, double taken) {
  return taken * static_cast<double>(disks) / static_cast<double>(fewer);
}

std::vector<int> usualWorkers(unsigned cores) {
  std::vector<int> workers;
  const int most = static_cast<int>(std::max(cores, 1u));
  for (int count = 1; count < most; count *= 2) workers.push_back(count);
  workers.push_back(most);
  return workers;
}

std::vector<std::size_t> wholeNumbers(const std::string& option, const std::string& list,
                                      std::size_t least, std::size_t most) {
  std::vector<std::size_t> numbers;
  std::set<std::size_t> seen;
  for (const std::string& text : commaList(list)) {
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || number < least || number > most)
      throw BadInput(fmt::format("{} '{}': '{}' must be a whole number from {} to {}", option, list,
                                 text, least, most));
    if (!seen.insert(number).second)
      throw BadInput(fmt::format("{} '{}': {} stands twice", option, list, number));
    numbers.push_back(number);
  }
  return numbers;
}

namespace {

/// For one answer [s]: loading, or a tenth of the steps, a hundred times slower than `grain`.
double patience(const ScalePoint& point) {
  const auto disks = static_cast<double>(point.disks);
  return 60.0 + 1e-3 * disks + 2.5e-7 * disks * static_cast<double>(point.steps);
}

/// In so many pieces that Ctrl-C is heard on the largest cells, too.
void advanceSteps(Engine& engine, const EffectiveParameters& effective, std::uint64_t from,
                  std::uint64_t to) {
  constexpr std::uint64_t pieces = 10;
  const std::uint64_t piece = std::max<std::uint64_t>(1, (to - from) / pieces);
  for (std::uint64_t at = from; at < to; at += piece)
    advanceInPieces(engine, effective, static_cast<double>(at) * effective.dt,
                    static_cast<double>(std::min(at + piece, to)) * effective.dt);
}

}  // namespace

void timeSteps(ScalePoint& point, const EngineEntry& entry, const std::string& sharing, Case scaled,
               const Scene& scene, const std::filesystem::path& scratch) {
  scaled.run.timeout = std::max(scaled.run.timeout, patience(point));
  if (!sharing.empty()) scaled.engines[entry.name][sharing] = static_cast<double>(point.workers);
  const auto worker = startNew(entry, scratch, scaled.run.timeout);
  Engine& engine = *worker;
  const EffectiveParameters effective = loadScene(engine, entry, scaled, scene);

  const std::uint64_t warmUp = warmUpSteps(point.steps), end = warmUp + point.steps;
  advanceSteps(engine, effective, 0, warmUp);
  const Stats before = engine.stats();
  advanceSteps(engine, effective, warmUp, end);
  const Stats after = engine.stats();
  const auto steps = static_cast<double>(after.steps - before.steps);
  point.seconds.push_back((after.wallSeconds - before.wallSeconds) / steps);
  point.contacts =
      static_cast<double>(after.contactEvaluations - before.contactEvaluations) / steps;
  if (const auto memory = mostMemoryOf(engine))
    point.memory = std::max(point.memory.value_or(0.0), static_cast<double>(*memory));
  point.dt = effective.dt;
  point.precision = effective.precision;
  point.differs.clear();
  for (const Deviation& deviation : effective.deviations) point.differs.push_back(deviation.name);
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

}  // namespace crossgrain::inline studies
