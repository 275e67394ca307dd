#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adapters/effects.hpp"
#include "cases/case.hpp"

namespace crossgrain::inline cases {

/// The effects that a Couette case calls for.
Effects effectsOf(const Case& setup);

/// A Couette case with one thing switched off, or set to its simpler law, by a fragment of TOML.
/// All else is as it was, the preparation of packings included.
struct EffectSwitch {
  std::string name;  ///< an effect's, or "tension_cut", "double_precision": as in effects.csv
  std::string what;  ///< one sentence on what was switched
  std::optional<Effect> effect;  ///< that the case then lacks, if it is one
  Case without;
  std::string fragment = {};  ///< that makes `without` of the case: see caseWith()
};

/// Every switch that the case has, which was read by loadCase(), in the order of reports:
/// - normal damping: γ_n = 0;  friction: no tangential force, and so no rotation and no springs;
/// - tangential spring: the viscous law where γ_t > 0, else Coulomb's;
/// - tangential damping: the spring alone; of the viscous law its limit γ_t → ∞, Coulomb's;
/// - rotation: no spins;  bottom friction: no plate;  bottom spin friction: the plate leaves
///   spins alone;
/// - rolling resistance, cohesion: no such torque, no attraction;  pairs of materials: the law of
///   those that are not named for all;
/// - tension (f_n < 0 cut off); double precision (single instead).
std::vector<EffectSwitch> effectSwitches(const Case& setup);

}  // namespace crossgrain::inline cases
