#include "runs/baseline/observe.hpp"

#include <cmath>

#include "cases/collision_scene.hpp"
#include "cases/couette.hpp"
#include "cases/time_step.hpp"
#include "runs/collide/sweep.hpp"
#include "runs/common/engine_access.hpp"
#include "runs/cost/collision.hpp"
#include "runs/lockstep/terms.hpp"

namespace crossgrain::inline runs {

Realised loadStart(const Observed& of, const FlowState& state, double change) {
  Scene scene = couetteScene(of.setup, state.packing, of.dt);
  if (change != 0.0) changeYardstick(scene.law, change);
  return loadScene(of.engine, of.entry, of.setup, scene);
}

std::vector<SweepOfCase> sweepsOf(const std::vector<Case>& cases) {
  std::vector<SweepOfCase> sweeps;
  for (const Case& setup : cases) {
    if (setup.kind == CaseKind::couette)
      sweeps.push_back({collisionOf(setup), timeStep(setup)});
    else
      for (const double dt : collisionTimeSteps(setup)) sweeps.push_back({setup, dt});
  }
  return sweeps;
}

KeptCollisions collisionsOf(Engine& engine, const EngineEntry& entry, const SweepOfCase& sweep) {
  const Case& setup = sweep.setup;
  KeptCollisions kept;
  kept.name = setup.name;
  kept.variant = setup.variant;
  kept.dt = sweep.dt;
  const std::vector<CollisionStart> starts = collisionStarts(setup);
  for (const CollisionStart& start : starts) {
    kept.psi.push_back(start.psi);
    kept.vn.push_back(start.vn);
  }
  const Scene scene = collisionScene(setup, starts, sweep.dt);
  Outcomes outcomes;
  try {
    const Realised realised = loadScene(engine, entry, setup, scene);
    outcomes = sweepOutcomes(engine, entry, setup, scene, realised, starts, /*watch=*/true);
  } catch (const UnsupportedScene& refusal) {
    kept.refusal = refusal.what();
    return kept;
  }
  const CollidingPair pair = collidingPair(setup);
  for (const CollisionQuantity& quantity : scoredQuantities()) {
    std::vector<std::optional<double>> values;
    bool any = false;
    for (std::size_t k = 0; k < outcomes.size(); ++k) {
      auto value =
          outcomes[k] ? quantity.scoredValue(*outcomes[k], pair, starts[k].vn) : std::nullopt;
      if (value && !std::isfinite(*value)) value.reset();
      any |= value.has_value();
      values.push_back(value);
    }
    if (any) kept.values[std::string(quantity.name)] = std::move(values);
  }
  return kept;
}

}  // namespace crossgrain::inline runs
