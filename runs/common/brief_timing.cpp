#include "runs/common/brief_timing.hpp"

#include "runs/common/worker_memory.hpp"

namespace crossgrain::inline runs {

BriefTiming briefTiming(Engine& engine, const EngineEntry& entry, const Case& setup,
                        const Scene& scene) {
  constexpr double enough = 0.1;  // s of steps
  constexpr int warmUp = 5, most = 2000;
  BriefTiming timing;
  timing.realised = loadScene(engine, entry, setup, scene);
  const double dt = timing.realised.dt;
  engine.advance(warmUp * dt);
  const double before = engine.stats().wallSeconds;
  double spent = 0.0;
  for (int more = 5; timing.steps < most && spent < enough; more *= 2) {
    timing.steps += more;
    engine.advance((warmUp + timing.steps) * dt);
    spent = engine.stats().wallSeconds - before;
  }
  timing.secondsPerStep = spent / timing.steps;
  timing.memory = mostMemoryOf(engine);
  return timing;
}

}  // namespace crossgrain::inline runs
