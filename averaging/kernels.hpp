#pragma once

namespace crossgrain::inline averaging {

/// Coarse-graining functions of one coordinate, φ(x) = φ(−x) with ∫φ dx = 1 (as MercuryCG, Weinhart
/// et al. 2012, 2016, Comput. Phys. Commun. 249:107165, has them where it resolves one direction):
///
///   heaviside  1/2c                              for |x| < c
///   lucy       5/4c (1 − 6r² + 8r³ − 3r⁴)        for r = |x|/c < 1 (Lucy 1977)
///   gauss      exp(−x²/2w²)/(√(2π) w) for |x| < c = 3w, over erf(3/√2) = .9973 of what is left
enum class Kernel { heaviside, lucy, gauss };

/// One of them, by its first two antiderivatives: all that bins between planes need.
class KernelIn1d {
 public:
  /// @param width  c of heaviside and lucy, w of gauss [m]
  KernelIn1d(Kernel kind, double width);

  double reach() const { return reach_; }  ///< c [m]

  /// φ [1/m]: for tests, and for whoever wants to see it.
  double density(double x) const;

  /// ∫ φ up to x: the part of what stands at 0 that lies below x [-]
  double below(double x) const;

  /// Mean of below(x − y) over y from y1 to y2: the part, below x, of what is spread evenly over a
  /// line [-]. With below's antiderivative Ψ, [Ψ(x − y1) − Ψ(x − y2)]/(y2 − y1).
  double lineBelow(double x, double y1, double y2) const;

 private:
  double integral(double x) const;  ///< Ψ(x) = ∫ below up to x [m]

  Kernel kind_;
  double width_, reach_;
};

}  // namespace crossgrain::inline averaging
