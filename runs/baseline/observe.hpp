#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "adapters/engine.hpp"
#include "adapters/engine_entry.hpp"
#include "cases/case.hpp"
#include "runs/baseline/kept_collisions.hpp"
#include "runs/lockstep/starts.hpp"
#include "runs/lockstep/window.hpp"

/// What is looked at of an engine, in the same way when it is kept and when it is compared.
namespace crossgrain::inline runs {

/// One engine on one case.
struct Observed {
  Engine& engine;  ///< started
  const EngineEntry& entry;
  const Case& setup;
  double dt = 0.0;  ///< the case's [s]
};

/// Has the engine load the scene of a start, the yardstick changed by a part of itself.
/// @throws UnsupportedScene, EngineFailure, BadInput
Realised loadStart(const Observed& of, const FlowState& state, double change = 0.0);

/// The scene of collisions that one sweep of a case makes.
struct SweepOfCase {
  Case setup;
  double dt = 0.0;  ///< [s]
};

/// Of cases of collisions all sweeps; of a Couette case the one of two small disks under its law.
std::vector<SweepOfCase> sweepsOf(const std::vector<Case>& cases);

/// Runs one; where the engine refuses it the refusal is kept.
/// @throws EngineFailure, BadInput
KeptCollisions collisionsOf(Engine& engine, const EngineEntry& entry, const SweepOfCase& sweep);

}  // namespace crossgrain::inline runs
