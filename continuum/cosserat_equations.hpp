#pragma once

#include <array>
#include <functional>

#include "continuum/cosserat_parameters.hpp"

namespace crossgrain::inline continuum {

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

/// Added to s′ and m′ and, times ω, to u′ and ω′, at ξ: so a solution can be prescribed, and one
/// known integrated. Empty: nothing.
using CosseratSource = std::function<std::array<double, 4>(double xi)>;

struct ShearState {
  double s, m;
};

/// The equations with their constants worked out.
class CosseratEquations {
 public:
  /// @throws std::invalid_argument for parameters out of their range
  explicit CosseratEquations(const CosseratParameters& parameters, CosseratSource source = {});

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

  /// 9.21 and 9.22 as u′ = u/r̄ − shear (ω + u/r̄) + ω pushU, ω′ = −turn (ω + u/r̄) + ω pushOmega.
  struct FlowRule {
    double shear, turn, pushU, pushOmega;
    /// (u/ω)′ with v = u/ω, and ω′/ω.
    double ratioRate(double v, double radius) const;
    double logarithmicRate(double v, double radius) const;
  };
  FlowRule flowRule(double xi, ShearState at, double root) const;

 private:
  std::array<double, 4> sourceAt(double xi) const;

  CosseratParameters parameters_;
  CosseratSource source_;
  double sinePsi_, c_, epsilonAlpha_;
};

}  // namespace crossgrain::inline continuum
