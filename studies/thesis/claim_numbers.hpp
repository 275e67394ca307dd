#pragma once

#include <optional>
#include <string_view>

#include "results/thesis_formula.hpp"
#include "studies/thesis/claim_evidence.hpp"

namespace crossgrain::inline studies {

/// What a claim's formulas know by name beside results/thesis_formula.hpp: the numbers of its rule,
/// those common to all rules, and of a run
///   nu_wheel_WHEN, nu_outside_WHEN, pressure_WHEN   first, begin, end (of the time in which the
///                        thesis has its cell steady) and late
///   blocked_share        of windows in which the wheel slipped over disks that stood
///   density_…            mean density of (v_φ/(ΩR_i), S d/(ΩD)) at rest, on the ridge, beside each
///   velocity_…           density of v_φ/(ΩR_i) of the first ring near 0.5 and 1, and before each
///   directions_…         density of contact directions relative to uniform, opposite ones
///   together,
///                        about an angle: tangential, shear_side, other_side in the band; left,
///                        right and least in the outermost ring. anisotropy_inside, …_outside
///   roughness            rms distance of ln v_φ from a straight line in r̃
///   spin_period          [d]
///   exponent_rp, exponent_pr   of a shear stress in r
///   divergence_trace     tr F from which on G diverges
///   model_velocity, model_spin   rms of ln(model/run), relative to the first ring, of Mohan's
///   model
///                        as printed
std::optional<FormulaValue> namedNumber(std::string_view name, const CaseRun& at,
                                        const ClaimScope& scope);

/// m at the outer wall over m at the wheel, of Mohan's model as printed.
double modelCoupleGrowth();

}  // namespace crossgrain::inline studies
