#pragma once

#include <optional>

#include "continuum/cosserat.hpp"

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
