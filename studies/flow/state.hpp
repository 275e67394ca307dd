#pragma once

#include <vector>

#include "averaging/profiles.hpp"
#include "cases/case.hpp"
#include "results/flow_numbers.hpp"

/// In what state a run was while it was averaged.
namespace crossgrain::inline studies {

/// The series that say whether a run was steady. Torque and pressure are what the walls carry,
/// kinetic energy is what moves; each may drift without the others.
inline constexpr const char* watchedSeries[] = {"wheel_torque", "outer_pressure", "kinetic_energy"};

/// What a change of a mean must stay below to be called "not seen": cases allow two engines to
/// differ by a quarter in their stresses, and a drift beyond that would decide more than the
/// engines do.
inline constexpr double largestUnseenDrift = 0.25;

/// The rules and their reasons are in averaging/regime.hpp.
/// @param series  as CouetteSeries makes it
RegimeRow couetteRegime(const Case& setup, const std::vector<Profile>& profiles,
                        const RunSeries& series);

/// Of each of watchedSeries the change of its straight line over the averaged time in units of its
/// mean, with its interval at the case's confidence, and up to what size a change is not excluded.
/// A series that the engine does not show is left out.
std::vector<SeriesDrift> couetteSteadiness(const Case& setup, const RunSeries& series);

}  // namespace crossgrain::inline studies
