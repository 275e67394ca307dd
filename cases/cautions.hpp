#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cases/case.hpp"
#include "cases/packing.hpp"

namespace crossgrain::inline cases {

/// Consequences of a case that are hardly meant, one line each: it loads, and it runs.
/// Too few steps in a contact, a gas where a flow was wanted, squeezed disks, a rate that stresses
/// depend on, nothing that could be judged.
/// @param volumeFraction  of a Couette case's disks, ν̄
std::vector<std::string> cautions(const Case& setup, double volumeFraction);

/// Consequences of a Couette case, from its own numbers alone: right to a factor of two
/// or three, to tell a gas from a flow and a flow from squeezed disks before anything runs.

/// ν̄ without the layer at the walls that no disk's area reaches: ν̄ H/(H − 2t), H = R_o − R_i, with
/// t the depth of the wall disks as a small disk feels them and 0.17 d of looser layering on each
/// side.
double bulkVolumeFraction(const Case& setup, double volumeFraction);

/// Where trial runs of two cells and two wall spacings (thesis-facts, section 6) turned from a gas
/// into a flow (0.828); and what none of them flowed at (0.85: ν̄ = 0.82 in the thesis' cell, which
/// it calls blocked from 0.81). In terms of bulkVolumeFraction().
inline constexpr double dilutedBelow = 0.828, squeezedAbove = 0.85;

/// Mean pressure of disks pressed together, p = (k_n tr F/2πh)·(ν/ν_c − 1) with tr F = 4ν (Lätzel
/// 2003, section 7.3, mean field) [N/m²]; absent below dilutedBelow and for laws without k_n.
std::optional<double> expectedPressure(const Case& setup, double bulk);

/// γ̇ d √(ρ/p) at the wheel with γ̇ = Ω R_i/2d: half of the rim's speed is lost in the first disk.
/// Absent where the pressure is.
std::optional<double> expectedInertialNumber(const Case& setup, double bulk);

/// Four contacts a disk: the cell filled with a square lattice of as many disks as the case has,
/// all of one size, at rest. To time a step with; nothing else may be learnt from it.
Packing madeUpPacking(const Case& setup);

}  // namespace crossgrain::inline cases
