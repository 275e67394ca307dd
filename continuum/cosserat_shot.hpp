#pragma once

#include <optional>

#include "continuum/cosserat_solution.hpp"

namespace crossgrain::inline continuum {

/// What comes of integrating the stresses inward from s(1) = q(1).
struct CosseratShot {
  bool reached = false;     ///< ξ = 0, on the yield surface all the way
  double wheelShear = 0.0;  ///< s(0), if reached
  double lostAt = 0.0;      ///< ξ where R fell to 0, if not
};
CosseratShot shootStresses(const CosseratEquations& equations, double outerShear, double tolerance);

/// All fields at the points of a grid, with u(0) as the parameters have it. Absent where
/// shootStresses() does not reach ξ = 0, and where ω changes sign.
std::optional<CosseratSolution::Values> shootFields(const CosseratEquations& equations,
                                                    double outerShear, const ChebyshevGrid& grid,
                                                    double tolerance);

/// s(1) of shots that reach the wheel: one interval, with s(0) rising within it.
struct ShotRange {
  double lowest, highest;                      ///< s(1)
  double lowestWheelShear, highestWheelShear;  ///< s(0) there
};
/// The interval but for up to a tenth of a decade at both ends, which takes some ten shots.
std::optional<ShotRange> coarseShotRange(const CosseratEquations& equations, double tolerance);
/// The interval to its ends, within 1e-9 of s(1).
std::optional<ShotRange> wholeShotRange(const CosseratEquations& equations, double tolerance);

}  // namespace crossgrain::inline continuum
