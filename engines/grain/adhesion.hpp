#pragma once

#include "engines/grain/law_types.hpp"
#include "engines/grain/stiffness.hpp"

namespace grain {

// The part of the normal force that is no dashpot's, where bodies attract each other. `L` as in
// contact_force.hpp.

/// A(δ) [m²]. @see CohesionArea
/// Lens: π/4 (s² − d²)(d² − q²)/d² with s = a_i + a_j, q = a_i − a_j, d = s − δ; q² = s² − 4 R₁₂ s.
template <class L, class Real>
GRAIN_INLINE Real cohesionArea(const L& law, const ContactMotion<Real>& contact) {
  const Real pi = Real(3.14159265358979323846);
  const bool plane = contact.reach == Real(0);
  const Real first = pi * contact.radius * contact.overlap;
  if (plane) {
    const Real cap = pi * (contact.radius + contact.radius - contact.overlap) * contact.overlap;
    return law.lens * cap + law.walls * first;
  }
  const Real d = contact.reach - contact.overlap;
  const Real square = d * d;
  const Real beyond = square - contact.reach * (contact.reach - Real(4) * contact.radius);
  const Real lens = Real(0.25) * pi * contact.overlap * (contact.reach + d) * beyond / square;
  return law.lens * lens + law.disks * first;
}

/// ∫ A dδ [m³].
template <class L, class Real>
Real cohesionVolume(const L& law, const ContactMotion<Real>& contact) {
  const Real pi = Real(3.14159265358979323846), overlap = contact.overlap;
  const bool plane = contact.reach == Real(0);
  if (law.conventions.cohesionArea != CohesionArea::lens)
    return Real(0.5) * cohesionArea(law, contact) * overlap;
  if (plane) return pi * overlap * overlap * (contact.radius - overlap / Real(3));
  const Real s = contact.reach, d = s - overlap;
  const Real q = s * (s - Real(4) * contact.radius);  // q²
  const Real integral = (s * s + q) * overlap - (s * s * s - d * d * d) / Real(3) +
                        s * s * q * (Real(1) / s - Real(1) / d);
  return Real(0.25) * pi * integral;
}

/// F_po [N].
template <class L, class Real>
GRAIN_INLINE Real pullOff(const L& law, const ContactMotion<Real>& contact) {
  const Real pi = Real(3.14159265358979323846);
  const Real factor = law.cohesion == CohesionLaw::jkr ? Real(1.5) : Real(2);
  return factor * pi * law.w * contact.radius;
}

/// A contact under JKR. With the radius of the contact at the largest pull,
///   a_p³ = 9π w R²/(8 E*), R = R₁₂, E* = 3/4 k_n,
/// and y = √(a/a_p): F = F_po (y⁶ − 2 y³), δ = (a_p²/R) (y⁴ − 4/3 y) (Johnson, Kendall and Roberts
/// 1971). y >= 3^(−1/3), where the branch ends; the largest pull is at y = 1.
template <class Real>
struct JkrContact {
  Real depth;  ///< a_p²/R, the unit of δ [m]
  Real y;
};

/// How deep beyond its geometric end such a contact is, in units of a_p²/R, when it parts.
GRAIN_INLINE double jkrEnd(JkrEnd end) {
  return end == JkrEnd::largestPull ? 1.0 / 3.0 : 0.69336127435063470485;  // 3^(2/3)/3
}

template <class L, class Real>
GRAIN_INLINE Real jkrDepth(const L& law, Real radius) {
  const Real a =
      cubeRoot(Real(1.5) * Real(3.14159265358979323846) * law.w * radius * radius / law.kn);
  return a * a / radius;
}

/// How far apart surfaces are when they part [m].
template <class L, class Real>
GRAIN_INLINE Real jkrRange(const L& law, Real radius) {
  return static_cast<Real>(jkrEnd(law.conventions.jkrEnd)) * jkrDepth(law, radius);
}

/// y⁴ − 4/3 y = δ/depth by Newton's method from above, where the left side is convex: it falls from
/// guess to guess and never passes the root. The guess is the parabola at the end of the branch, or
/// for deep contacts the fourth root.
template <class L, class Real>
GRAIN_INLINE JkrContact<Real> jkrContact(const L& law, const ContactMotion<Real>& contact) {
  const Real yEnd = Real(0.69336127435063470485), atZero = Real(1.10064241629820);
  const Real depth = jkrDepth(law, contact.radius);
  const Real target = larger(contact.overlap / depth, -yEnd);
  const Real parabola = yEnd + squareRoot(larger(target + yEnd, Real(0)) / (Real(6) * yEnd * yEnd));
  const Real deep = atZero + squareRoot(squareRoot(larger(target, Real(0))));
  // At the end of the branch the slope is 0: rounding over less than this would be a step beyond.
  const Real leastSlope = sizeof(Real) == sizeof(double) ? Real(1e-7) : Real(1e-3);
  Real y = smaller(parabola, deep);
  for (int k = 0; k < 8; ++k) {
    const Real cube = y * y * y;
    const Real slope = larger(Real(4) * cube - Real(4) / Real(3), leastSlope);
    y = larger(y - (y * cube - Real(4) / Real(3) * y - target) / slope, yEnd);
  }
  return {depth, y};
}

template <class L, class Real>
GRAIN_INLINE Real jkrRadius(const L& law, const ContactMotion<Real>& contact) {
  const JkrContact<Real> jkr = jkrContact(law, contact);
  return squareRoot(jkr.depth * contact.radius) * jkr.y * jkr.y;
}

template <class Real>
struct PlasticContact {
  Real force;      ///< [N]
  Real stiffness;  ///< k₂ of unloading [N/m]
};

/// k₂ = k_n + (k₂max − k_n) min(δ_max/δ*, 1), δ* = k₂max/(k₂max − k_n) φ 2 R₁₂ (Luding 2008, Eqs. 7
/// and 8). φ = 0: k₂max, with no δ*.
template <class Real>
struct PlasticConstants {
  Real kn, most;  ///< k_n, k₂max − k_n [N/m]
  Real depth;     ///< δ* · most [N]; 0: there is no δ*

