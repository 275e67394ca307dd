#pragma once

#include <optional>

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"
#include "averaging/rings.hpp"

namespace crossgrain::inline averaging {

/// Stress that the pressure of the outer wall calls for in the outermost ring, r₁ ≤ r ≤ R_o, of
/// width Δr and mean radius r_m, from forces that act along their branches (the lines from centres
/// to contacts).
///
/// Branches end in the middle of the overlap. Those of the averaged fields are a disk's radius
/// long, which adds the overlap, of the force's mean over the diameter: some tenths of a per cent
/// for k_n/p of 300.
///
/// Such a stress carries the force on: at rest d(r σ_rr)/dr = σ_φφ at every r, and r σ_rr = R_o P
/// at R_o, with P = Σ f_r/(2πR_o h) over the wall's contacts (radialPressure()). Integrated inward
/// from R_o and averaged over the ring's area,
///
///   σ̄_rr = P R_o/r_m − 1/(r_m Δr) ∫ (r − r₁) σ_φφ dr.
///
/// A field averaged with weights that spread the stress of a disk over its area (slicing) need not
/// obey that: in the bulk disks stand everywhere and what one ring is given too much another lacks,
/// but next to a wall all disks stand alike. A chain of small disks of radius a that begins g
/// inside R_o, cut by r₁ at the depth c = g + 2a − Δr of its first disk, has the fraction c/2a of
/// that disk's branches below r₁, but only (θ − sin θ)/2π, cos ½θ = 1 − c/a, of its area: slicing
/// puts (2a/Δr)(c/2a − (θ − sin θ)/2π) of the thrust into the ring on top, up to 5.5 % at Δr = 1.01
/// d. Oblique chains begin less deep and give less.
struct WallBalance {
  double alongBranches = 0.0;  ///< σ̄_rr [N/m²]
  double hoopTerm = 0.0;       ///< 1/(r_m Δr) ∫ (r − r₁) σ_φφ dr [N/m²]
};

/// Absent without contacts in the snapshot.
/// @throws std::out_of_range if the snapshot lacks disks or wall disks that its contacts name
std::optional<WallBalance> outerWallBalance(const Rings& rings, const Scene& scene,
                                            const Snapshot& snapshot);

}  // namespace crossgrain::inline averaging
