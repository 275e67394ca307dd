#include "studies/effects/step_times.hpp"

#include <algorithm>
#include <cmath>

#include "averaging/agreement.hpp"
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

/// Between two samples of the engine's times [s]: processor time, as other programs that have the
/// core meanwhile add to the wall time; wall time of an engine that does not report it.
double timeBetween(const Stats& before, const Stats& after) {
  const double cpu = after.cpuSeconds - before.cpuSeconds;
  return cpu > 0.0 ? cpu : after.wallSeconds - before.wallSeconds;
}

/// About how long a step takes [s]: of the last of stretches that double until one takes `target`,
/// for the first steps may be slow.
double roughStep(const TimedVariant& variant, double target) {
  constexpr std::uint64_t most = 1 << 20;
  const auto engine = variant.start();
  const double dt = variant.load(*engine, 0);
  std::uint64_t steps = 0, stretch = 16;
  for (;; stretch *= 2) {
    steps += stretch;
    const Stats before = engine->stats();
    engine->advance(static_cast<double>(steps) * dt);
    const double took = timeBetween(before, engine->stats());
    if (took >= target || stretch >= most) return took / static_cast<double>(stretch);
  }
}

void timeOnce(const TimedVariant& variant, std::uint64_t steps, int round, StepTimes& times) {
  const auto engine = variant.start();
  const double dt = variant.load(*engine, round);
  const std::uint64_t warmUp = steps / 2;
  engine->advance(static_cast<double>(warmUp) * dt);
  const Stats before = engine->stats();
  engine->advance(static_cast<double>(warmUp + steps) * dt);
  const Stats after = engine->stats();
  const auto done = static_cast<double>(after.steps - before.steps);
  times.seconds.push_back(timeBetween(before, after) / done);
  if (after.contactEvaluations > before.contactEvaluations)
    times.contacts =
        static_cast<double>(after.contactEvaluations - before.contactEvaluations) / done;
}

}  // namespace

std::vector<StepTimes> timeSteps(const std::vector<TimedVariant>& variants, const TimingPlan& plan,
                                 const std::function<void(double)>& progress) {
  std::vector<StepTimes> times(variants.size());
  double most = 1.0;
  for (std::size_t k = 0; k < variants.size(); ++k)
    unlessFailed(times[k], [&] {
      const double step = roughStep(variants[k], plan.seconds / 4.0);
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
