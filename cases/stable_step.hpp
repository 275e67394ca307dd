#pragma once

#include <optional>
#include <string>

#include "cases/case.hpp"

namespace crossgrain::inline cases {

/// t_c of the lightest pair that a case's own numbers allow [s]; absent for a law that has none,
/// and where the disks are a packing file's.
std::optional<double> pairContactTime(const Case& setup);

/// How long a time step the stiffest, lightest contact of a case bears: explicit schemes of second
/// order, and semi-implicit Euler, follow an oscillator of two masses up to dt = 2/ω, ω² = k/m₁₂,
/// and blow up beyond. Disks with several contacts bear less: six of them 2/(√6 ω).
struct PairStepLimit {
  double dt;           ///< 2/ω [s]
  double stiffness;    ///< k of that contact [N/m]
  double reducedMass;  ///< m₁₂ [kg]
};

/// Absent for a rigid law, whose impulses have no such limit, and for collisions, whose steps are
/// shares of their contact time. A law that stiffens is taken where an impact at the wheel's rim
/// speed is deepest. @param lightest  m₁₂ where it is known better than from the case [kg]
std::optional<PairStepLimit> pairStepLimit(const Case& setup, std::optional<double> lightest = {});

/// "run.dt = 1 s: beyond 2/ω = 0.00139 s of the stiffest, lightest contact (…)", empty if it is
/// not.
std::string whyUnstableStep(const Case& setup, double dt, const std::string& key,
                            std::optional<double> lightest = {});

/// "the time step of … is beyond what a disk with six contacts bears, 2/(√6 ω) = …": as many as a
/// triangular lattice has; empty if it is not.
std::string whyRiskyStep(const Case& setup, double dt);

}  // namespace crossgrain::inline cases
