#include "runs/stability/step_limit_run.hpp"

#include <fmt/format.h>

#include "stability/measures.hpp"

namespace crossgrain::inline runs {

namespace {

bool staysCalm(Engine& engine, const EngineEntry& entry, const HardScene& hard, double dt) {
  constexpr double growth = 100.0;
  HardScene run = hard;
  run.duration *= dt / hard.scene.dt;
  run.scene.dt = dt;
  const Recording seen = record(engine, entry, run, [](double) {});
  if (!seen.snapshots.empty() && seen.realised.dt != dt)
    throw UnsupportedScene(fmt::format("takes time steps of its own, {:g} s", seen.realised.dt));
  if (!seen.failure.empty()) return false;  // a step far too long ends in no numbers at all
  const double start = energyOf(seen, seen.snapshots.front()).kinetic;
  for (const Snapshot& now : seen.snapshots)
    if (!(energyOf(seen, now).kinetic <= growth * start)) return false;
  return true;
}

}  // namespace

StepLimit measureStepLimit(Engine& engine, const EngineEntry& entry, const HardScene& hard,
                           const std::function<void(double)>& progress) {
  StepLimit limit;
  limit.theory = theoreticalStepLimit(hard.scene);
  limit.coordination = coordinationStepLimit(hard.scene);
  double stable = 0.1, unstable = 1.6;
  constexpr double precision = 0.005;
  if (!staysCalm(engine, entry, hard, stable * limit.theory)) return limit;
  while (unstable - stable > precision) {
    const double middle = 0.5 * (stable + unstable);
    (staysCalm(engine, entry, hard, middle * limit.theory) ? stable : unstable) = middle;
    progress(1.0 - (unstable - stable) / 1.5);
  }
  limit.measured = stable * limit.theory;
  return limit;
}

}  // namespace crossgrain::inline runs
