#pragma once

#include <vector>

#include "adapters/engine.hpp"
#include "averaging/distributions.hpp"
#include "averaging/layer_spin.hpp"
#include "averaging/profiles.hpp"
#include "averaging/wall_balance.hpp"
#include "cases/case.hpp"
#include "results/flow_numbers.hpp"

namespace crossgrain::inline studies {

/// The wheel's surface speed and the spin that rolls on it, as the thesis scales distributions.
DistributionScales distributionScales(const Case& setup);

/// Numbers that are there, and their mean; absent without any.
std::vector<double> presentNumbers(const Numbers& values);
std::optional<double> meanOf(const Numbers& values);

/// The dimensionless numbers that say what kind of flow a run was: inertial number, k_n/p,
/// overlaps/d, sliding fraction, stress ratio at the wheel, contacts of the wheel, its slip and
/// what layers take up of its rotation, dt/t_c, coordination.
std::vector<HeadNumber> headNumbers(const Case& setup, const std::vector<Profile>& profiles,
                                    const RunSeries& series, const EffectiveParameters& effective);

/// Fits of one run's profiles and what theory or the thesis expects of them.
std::vector<FitRow> couetteFits(const Case& setup, const std::vector<Profile>& profiles);

/// The fit of the spin's oscillation from layer to layer.
std::vector<FitRow> spinFits(const Case& setup, const LayerSpin& spin);

/// Balance of a steady state, ring by ring: the torque at every ring is
/// the wheel's, σ_rr in the outermost ring is what the pressure on the ring calls for.
/// @param wall  one for each entry of the series' outer_pressure, or none: then that is not checked
std::vector<CheckRow> couetteChecks(const Case& setup, const std::vector<Profile>& profiles,
                                    const RunSeries& series,
                                    const std::vector<WallBalance>& wall = {});

/// The series that say whether a run was steady. Torque and pressure are what the walls carry,
/// kinetic energy is what moves; each may drift without the others.
inline constexpr const char* watchedSeries[] = {"wheel_torque", "outer_pressure", "kinetic_energy"};

/// Bound below which a change of a mean is called "not seen": cases allow two engines to
/// differ by a quarter in their stresses, and a drift beyond that would decide more than the
/// engines do.
inline constexpr double largestUnseenDrift = 0.25;

/// The rules and their reasons are in averaging/regime.hpp.
/// @param series  as CouetteAverages makes it
RegimeRow couetteRegime(const Case& setup, const std::vector<Profile>& profiles,
                        const RunSeries& series);

/// Of each of watchedSeries the change of its straight line over the averaged time in units of its
/// mean, with its interval at the case's confidence, and up to what size a change is not excluded.
/// A series that the engine does not show is left out.
std::vector<SeriesDrift> couetteSteadiness(const Case& setup, const RunSeries& series);

}  // namespace crossgrain::inline studies
