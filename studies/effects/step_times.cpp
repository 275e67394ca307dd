#include "studies/effects/step_times.hpp"

#include <algorithm>
#include <cmath>

#include "averaging/agreement.hpp"
#include "studies/core/engine_running.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline studies {

namespace {

/// Does `work` unless the variant has failed before; notes if it fails now.
template <typename Work>
void unlessFailed(StepTimes& times, Work&& work) {
  throwIfInterrupted();
  if (!times.failure.empty()) return;
  try {
    work();
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& error) {
    times.failure = error.what();
    times.refused = dynamic_cast<const UnsupportedScene*>(&error) != nullptr;
    times.seconds.clear();
  }
}

void timeOnce(const TimedVariant& variant, std::uint64_t steps, int round, StepTimes& times) {
  const auto engine = variant.start();
  const double dt = variant.load(*engine, round);
  const std::uint64_t warmUp = steps / 2;
  engine->advance(static_cast<double>(warmUp) * dt);
  const Stats before = engine->stats();
  engine->advance(static_cast<double>(warmUp + steps) * dt);
  const StepCost cost = costBetween(before, engine->stats());
  times.seconds.push_back(cost.processor);
  if (cost.contacts) times.contacts = cost.contacts;
}

}  // namespace

std::vector<StepTimes> timeSteps(const std::vector<TimedVariant>& variants, const TimingPlan& plan,
                                 const std::function<void(double)>& progress) {
  std::vector<StepTimes> times(variants.size());
  double most = 1.0;
  for (std::size_t k = 0; k < variants.size(); ++k)
    unlessFailed(times[k], [&] {
      const auto engine = variants[k].start();
      const double dt = variants[k].load(*engine, 0);
      const double step = briefSteps(*engine, dt, plan.seconds / 4.0, 1 << 20).processor;
      if (step > 0.0) most = std::max(most, plan.seconds / step);
    });
  const auto steps = static_cast<std::uint64_t>(std::ceil(std::min(most, 1e8)));
  const auto turns = static_cast<double>(variants.size()) * plan.rounds;
  double done = 0.0;
  for (int round = 0; round < plan.rounds; ++round)
    for (std::size_t k = 0; k < variants.size(); ++k) {
      unlessFailed(times[k], [&] { timeOnce(variants[k], steps, round, times[k]); });
      progress(++done / turns);
    }
  return times;
}

namespace {

std::optional<EnsembleMean> overRounds(const std::vector<double>& rounds) {
  return ensembleMean(std::vector<std::optional<double>>(rounds.begin(), rounds.end()));
}

}  // namespace

std::optional<double> meanStep(const StepTimes& time) {
  const auto mean = overRounds(time.seconds);
  return mean ? std::optional(mean->mean) : std::nullopt;
}

std::optional<TimeRatio> timeRatio(const StepTimes& time, const StepTimes& whole) {
  std::vector<double> ratios;
  for (std::size_t k = 0; k < std::min(time.seconds.size(), whole.seconds.size()); ++k)
    if (whole.seconds[k] > 0.0) ratios.push_back(time.seconds[k] / whole.seconds[k]);
  const auto mean = overRounds(ratios);
  return mean ? std::optional(TimeRatio{mean->mean, mean->standardError}) : std::nullopt;
}

}  // namespace crossgrain::inline studies
