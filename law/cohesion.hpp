#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "law/contact_reference.hpp"

/// Forces of bodies that attract each other, without their dashpots, from the texts of the laws.
namespace crossgrain::inline contact_law {

/// F_po, the largest pull of DMT, 2π w R₁₂ (Derjaguin, Muller and Toporov 1975), and of JKR,
/// 3/2 π w R₁₂ (Johnson, Kendall and Roberts 1971); 0 of other laws [N].
inline double pullOff(const ContactLaw& law, double reducedRadius) {
  const double factor = law.cohesion == CohesionLaw::dmt   ? 2.0
                        : law.cohesion == CohesionLaw::jkr ? 1.5
                                                           : 0.0;
  return factor * std::numbers::pi * law.w * reducedRadius;
}

/// a_p²/R₁₂, JKR's unit of overlaps, a_p³ = 9π w R₁₂²/(8 E*) the contact's radius at the largest
/// pull, E* = 3/4 k_n [m].
template <class Real>
Real jkrUnit(const ContactLaw& law, Real reducedRadius) {
  const Real modulus = Real(0.75) * Real(law.kn);
  const Real cube = Real(9) * std::numbers::pi_v<Real> * Real(law.w) * reducedRadius *
                    reducedRadius / (Real(8) * modulus);
  const Real radius = std::cbrt(cube);
  return radius * radius / reducedRadius;
}

/// How far beyond δ = 0 surfaces go on pulling, 0 but of JKR [m]: 1/3 a_p²/R₁₂ to the largest pull,
/// 3^(2/3)/3 of it to the end of the branch, where dδ/da = 0.
template <class Real>
Real bondRange(const ContactLaw& law, Real reducedRadius) {
  if (law.cohesion != CohesionLaw::jkr) return Real(0);
  const bool branch = law.conventions.jkrEnd == JkrEnd::branch;
  return jkrUnit(law, reducedRadius) * (branch ? std::cbrt(Real(9)) : Real(1)) / Real(3);
}

/// y = √(a/a_p) of JKR's stable branch, y⁴ − 4/3 y = t with t = δ R₁₂/a_p². The quartic is
/// (y² + s y + u)(y² − s y + v) with s² = z the root of z³ + 4 t z − 16/9 = 0 (Ferrari), by Cardano
/// p − q/p with p³ − (q/p)³ = 16/9, written as a quotient so that no digits are lost; where the
/// branch ends the discriminant is 0. y is the larger root of the second factor.
template <class Real>
Real jkrRoot(Real t) {
  const Real q = Real(4) * t / Real(3);
  const Real root = std::sqrt(std::max(Real(64) / Real(81) + q * q * q, Real(0)));
  const Real p = std::cbrt(Real(8) / Real(9) + root), other = q / p;
  const Real z = Real(16) / Real(9) / (p * p + q + other * other), s = std::sqrt(z);
  return Real(0.5) * (s + std::sqrt(std::max(Real(8) / (Real(3) * s) - z, Real(0))));
}

/// k_t(δ) [N/m]: constant, or of Hertz' contact k_t a with its radius a, √(R₁₂ δ), under JKR a_p
/// y².
template <class Real>
SlopeOf<Real> tangentialStiffness(const ContactLaw& law, Real reducedRadius, Real overlap) {
  const Real kt = law.kt;
  if (law.normal != NormalLaw::hertz) return {kt, Real(0)};
  if (law.cohesion == CohesionLaw::jkr) {
    const Real unit = jkrUnit(law, reducedRadius), y = jkrRoot(overlap / unit);
    const Real width = kt * std::sqrt(unit * reducedRadius);
    const Real slope = std::max(Real(4) * y * y * y - Real(4) / Real(3), Real(1e-12));
    return {width * y * y, Real(2) * width * y / (unit * slope)};  // slope: of δ/unit by y
  }
  const Real depth = std::max(overlap, Real(0)), root = std::sqrt(reducedRadius * depth);
  return {kt * root, depth > Real(0) ? Real(0.5) * kt * root / depth : Real(0)};
}

/// A(δ) of CohesionLaw::area [m²], and dA/dδ. The lens is the circle in which spheres meet,
/// 4 d² h² = (s + d)(s − d)(d + q)(d − q), s = a_i + a_j, q = a_i − a_j, d = s − δ.
template <class Real>
SlopeOf<Real> cohesionArea(const ContactLaw& law, const CollidingPair& pair, Real overlap) {
  const Real pi = std::numbers::pi_v<Real>, a = pair.radius[0], b = pair.radius[1];
  if (law.conventions.cohesionArea != CohesionArea::lens) {
    const bool twice =
        law.conventions.cohesionArea == CohesionArea::twiceBetweenDisks && !pair.plane;
    const Real reduced = pair.plane ? a : a * b / (a + b);
    const Real slope = (twice ? Real(4) : Real(2)) * pi * reduced;
    return {slope * overlap, slope};
  }
  if (pair.plane) return {pi * overlap * (Real(2) * a - overlap), Real(2) * pi * (a - overlap)};
  const Real s = a + b, q = a - b, d = s - overlap;
  // h² = (s² + q² − d² − s² q²/d²)/4
  const Real square = d * d, product = s * s * q * q;
  return {pi * (s + d) * overlap * (d + q) * (d - q) / (Real(4) * square),
          pi * (d - product / (square * d)) / Real(2)};
}

/// δ* = k_unload/(k_unload − k_n) φ 2 R₁₂, from which on an elasto-plastic contact is elastic on
/// the line k_unload (δ − φ 2 R₁₂) (Luding 2008, Eq. 7; the branch: Singh, Magnanimo and Luding
/// 2015, section 2) [m]; 0: there is none.
template <class Real>
Real plasticLimit(const ContactLaw& law, Real reducedRadius) {
  const Real most = Real(law.kUnload) - Real(law.kn);
  return Real(law.kUnload) / most * Real(law.plasticDepth) * Real(2) * reducedRadius;
}

/// Whether an overlap is beyond δ*.
template <class Real>
bool isBeyondPlasticLimit(const ContactLaw& law, Real reducedRadius, Real overlap) {
  return law.plasticDepth > 0.0 && overlap >= plasticLimit(law, reducedRadius);
}

/// k₂(δ_max) = k_n + (k_unload − k_n) min(δ_max/δ*, 1) (Luding 2008, Eq. 8) [N/m].
template <class Real>
Real unloadingStiffness(const ContactLaw& law, Real reducedRadius, Real largest) {
  const Real most = Real(law.kUnload) - Real(law.kn);
  const Real reach = plasticLimit(law, reducedRadius);
  return Real(law.kn) + (largest < reach ? most * largest / reach : most);
}

/// δ_max to which the limit of the pull takes a contact back: its line of unloading passes through
/// (δ, −k_c δ), k₂ δ − (k₂ − k_n) δ_max = −k_c δ with k₂ of that δ_max [m].
template <class Real>
Real largestAtPull(const ContactLaw& law, Real reducedRadius, Real overlap) {
  const Real most = Real(law.kUnload) - Real(law.kn), kc = law.kc;
  const Real reach = plasticLimit(law, reducedRadius);
  if (reach > Real(0)) {
    const Real half = overlap / Real(2);
    const Real root = half + std::sqrt(half * half + (Real(law.kn) + kc) * overlap * reach / most);
    if (root < reach) return root;
  }
  return (Real(law.kUnload) + kc) * overlap / most;
}

}  // namespace crossgrain::inline contact_law
