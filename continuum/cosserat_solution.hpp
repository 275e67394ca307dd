#pragma once

#include <optional>
#include <string>
#include <vector>

#include "continuum/chebyshev.hpp"
#include "continuum/cosserat_equations.hpp"

namespace crossgrain::inline continuum {

/// The fields at one ξ, as CosseratEquations has them.
struct CosseratPoint {
  double xi = 0.0;
  double s = 0.0, q = 0.0, m = 0.0, u = 0.0, omega = 0.0;
  double root = 0.0;        ///< R > 0
  double multiplier = 0.0;  ///< λ′ H/(ΩR_i) of the flow rule [-]
};

/// How far the fields are from their equations: the largest |left − right| over ξ, each in units of
/// the sum of its terms' sizes at that ξ. Derivatives are those of the polynomials through the
/// fields, taken at the points and half-way between: not the integrator's, nor only where a
/// collocation has made them hold.
struct CosseratResiduals {
  double yield = 0.0;     ///< 9.19
  double flow = 0.0;      ///< 9.21
  double rotation = 0.0;  ///< 9.22
  double momentum = 0.0;  ///< 9.23
  double moment = 0.0;    ///< 9.24
  double wheel = 0.0;     ///< s(0) − tan δ and u(0) − u₀, the larger
  double outer = 0.0;     ///< s(1) − q(1) and u(1)
  double largest() const;
};

/// A solution: polynomials of s, m, u/ω and ln ω. The latter two vary by little where u and ω fall
/// by many decades, and keep the digits of the smallest.
class CosseratSolution {
 public:
  struct Values {
    std::vector<double> s, m, ratio, logOmega;  ///< at the points of the grid
  };
  CosseratSolution(CosseratEquations equations, ChebyshevGrid grid, Values values);

  CosseratPoint at(double xi) const;  ///< 0 ≤ ξ ≤ 1
  const CosseratParameters& parameters() const { return equations_.parameters(); }
  const ChebyshevGrid& grid() const { return grid_; }
  double spinRatio() const;        ///< ω(0)/u(0): an outcome, 5 conditions meet 4 functions and δ
  double smallestRoot() const;     ///< of R at the grid's points
  double leastMultiplier() const;  ///< of λ′ there; < 0 would be work taken from friction
  CosseratResiduals residuals() const;
  /// r̄ (r̄ s − c m), the torque that every cylinder carries, at ξ. Of a source's: not constant.
  double torque(double xi) const;

 private:
  CosseratEquations equations_;
  ChebyshevGrid grid_;
  Values values_;
};

enum class CosseratFailure {
  none,
  beyondYield,            ///< tan δ is more than the yield condition allows with any couple
  tooLittleWallFriction,  ///< R would reach 0 within the gap: yield cannot be met everywhere
  tooMuchWallFriction,    ///< the same, at the wheel
  noConvergence           ///< the numbers did not settle; says nothing of the model
};

/// A solution, or why there is none.
struct CosseratOutcome {
  std::optional<CosseratSolution> solution;
  CosseratFailure failure = CosseratFailure::none;
  std::string reason;  ///< a sentence; empty with a solution
};

struct CosseratNumerics {
  double tolerance = 1e-12;  ///< relative, of one step of the integrator; of Newton's last step
  int degree = 192;          ///< of the polynomials
};

/// Integrates inward from s(1) = q(1), where the equations are stable, with s(1) searched for so
/// that s(0) = tan δ. u and ω follow from u(1) = 0, ω(1) = 1 and are scaled to u(0) = u₀.
/// @throws std::invalid_argument for parameters out of their range
CosseratOutcome solveByShooting(const CosseratParameters& parameters,
                                const CosseratNumerics& numerics = {},
                                const CosseratSource& source = {});

/// The same by another route: collocation at Chebyshev points, from the stresses of a classical
/// continuum (s = q ∝ r⁻²) with Newton's method.
/// @throws std::invalid_argument for parameters out of their range
CosseratOutcome solveByCollocation(const CosseratParameters& parameters,
                                   const CosseratNumerics& numerics = {},
                                   const CosseratSource& source = {});

/// Wall friction for which there is a solution at all [rad].
struct WallFrictionRange {
  double lowest, highest;
};
/// Of parameters but for their wallFriction; absent if there is none at all.
std::optional<WallFrictionRange> wallFrictionRange(const CosseratParameters& parameters,
                                                   const CosseratNumerics& numerics = {});

/// δ with which ω(0)/u₀ is the one given [rad], which is how the thesis chose its 9.8°. Absent if
/// no δ well within the range of solutions has
/// it.
std::optional<double> wallFrictionForSpin(const CosseratParameters& parameters, double spinRatio,
                                          const CosseratNumerics& numerics = {});

}  // namespace crossgrain::inline continuum
