#include "studies/stability/recorder.hpp"

#include "adapters/suitability.hpp"
#include "cases/assembly_scene.hpp"
#include "cases/collision_scene.hpp"
#include "cases/couette.hpp"
#include "cases/time_step.hpp"
#include "stability/measures.hpp"
#include "studies/core/engine_running.hpp"
#include "studies/flow/run.hpp"

namespace crossgrain::inline studies {

HardScene plainScene(const Case& setup, const Packing& packing) {
  const double dt = timeStep(setup);
  switch (setup.kind) {
    case CaseKind::assembly:
      return {&setup, assemblyScene(setup), assemblyDuration(setup)};
    case CaseKind::collision:
      return {&setup, collisionScene(setup, collisionStarts(setup), dt),
              dt + 2.5 * impactTimes(setup).longest + 20.0 * dt};
    case CaseKind::couette:
      break;
  }
  return {&setup, couetteScene(setup, packing, dt),
          (setup.averaging.settleRotations + setup.averaging.rotations) * rotationTime(setup)};
}

HardScene hardScene(const Case& setup, const Packing& packing) {
  HardScene hard = plainScene(setup, packing);
  hard.scene.energyLedger =
      setup.run.energyLedger || stabilityMeasure(setup.stability->measure).takesLedger;
  return hard;
}

Recording record(Engine& engine, const EngineEntry& entry, const HardScene& hard,
                 const std::function<void(double)>& progress) {
  const Case& setup = *hard.setup;
  Recording run{
      hard.scene,
      {},
      {},
      {},
      setup.stability->settle,
      setup.assembly.placement,
      setup.kind == CaseKind::collision ? collisionStarts(setup) : std::vector<CollisionStart>{},
      lawAsRun(engine.capabilities(), hard.scene.law)};
  try {
    run.effective = loadScene(engine, entry, setup, hard.scene);
    run.snapshots.push_back(engine.snapshot(ContactReport::none));
    const int samples = setup.stability->samples;
    double now = 0.0;
    for (int k = 1; k <= samples; ++k) {
      const double next = hard.duration * k / samples;
      advanceInPieces(engine, run.effective, now, next);
      now = next;
      run.snapshots.push_back(engine.snapshot(ContactReport::instant));
      progress(static_cast<double>(k) / samples);
    }
  } catch (const EngineFailure& failure) {
    run.failure = failure.what();
  }
  return run;
}

}  // namespace crossgrain::inline studies
