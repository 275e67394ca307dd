#pragma once

#include <cstdint>
#include <vector>

#include "cases/packing.hpp"
#include "runs/cost/growth.hpp"
#include "runs/cost/settings.hpp"

namespace crossgrain::inline runs {

/// Where one engine has taken a packing, and what it cost.
struct Track {
  std::vector<std::vector<Vec2>> positions;  ///< at each of the times asked for [m]
  double dt = 0.0;                           ///< [s]
  double wallSeconds = 0.0, cpuSeconds = 0.0;
  std::uint64_t steps = 0, contactEvaluations = 0;
};

/// Runs one packing, from springs dropped, and samples it at the times given. The case says the
/// step.
/// @throws EngineFailure, UnsupportedScene, BadInput
Track followPacking(Engine& engine, const EngineEntry& entry, const Case& setup, const Scene& scene,
                    const std::vector<double>& times);

/// What packings' paths are held against.
struct TrajectoryReference {
  std::vector<Vec2> positions;  ///< at the window's end [m]
  double error = 0.0;           ///< distance to the same at twice the step [d]
};

/// Separation of a run from one whose positions are perturbed, at the case's own step, and how long
/// a reference of `reference` steps per t_c can be trusted.
/// @param engine  the in-house one @param coarse  the case at half the reference's steps
ChaosStudy studyChaos(Engine& engine, const EngineEntry& entry, const Case& setup, const Case& fine,
                      const Case& coarse, const Packing& packing);

/// @param fine, coarse  the case at the reference's step and at twice that
TrajectoryReference trajectoryReference(Engine& engine, const EngineEntry& entry, const Case& fine,
                                        const Case& coarse, const Packing& packing, double window);

/// One setting: how far disks are from where the engine's own reference has them
/// ("position_rms_own"), and from where the in-house engine has them ("position_rms_NAME", the
/// model included), rms in d at the window's end. The shortest time of `cost.repeats`, where a run
/// is shorter than `cost.timed`.
std::vector<CostPoint> measureTrajectory(Engine& engine, const EngineEntry& entry,
                                         const CostSetting& setting, const Packing& packing,
                                         double window, const TrajectoryReference& own,
                                         const TrajectoryReference& inHouse);

}  // namespace crossgrain::inline runs
