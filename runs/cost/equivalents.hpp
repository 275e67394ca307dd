#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "runs/cost/trajectory.hpp"
#include "runs/lockstep/starts.hpp"

/// How far a setting of an engine lies from small steps of the same engine, told in the unit of
/// lockstep: as the change of k_n that would part two runs as far, ε_eq.
namespace crossgrain::inline runs {

/// 1, 10 and 50 ms as in lockstep's windows, without their last part, in which chaos has its share
/// and which costs as much as all before, as multiples of t_c, so that steps that divide t_c are
/// all compared at the same instants. (Others are carried on with their velocities, which counts as
/// their error.) [s]
std::vector<double> windowTimes(const Case& setup);

/// One engine from each of the states, as the case has it, at those times.
/// @returns by start @throws EngineFailure, UnsupportedScene, BadInput
std::vector<Track> followStarts(Engine& engine, const EngineEntry& entry, const Case& setup,
                                const std::vector<FlowState>& states,
                                const std::vector<double>& times);

/// How far changes of k_n move each disk over the windows, by start and time; change by change [d].
using WindowResponses = std::vector<std::vector<std::vector<double>>>;

/// Of the in-house engine at the case's step. @param scenes  by start, with the law to be changed
WindowResponses windowResponses(Engine& inHouse, const std::vector<Scene>& scenes,
                                const std::vector<double>& times, double diameter);

/// ε_eq, the largest over starts and those times at which it can be read (equivalentChange()).
/// Absent where there are none.
/// @param diameter [m]
std::optional<double> equivalentOf(const std::vector<Track>& tracks,
                                   const std::vector<Track>& reference,
                                   const WindowResponses& responses, double diameter);

}  // namespace crossgrain::inline runs
