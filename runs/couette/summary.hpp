#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "adapters/engine.hpp"
#include "averaging/distributions.hpp"
#include "averaging/layer_spin.hpp"
#include "averaging/profiles.hpp"
#include "averaging/wall_balance.hpp"
#include "cases/case.hpp"

namespace crossgrain::inline runs {

/// The wheel's surface speed and the spin that rolls on it, as the thesis scales distributions.
DistributionScales distributionScales(const Case& setup);

/// ρ of a small disk [kg/m³].
double diskDensity(const Case& setup);

/// The dimensionless numbers that say what kind of flow a run was, as results.json's "head":
/// inertial number, k_n/p, overlaps/d, sliding fraction, stress ratio at the wheel, contacts of
/// the wheel, its slip and what layers take up of its rotation, dt/t_c, coordination.
nlohmann::json headNumbers(const Case& setup, const std::vector<Profile>& profiles,
                           const nlohmann::json& series, const Realised& realised);

/// Fits of one run's profiles and what theory or the thesis expects of them, as "fits".
nlohmann::json couetteFits(const Case& setup, const std::vector<Profile>& profiles);

/// The fit of the spin's oscillation from layer to layer, as further "fits".
nlohmann::json spinFits(const Case& setup, const LayerSpin& spin);

/// What must hold in a steady state, ring by ring, as "checks": the torque carried at every ring is
/// the wheel's, σ_rr in the outermost ring is what the pressure on the ring calls for.
/// @param wall  one for each entry of the series' outer_pressure, or none: then that is not checked
nlohmann::json couetteChecks(const Case& setup, const std::vector<Profile>& profiles,
                             const nlohmann::json& series,
                             const std::vector<WallBalance>& wall = {});

}  // namespace crossgrain::inline runs