  template <class L>
  GRAIN_INLINE PlasticConstants(const L& law, Real radius)
      : kn(law.kn), most(law.k2 - law.kn), depth(Real(2) * law.plasticDepth * radius * law.k2) {}
  GRAIN_INLINE Real stiffness(Real largest) const {
    return kn + (largest * most < depth ? most * (largest * most / depth) : most);
  }
  /// Whether an overlap is beyond δ*, on the limit branch.
  GRAIN_INLINE bool isBeyond(Real overlap) const {
    return depth > Real(0) && overlap * most > depth;
  }
};

/// δ_max grows with the overlap up to δ*, beyond which the contact is elastic on its limit branch,
/// k₂max (δ − δ₀) with the δ₀ of δ*; it falls where the limit of the pull is reached, so that the
/// line of unloading passes through (δ, −k_c δ) (Luding 2008, Eqs. 6 to 8; the limit branch: Singh,
/// Magnanimo and Luding 2015, section 2, and every implementation that was read):
///   f = k_n δ where k₂ (δ − δ₀) >= k_n δ and δ <= δ*, −k_c δ where it is below that, else
///   k₂ (δ − δ₀), δ₀ = (1 − k_n/k₂) δ_max.
/// With k₂ = k_n + g δ_max, which changes with δ_max, the line through (δ, −k_c δ) is that of the
/// root of g δ_max² − g δ δ_max − (k_n + k_c) δ = 0.
template <class L, class Real>
GRAIN_INLINE PlasticContact<Real> plasticContact(const L& law, const ContactMotion<Real>& contact,
                                                 Real& largest) {
  const Real overlap = larger(contact.overlap, Real(0));
  const PlasticConstants<Real> plastic(law, contact.radius);
  const Real most = plastic.most, depth = plastic.depth;
  largest = larger(largest, overlap);
  if (plastic.isBeyond(largest)) largest = depth / most;
  const Real k2 = plastic.stiffness(largest);
  const Real unloading = k2 * overlap - (k2 - law.kn) * largest;
  const Real loading = law.kn * overlap, pull = -law.kc * overlap;
  if (unloading < pull) {
    const Real growth = depth > Real(0) ? most * most / depth : Real(0);
    const Real half = Real(0.5) * growth * overlap;
    const Real root =
        growth > Real(0)
            ? (half + squareRoot(half * half + growth * (law.kn + law.kc) * overlap)) / growth
            : Real(0);
    const bool grows = growth > Real(0) && root * most < depth;
    largest = grows ? root : (law.k2 + law.kc) * overlap / most;
    return {pull, plastic.stiffness(largest)};
  }
  return {overlap > largest ? unloading : smaller(unloading, loading), k2};
}

/// UnloadingStiffness::lagged, step by step as YADE's Law2_ScGeom_LudingPhys_Basic: k₂ is that of
/// the δ_max that the step finds, `rest` the δ₀ of both when δ_max changed; the pull has its limit
/// only while the bodies part. The first evaluation of all has no step before: it loads by k_n,
/// with the δ₀ of what it finds.
template <class L, class Real>
GRAIN_INLINE Real laggedPlasticForce(const L& law, const ContactMotion<Real>& contact,
                                     Real& largest, Real& rest) {
  const Real overlap = larger(contact.overlap, Real(0));
  const PlasticConstants<Real> plastic(law, contact.radius);
  if (!(plastic.depth > Real(0))) return plasticContact(law, contact, largest).force;
  const Real limit = Real(2) * law.plasticDepth * contact.radius;  // δ₀ of δ*
  const bool first = !(law.halfStep > Real(0));
  const Real k2 = plastic.stiffness(first ? larger(largest, overlap) : largest);
  const auto remember = [&](Real newLargest) {
    largest = newLargest;
    rest = smaller((Real(1) - law.kn / k2) * newLargest, limit);
  };
  if (overlap > largest) remember(overlap);
  const Real unloading = k2 * (overlap - rest);
  const Real loading = law.kn * overlap, pull = -law.kc * overlap;
  if (first) return loading;
  if (unloading >= loading) return overlap * plastic.most < plastic.depth ? loading : unloading;
  if (unloading > pull || !(contact.normalVelocity > Real(0))) return unloading;
  remember(overlap * (k2 + law.kc) / (k2 - law.kn));
  return pull;
}

/// The normal force without its dashpot. @param memory  the largest overlap of an elastoPlastic
/// contact, updated; else not looked at
template <class L, class Real>
GRAIN_INLINE Real bodyForce(const L& law, const ContactMotion<Real>& contact, Real& memory) {
  if (law.cohesion == CohesionLaw::area)
    return elasticForce(law, contact) - law.kc * cohesionArea(law, contact);
  if (law.cohesion == CohesionLaw::dmt) return elasticForce(law, contact) - pullOff(law, contact);
  if (law.cohesion == CohesionLaw::jkr) {
    const JkrContact<Real> jkr = jkrContact(law, contact);
    const Real cube = jkr.y * jkr.y * jkr.y;
    return pullOff(law, contact) * (cube - Real(2)) * cube;
  }
  if (law.cohesion == CohesionLaw::elastoPlastic) return plasticContact(law, contact, memory).force;
  return elasticForce(law, contact);
}

/// The load that stands for f_n in a bound. @see CohesionLoad
template <class L, class Real>
GRAIN_INLINE Real boundLoad(const L& law, const ContactMotion<Real>& contact, Real normal,
                            Real body) {
  if (law.cohesion == CohesionLaw::none) return normal;
  if (law.cohesion == CohesionLaw::area)
    return law.net * normal - law.lessPull * (body - elasticForce(law, contact)) +
           law.size * magnitude(normal) + law.body * body;
  const CohesionLoad load = law.conventions.cohesionLoad;
  if (load == CohesionLoad::net) return normal;
  if (load == CohesionLoad::netWithoutDashpot) return body;
  const bool hasPullOff = law.cohesion == CohesionLaw::dmt || law.cohesion == CohesionLaw::jkr;
  if (load == CohesionLoad::plusTwicePullOff)
    return hasPullOff ? body + Real(2) * pullOff(law, contact) : normal;
  if (load == CohesionLoad::magnitudePlusPullOff)
    return magnitude(normal) + (hasPullOff ? pullOff(law, contact) : Real(0));
  if (law.cohesion == CohesionLaw::elastoPlastic) return normal - smaller(body, Real(0));
  return normal - (body - elasticForce(law, contact));
}

/// Energy of the elastic, or recoverable, normal force and of the bond, 0 at the first touch [J].
/// JKR: F_po a_p²/R [2/5 y¹⁰ − 4/3 y⁷ + 2/3 y⁴], less that at δ = 0.
template <class L, class Real>
Real bodyEnergy(const L& law, const ContactMotion<Real>& contact, Real memory) {
  if (law.cohesion == CohesionLaw::area)
    return storedEnergy(law, contact, Real(0)) - law.kc * cohesionVolume(law, contact);
  if (law.cohesion == CohesionLaw::dmt)
    return storedEnergy(law, contact, Real(0)) - pullOff(law, contact) * contact.overlap;
  if (law.cohesion == CohesionLaw::jkr) {
    const JkrContact<Real> jkr = jkrContact(law, contact);
    const auto integral = [](Real y) {
      const Real cube = y * y * y;
      return y * cube * (cube * (Real(0.4) * cube - Real(4) / Real(3)) + Real(2) / Real(3));
    };
    return pullOff(law, contact) * jkr.depth * (integral(jkr.y) - integral(Real(1.10064241629820)));
  }
  if (law.cohesion == CohesionLaw::elastoPlastic) {
    const PlasticContact<Real> plastic = plasticContact(law, contact, memory);
    return Real(0.5) * plastic.force * plastic.force / plastic.stiffness;
  }
  return storedEnergy(law, contact, Real(0));
}

}  // namespace grain
