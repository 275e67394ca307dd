#pragma once

#include "averaging/fields.hpp"

/// The formulas of the thesis that take more than one line of the table of fields.
namespace crossgrain::inline averaging::formulas {

// Tensors of one bin [N/m², but for fabric: 1]
LinearTensor stress(const BinView& bin);        ///< with the wall disks' part
LinearTensor movingStress(const BinView& bin);  ///< of the moving disks alone
LinearTensor dynamicStress(const BinView& bin);
LinearTensor fabric(const BinView& bin);

/// σ_fluct = Σ w m (v − u)⊗(v − u)/V with u = Σ w m v/Σ w m the bin's mean velocity, which is the
/// dynamic stress less ρ u⊗u.
LinearTensor fluctuationStress(const BinView& bin);

/// The micro-mechanical stress with the terms in ω̇ and ω² (Lätzel 2003, section 7.3, derived anew:
/// README.md): sym σ + the dynamic stress.
LinearTensor fullStress(const BinView& bin);

/// ε = (πh/V) Σ w Σ_c Δ⊗l · F⁻¹, Δ = δ n^c (Lätzel 2003, Eq. 7.88 with prefactor 1, such that equal
/// overlaps δ of equal disks give (δ/a) I).
LinearTensor strain(const BinView& bin);

Linear bulkModulus(const BinView& bin);   ///< E = tr σ/tr ε, of the moving disks
Linear shearModulus(const BinView& bin);  ///< G = dev σ/dev ε, of the moving disks

/// σ = ε₀ E [I + G* ε₁ R(φ) diag(1, −1) Rᵀ(φ)] (Lätzel 2003, Eqs. 7.105–7.109) with ε₀ = tr ε/2,
/// ε₁ = dev ε/tr ε, G* = G/E, φ = (φ_ε + φ_F)/2 and E = k_n tr F/2πh.
LinearTensor predictedStress(const BinView& bin);

/// k_n tr F/2πh, what E would be in mean field.
Linear meanFieldModulus(const BinView& bin);

/// (κ_zr, κ_zφ) = (πh/V) Σ w Σ_c (l × Δ)_z l · F⁻¹ (Lätzel 2003, section 8.2), Δ = δ n^c + ξ s with
/// ξ = −f_t/k_t: the spring that holds f_t alone.
std::pair<Linear, Linear> curvature(const BinView& bin);

Linear azimuthalVelocity(const BinView& bin);

}  // namespace crossgrain::inline averaging::formulas
