#include "runs/lockstep/starts.hpp"

#include <gsl/gsl_rng.h>

#include <algorithm>
#include <map>

#include "adapters/registry.hpp"
#include "cases/flow.hpp"
#include "runs/lockstep/rules.hpp"
#include "support/interrupt.hpp"
#include "support/random.hpp"

namespace crossgrain::inline runs {
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

}  // namespace

std::vector<FlowState> statesAlongTheFlow(const Case& setup, const std::vector<Packing>& packings,
                                          double dt, std::size_t count,
                                          const std::function<void(double)>& progress) {
  const double span = std::min(flowDuration(setup), startSteps * dt);
  std::vector<FlowState> states;
  for (std::size_t p = 0; p < packings.size(); ++p) {
    const std::size_t share = count / packings.size() + (p < count % packings.size() ? 1 : 0);
    if (share == 0) continue;
    const auto engine = engineRegistry().front().make();
    const Scene scene = flowScene(setup, packings[p], dt);
    engine->load(scene, {});
    for (const double time : timesOf(setup, p, share, span)) {
      throwIfInterrupted();
      engine->advance(flowRestart(setup, time));
      const Snapshot now = engine->snapshot(ContactReport::none);
      FlowState& state = states.emplace_back();
      state.packing = packingAt(packings[p], scene, now);
      state.start = {p, now.positionTime, state.packing.wheelAngle};
      progress(static_cast<double>(states.size()) / static_cast<double>(count));
    }
  }
  return states;
}

}  // namespace crossgrain::inline runs
