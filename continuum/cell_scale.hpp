#pragma once

#include <optional>
#include <span>
#include <vector>

#include "continuum/cosserat_solution.hpp"

namespace crossgrain::inline continuum {

/// What makes the model's numbers those of a cell, in the signs of averaged profiles: compression
/// positive, spin and Ω counter-clockwise, of a stress the force's index first (the model has the
/// face's first), and r(r σ_φr + M_zr) the same at every r.
struct CellScale {
  double innerRadius = 0.1032;   ///< R_i [m]
  double gap = 0.1492;           ///< H = R_o − R_i [m]
  double grainDiameter = 0.008;  ///< d_p, 8 mm in the thesis [m]
  double omega = 0.0;            ///< Ω > 0 [rad/s]
};

/// rest with R̄_i and ε as the cell has them.
CosseratParameters parametersOf(const CellScale& cell, CosseratParameters rest = {});

/// The model's fields at some radii, to be drawn with averaged ones.
struct ModelFields {
  std::vector<double> radius;    ///< [m]
  std::vector<double> velocity;  ///< v_φ/(ΩR_i) [-]
  std::vector<double> spin;      ///< −ω ΩR_i/H: clockwise [rad/s]
  std::vector<double> stressPr;  ///< σ_φr, the model's σ_rφ [N/m²]
  std::vector<double> stressRp;  ///< σ_rφ, the model's σ_φr [N/m²]
  /// M_zr, the model's −M_rz: of that sign is a couple that 9.24 balances with σ_rφ − σ_φr [N/m]
  std::vector<double> coupleZr;
};

/// @param sigmaC  σ_c, the normal stress [N/m²]
/// @param radii   between R_i and R_i + H [m]
/// @throws std::invalid_argument for a radius beyond these
ModelFields fieldsIn(const CellScale& cell, const CosseratSolution& solution, double sigmaC,
                     std::span<const double> radii);

/// Averages of one ring near the wheel.
struct RingStress {
  double radius = 0.0;        ///< of its centre [m]
  double rr = 0.0, pp = 0.0;  ///< σ_rr, σ_φφ [N/m²]
  double rp = 0.0, pr = 0.0;  ///< σ_rφ, σ_φr [N/m²]
  double coupleZr = 0.0;      ///< M_zr [N/m]
};

/// The frictions with which the model has a ring's stresses.
struct FittedFriction {
  double wallFriction;      ///< δ [rad]
  double internalFriction;  ///< ψ [rad]
  double sigmaC;            ///< σ_c = (σ_rr + σ_φφ)/2, which the model has equal [N/m²]
  double s, q, m;           ///< of the ring, as the model has them
};

/// ψ is the angle of the yield condition that the ring's own s, q and m meet,
///   sin²ψ = (s² + q² + 2A s q + 4(A+1)² m²)/(2(A+1))   (9.19),
/// and tan δ is σ_φr/σ_c at the wheel, to where the balance of moments carries the ring's:
///   R_i (R_i σ_φr(R_i) + M_zr) = r (r σ_φr + M_zr), with M_zr at the wheel as in the ring.
/// @param rest  its R̄_i, ε, L and A are used
/// Absent if σ_c or σ_φr are not positive, or more than any ψ yields with.
std::optional<FittedFriction> frictionOf(const RingStress& ring, const CellScale& cell,
                                         const CosseratParameters& rest = {});

}  // namespace crossgrain::inline continuum
