#include "studies/lockstep/starts.hpp"

#include <gsl/gsl_rng.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "adapters/registry.hpp"
#include "cases/flow.hpp"
#include "studies/lockstep/rules.hpp"
#include "support/interrupt.hpp"
#include "support/random.hpp"
#include "support/task_pool.hpp"

namespace crossgrain::inline studies {
namespace {

/// Streams of the case's seed from here on are lockstep's; packings have the first ones.
constexpr std::uint64_t streamOfStarts = 1ull << 40;

/// In each of `count` equal parts of the span, at random. [s]
std::vector<double> timesOf(const Case& setup, std::size_t packing, std::size_t count,
                            double span) {
  const Random random =
      randomStream(static_cast<std::uint64_t>(setup.preparation.seed), streamOfStarts + packing);
  std::vector<double> times;
  for (std::size_t k = 0; k < count; ++k)
    times.push_back(span * (static_cast<double>(k) + gsl_rng_uniform(random.get())) /
                    static_cast<double>(count));
  return times;
}

/// Whether the case's seed makes any number of packings at no cost.
bool canDrawMore(const Case& setup) {
  return isAssembly(setup) && !packingsAreFiles(setup);
}

template <int D>
std::vector<FlowState> statesIn(const Case& setup, const std::vector<Packing>& packings, double dt,
                                std::size_t count, const std::function<void(double)>& progress,
                                int jobs) {
  const double span = std::min(flowDuration(setup), startSteps * dt);
  std::atomic<std::size_t> found = 0;
  const auto statesOf = [&](std::size_t p, const Packing& packing, std::size_t share) {
    std::vector<FlowState> states;
    const auto engine = engineRegistry().front().make();
    const SceneOf<D> scene = flowScene<D>(setup, packing, dt);
    loadOn(*engine, scene, {});
    for (const double time : timesOf(setup, p, share, span)) {
      throwIfInterrupted();
      engine->advance(flowRestart(setup, time));
      const SnapshotOf<D> now = snapshotOf<D>(*engine, ContactReport::none);
      Packing there = packingAt(packing, scene, now);
      const LockstepStart start{p, now.positionTime, there.wheelAngle};
      states.push_back({start, std::move(there)});
      progress(std::min(1.0, static_cast<double>(++found) / static_cast<double>(count)));
    }
    return states;
  };
  std::vector<std::vector<FlowState>> byPacking(packings.size());
  std::vector<Task> tasks;
  for (std::size_t p = 0; p < packings.size(); ++p) {
    const std::size_t share = count / packings.size() + (p < count % packings.size() ? 1 : 0);
    if (share > 0)
      tasks.push_back({static_cast<double>(share),
                       [&, p, share] { byPacking[p] = statesOf(p, packings[p], share); }});
  }
  runTasks(tasks, jobs);

  std::vector<FlowState> states;
  std::set<std::string> seen;
  const auto add = [&](std::vector<FlowState> some) {
    for (FlowState& state : some)
      if (seen.insert(state.packing.hash).second) states.push_back(std::move(state));
  };
  for (std::vector<FlowState>& some : byPacking) add(std::move(some));
  for (std::size_t p = packings.size(); states.size() < count && canDrawMore(setup); ++p) {
    const std::size_t before = states.size();
    const auto none = std::unique_ptr<Engine>();  // nothing is prepared
    add(statesOf(p, flowPacking(setup, static_cast<int>(p), dt, *none, [](double) {}),
                 count - before));
    if (states.size() == before) break;
  }
  return states;
}

}  // namespace

std::vector<FlowState> statesAlongTheFlow(const Case& setup, const std::vector<Packing>& packings,
                                          double dt, std::size_t count,
                                          const std::function<void(double)>& progress, int jobs) {
  return setup.dimension == 3 ? statesIn<3>(setup, packings, dt, count, progress, jobs)
                              : statesIn<2>(setup, packings, dt, count, progress, jobs);
}

}  // namespace crossgrain::inline studies
