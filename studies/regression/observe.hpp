#pragma once

#include <functional>
#include <vector>

#include "adapters/engine_entry.hpp"
#include "studies/core/run_store.hpp"
#include "studies/regression/baseline.hpp"

/// Observation of an engine, in the same way when it is kept and when it is compared.
namespace crossgrain::inline studies {

/// One engine on one case.
struct Observed {
  Engine& engine;  ///< started
  const EngineEntry& entry;
  const Case& setup;
  double dt = 0.0;  ///< the case's [s]
};

/// Has the engine load the scene of a start, the reference constant changed by a part of itself.
/// @throws UnsupportedScene, EngineFailure, BadInput
template <int D>
EffectiveParameters loadStart(const Observed& of, const FlowState& state, double change = 0.0);

/// Runs all sweeps of cases of collisions; of a flow the one of its first pair of bodies under its
/// law. Where the engine refuses one the refusal is kept.
/// @throws EngineFailure, BadInput, Interrupted
std::vector<KeptCollisions> collisionsOf(Engine& engine, const EngineEntry& entry,
                                         const std::vector<Case>& cases);

/// Settles and averages from every start as compare does from a packing: endpoints with a margin.
/// @param dt  the case's [s]
/// @throws EngineFailure, UnsupportedScene, BadInput, Interrupted
KeptEndpoints endpointsFrom(const EngineEntry& entry, const Case& setup,
                            const std::vector<FlowState>& starts, double dt,
                            const std::function<void(double)>& progress);

/// Observes one engine from each start and in each collision.
/// @param engine  started; that of `entry`
/// @param cases   one flow, or the variants of a case of collisions
/// @param dt      of the flow [s]
/// @throws UnsupportedScene, EngineFailure, BadInput, Interrupted
BaselineEngine keepEngine(Engine& engine, const EngineEntry& entry, const std::vector<Case>& cases,
                          const std::vector<FlowState>& starts, double dt,
                          const std::function<void(double)>& progress);

/// Observes all engines named but those that refuse the case.
/// @param starts     along the flow of a case that has one
/// @param endpoints  whether each start is also run and averaged
/// @param refusals   becomes why engines refuse it that were asked for by name
/// @throws as keepEngine(), AllRefused
Baseline keepBaseline(const std::vector<Case>& cases, const RunCommand& command, std::size_t starts,
                      bool endpoints, std::vector<std::string>& refusals);

}  // namespace crossgrain::inline studies
