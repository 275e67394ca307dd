#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "faults.hpp"

/// Hertz' law, rolling resistance and cohesion, as law/contact_law.hpp defines them, worked
/// out once more from their sources.
namespace crossgrain::planted {

enum class Rolling { none, constantTorque, viscous, spring };
enum class Cohesion { none, area, dmt, jkr, elastoPlastic };

/// Besides what the thesis' law has. [SI units]
struct Resistance {
  bool hertz = false;
  Rolling rolling = Rolling::none;
  double kr = 0.0, gr = 0.0, muR = 0.0;
  Cohesion cohesion = Cohesion::none;
  double kc = 0.0, w = 0.0, k2 = 0.0, depth = 0.0;
};

/// State that a contact keeps between steps.
struct Memory {
  double spring = 0.0;   ///< ξ [m]
  double angle = 0.0;    ///< θ [rad]
  double deepest = 0.0;  ///< δ_max of a plastic contact [m]; of JKR's 1 while it is bonded
  double rest = 0.0;     ///< δ₀ of a plastic contact whose k₂ lags [m]
  double age = 0.0;      ///< steps since it began
  double slid = 0.0;     ///< 1 once it has
};

/// A disk of radius a on one of radius b; b = 0: on a plane.
struct Touching {
  double a, b, overlap;

