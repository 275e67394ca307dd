#pragma once

#include <nlohmann/json.hpp>

#include "averaging/profiles.hpp"
#include "cases/case.hpp"

/// In what state a run was while it was averaged: pieces of a run in results.json.
namespace crossgrain::inline runs {

/// The series that say whether a run was steady. Torque and pressure are what the walls carry,
/// kinetic energy is what moves; each may drift without the others.
inline constexpr const char* watchedSeries[] = {"wheel_torque", "outer_pressure", "kinetic_energy"};

/// What a change of a mean must stay below to be called "not seen": cases allow two engines to
/// differ by a quarter in their stresses, and a drift beyond that would decide more than the
/// engines do.
inline constexpr double largestUnseenDrift = 0.25;

/// "regime": {name | null, reason, wheel_contacts, wheel_slip, shear_share, inertial_number,
/// blocked_share}. The rules and their reasons are in averaging/regime.hpp.
/// @param series  as CouetteSeries makes it
nlohmann::json couetteRegime(const Case& setup, const std::vector<Profile>& profiles,
                             const nlohmann::json& series);

/// "steadiness": of each of watchedSeries {quantity, verdict "drifts" | "no drift seen" | "cannot
/// tell", change, half_width, excluded}: the change of its straight line over the averaged time in
/// units of its mean, with its interval at the case's confidence, and up to what size a change is
/// not excluded. A series that the engine does not show is left out.
nlohmann::json couetteSteadiness(const Case& setup, const nlohmann::json& series);

}  // namespace crossgrain::inline runs
