#pragma once

#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace crossgrain::inline continuum {

/// What multiplies m′ + m/r̄ in the balance of moments (Lätzel 2003, Eq. 9.24).
enum class MomentFactor {
  printed,    ///< ε
  consistent  ///< ε L √(2(A+1)), which the definition of m in Eq. 9.18 calls for
};

constexpr double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}
constexpr double degrees(double radians) {
  return radians * 180.0 / std::numbers::pi;
}

/// Mohan's frictional Cosserat model of the steady flow between two cylinders (Lätzel 2003, chapter
/// 9), with the thesis' numbers. Lengths are in units of the gap H = R_o − R_i.
struct CosseratParameters {
  double innerRadius = 0.6916;              ///< R̄_i = R_i/H [-]
  double grainSize = 0.0536;                ///< ε = d_p/H [-]
  double lengthScale = 10.0;                ///< L, in grain diameters [-]
  double asymmetry = 1.0 / 3.0;             ///< A = a₂/a₁ of Eq. 9.8, within (−1, 1) [-]
  double internalFriction = radians(22.6);  ///< ψ of the yield condition [rad]
  double wallFriction = radians(9.8);       ///< δ: s(0) = tan δ [rad]
  double wheelVelocity = 1.0;  ///< u₀ = u(0): v_φ/(ΩR_i) of the grains at the wheel [-]
  MomentFactor momentFactor = MomentFactor::printed;
};

struct ShearState {
  double s, m;
};

/// Eqs. 9.19–9.24 of Lätzel 2003 with the plus root of the yield condition. The state at ξ = (r −
/// R_i)/H, r̄ = R̄_i + ξ, is
///
///   s = σ_rφ/σ_c, q = σ_φr/σ_c   shear stresses, *first index the normal of the face*: s and q are
///                                the stress_pr and stress_rp of averaged profiles [-]
///   m = M_rz/(d_p L √(2(A+1)) σ_c)   couple stress [-]
///   u = v_φ/(ΩR_i), ω = −spin·H/(ΩR_i)   velocity; spin, *clockwise* positive: only so does 9.21
///                                leave a rigid rotation (u = −ω r̄) at rest [-]
///
///   9.20  q = −A s + R,   R² = (A² − 1) s² − 4(A+1)² m² + 2(A+1) sin²ψ
///   9.23  s′ = −(s + q)/r̄
///   9.24  c (m′ + m/r̄) = s − q
///   9.21  u′ = u/r̄ − (ω + u/r̄) (A+1)(s + q)/R
///   9.22  ε α ω′ = −(ω + u/r̄) 2(A+1) m/R,   α = L/√(2(A+1))
///
/// They do not change if s, q, m and R all change sign. The thesis writes s(0) = −tan δ with the
/// minus root and draws positive stresses: s(0) = tan δ with the plus root and m(1) > 0, the same
/// solution. Stresses are compressive then, and the flow rule (9.13) is λ′ H/(ΩR_i) = 2(A+1) sin ψ
/// (ω + u/r̄)/R ≥ 0, which leaves no other root to a wheel that drives the grains. From 9.23 and
/// 9.24, r̄ (r̄ s − c m) is the same at every ξ.
class CosseratEquations {
 public:
  /// @throws std::invalid_argument for parameters out of their range
  explicit CosseratEquations(const CosseratParameters& parameters);

  const CosseratParameters& parameters() const { return parameters_; }
  double radius(double xi) const { return parameters_.innerRadius + xi; }
  double momentFactor() const { return c_; }          ///< c
  double sineOfFriction() const { return sinePsi_; }  ///< sin ψ
  /// s up to which the yield condition can be met at all, with m = 0.
  double largestShear() const;

  /// R²; where it is negative, no q meets the yield condition.
  double rootSquared(ShearState at) const;
  double q(ShearState at, double root) const { return root - parameters_.asymmetry * at.s; }

  /// m(1) > 0 where s(1) = q(1) = s: the other end of the model is a classical continuum.
  double outerCouple(double s) const;

  /// s′ and m′. @param root R > 0
  ShearState rates(double xi, ShearState at, double root) const;

  /// 9.21 and 9.22 as u′ = u/r̄ − shear (ω + u/r̄), ω′ = −turn (ω + u/r̄).
  struct FlowRule {
    double shear, turn;
  };
  FlowRule flowRule(ShearState at, double root) const;

 private:
  CosseratParameters parameters_;
  double sinePsi_, c_, epsilonAlpha_;
};

/// The fields at one ξ, as CosseratEquations has them.
struct CosseratPoint {
  double xi = 0.0;
  double s = 0.0, q = 0.0, m = 0.0, u = 0.0, omega = 0.0;
};

/// Polynomials of one degree on 0 ≤ ξ ≤ 1 by their values at the Chebyshev points
/// ξ_k = (1 − cos(πk/N))/2, k = 0 … N (Trefethen 2000, Spectral Methods in MATLAB, chapter 6).
class ChebyshevGrid {
 public:
  /// @param degree N ≥ 2
  explicit ChebyshevGrid(int degree);

  std::span<const double> points() const { return points_; }  ///< ascending, from 0 to 1
  std::size_t count() const { return points_.size(); }

  /// The polynomial at ξ (barycentric form).
  double at(double xi, std::span<const double> values) const;

 private:
  std::vector<double> points_, weights_;
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
  double spinRatio() const;  ///< ω(0)/u(0): an outcome, 5 conditions meet 4 functions and δ

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
  double tolerance = 1e-12;  ///< relative, of one step of the integrator
  int degree = 192;          ///< of the polynomials
};

/// Integrates inward from s(1) = q(1), where the equations are stable, with s(1) searched for so
/// that s(0) = tan δ. u and ω follow from u(1) = 0, ω(1) = 1 and are scaled to u(0) = u₀.
/// @throws std::invalid_argument for parameters out of their range
CosseratOutcome solveCosserat(const CosseratParameters& parameters,
                              const CosseratNumerics& numerics = {});

/// Wall friction for which there is a solution at all [rad].
struct WallFrictionRange {
  double lowest, highest;
};
/// Of parameters but for their wallFriction; absent if there is none at all.
std::optional<WallFrictionRange> wallFrictionRange(const CosseratParameters& parameters,
                                                   const CosseratNumerics& numerics = {});

}  // namespace crossgrain::inline continuum