  double radius() const { return b > 0.0 ? a * b / (a + b) : a; }  ///< R₁₂ [m]
};

/// Johnson, Kendall and Roberts (1971) with E* = 3/4 k_n and s² the radius of the contact:
/// δ = s⁴/R − √(2π w/E*) s. Newton's method from above, where that is convex. @returns s [√m]
inline double jkrRoot(double kn, double w, double radius, double overlap) {
  const double modulus = 0.75 * kn;
  const double slope = radius * std::sqrt(2.0 * std::numbers::pi * w / modulus);
  double s = std::pow(std::max(overlap, 0.0) * radius, 0.25) + std::cbrt(slope);
  for (int k = 0; k < 60; ++k) {
    const double value = s * s * s * s - slope * s - radius * overlap;
    const double next = s - value / (4.0 * s * s * s - slope);
    if (!(next < s)) break;
    s = next;
  }
  return s;
}

/// F = 4 E* s⁶/(3 R) − √(8π w E*) s³.
inline double jkrForce(double kn, double w, double radius, double overlap) {
  const double modulus = 0.75 * kn, s = jkrRoot(kn, w, radius, overlap);
  const double cube = s * s * s;
  return 4.0 / 3.0 * modulus / radius * cube * cube -
         std::sqrt(8.0 * std::numbers::pi * w * modulus) * cube;
}

/// a_p²/(3 R) with a_p³ = 9π w R²/(8 E*): how far apart surfaces are at the largest pull [m].
inline double jkrReach(double kn, double w, double radius) {
  const double width = std::cbrt(1.5 * std::numbers::pi * w * radius * radius / kn);
  return width * width / (3.0 * radius);
}

/// Luding (2008), Eqs. 6 to 8: between k_n δ and −k_c δ along k₂ (δ − δ₀), elastic beyond δ*.
inline double plasticForce(double kn, const Resistance& law, const Touching& pair,
                           double& deepest) {
  const double overlap = std::max(pair.overlap, 0.0), most = law.k2 - kn;
  const double limit = law.k2 / most * law.depth * 2.0 * pair.radius();
  const auto unloading = [&](double largest) {
    return kn + most * (largest < limit ? largest / limit : 1.0);
  };
  deepest = std::max(deepest, limit > 0.0 ? std::min(overlap, limit) : overlap);
  const double k2 = unloading(deepest);
  const double force = k2 * overlap - (k2 - kn) * deepest;
  if (overlap > deepest) return force;
  if (force >= -law.kc * overlap) return std::min(force, kn * overlap);
  // δ_max falls so that the line of unloading passes through (δ, −k_c δ).
  const double growth = limit > 0.0 ? most / limit : 0.0;
  const double half = 0.5 * growth * overlap;
  const double root =
      limit > 0.0 ? (half + std::sqrt(half * half + growth * (kn + law.kc) * overlap)) / growth
                  : 0.0;
  deepest = limit > 0.0 && root < limit ? root : (law.k2 + law.kc) * overlap / most;
  return -law.kc * overlap;
}

/// As plasticForce(), but k₂ is that of the δ_max before this step, and δ₀ what came of it then.
inline double laggedPlasticForce(double kn, const Resistance& law, const Touching& pair,
                                 Memory& kept) {
  const double overlap = std::max(pair.overlap, 0.0), most = law.k2 - kn;
  const double limit = law.k2 / most * law.depth * 2.0 * pair.radius();
  const double k2 = kn + most * std::min(kept.deepest / limit, 1.0);
  const auto remember = [&](double deepest) {
    kept.deepest = deepest;
    kept.rest = std::min((1.0 - kn / k2) * deepest, law.depth * 2.0 * pair.radius());
  };
  if (overlap > kept.deepest) remember(overlap);
  const double unloads = k2 * (overlap - kept.rest), loads = kn * overlap;
  if (unloads >= loads) return overlap < limit ? loads : unloads;
  if (unloads > -law.kc * overlap) return unloads;
  remember(overlap * (k2 + law.kc) / (k2 - kn));
  return -law.kc * overlap;
}

/// Area of the lens of two spheres: π (a² − x²), x from the centre of the first to its plane [m²].
inline double lensArea(const Touching& pair) {
  const double d = pair.a + pair.b - pair.overlap;
  const double x = pair.b > 0.0 ? (d * d + pair.a * pair.a - pair.b * pair.b) / (2.0 * d)
                                : pair.a - pair.overlap;
  return std::numbers::pi * (pair.a * pair.a - x * x);
}

struct NormalParts {
  double elastic, whole;  ///< f_el, and the normal force without its dashpot [N]
};

inline NormalParts normalParts(double kn, const Resistance& law, const Touching& pair, bool wall,
                               const Faults& faults, Memory& kept) {
  const double radius = pair.radius() * (pair.b > 0.0 ? 1.0 : faults.hertzPlaneRadius);
  const double root = std::sqrt(radius * std::max(pair.overlap, 0.0));
  const double elastic = law.hertz ? kn * root * pair.overlap : kn * pair.overlap;
  const double part = faults.pull * (wall ? faults.pullAtWalls : 1.0);
  switch (part > 0.0 ? law.cohesion : Cohesion::none) {
    case Cohesion::area:
      return {elastic, elastic - part * law.kc * lensArea(pair)};
    case Cohesion::dmt:
      return {elastic, elastic - part * 2.0 * std::numbers::pi * law.w * pair.radius()};
    case Cohesion::jkr:
      return {elastic, jkrForce(kn, part * law.w, pair.radius(), pair.overlap)};
    case Cohesion::elastoPlastic: {
      if (faults.forgetDeepest != 0.0) kept.deepest = 0.0;
      const double force = faults.lagDeepest != 0.0 ? laggedPlasticForce(kn, law, pair, kept)
                                                    : plasticForce(kn, law, pair, kept.deepest);
      if (faults.pullForgets != 0.0 && force < 0.0) kept.deepest = 0.0;
      return {elastic, force};
    }
    case Cohesion::none:
      break;
  }
  return {elastic, elastic};
}

/// Whether the two touch: under JKR's law also as far apart as a bond reaches that there is.
inline bool touches(double kn, const Resistance& law, const Touching& pair, const Faults& faults,
                    const Memory& kept) {
  if (pair.overlap > 0.0) return true;
  if (law.cohesion != Cohesion::jkr || kept.deepest == 0.0 || faults.letsGo != 0.0) return false;
  return pair.overlap > -jkrReach(kn, faults.pull * law.w, pair.radius());
}

/// M on i under that load, and θ a step further (Iwashita and Oda 1998; Ai et al. 2011).
inline double rollingTorque(const Resistance& law, const Touching& pair, double load, double spin,
                            double dt, const Faults& faults, double& angle) {
  if (law.rolling == Rolling::none) return 0.0;
  const double length = faults.rollLength * pair.radius();
  const double viscous = -law.gr * length * length * spin;
  if (law.rolling == Rolling::viscous) return viscous;
  const double bound = law.muR * length * std::max(load, 0.0);
  const auto bounded = [bound](double torque) { return std::clamp(torque, -bound, bound); };
  if (law.rolling == Rolling::constantTorque) return spin > 0.0 ? -bound : spin < 0.0 ? bound : 0.0;
  const bool before = faults.springBefore != 0.0;
  const double stretched = angle + dt * spin;
  const double stiffness = law.kr * length * length;
  const double elastic = -stiffness * (before ? stretched : angle);
  const double trial = elastic + viscous;
  const bool holds = std::abs(faults.rollDashpotOutside != 0.0 ? elastic : trial) <= bound;
  const double torque = holds ? trial : bounded(faults.rollDashpotOutside != 0.0 ? elastic : trial);
  if (holds)
    angle = stretched;
  else
    angle = -(faults.rollSpringOnly != 0.0 ? torque - viscous : torque) / stiffness;
  return torque;
}

}  // namespace crossgrain::planted
