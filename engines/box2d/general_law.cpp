#include "engines/box2d/general_law.hpp"

#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

namespace box2d_granular {
namespace {

using std::numbers::pi;

double sign(double value) {
  return (value > 0.0) - (value < 0.0);
}

double elasticForce(const SoftLaw& law, const PairMotion& motion) {
  const double depth = std::max(motion.overlap, 0.0);
  if (law.normal == Normal::linear) return law.kn * motion.overlap;
  return law.kn * std::sqrt(motion.radius() * depth) * depth;
}

double normalStiffness(const SoftLaw& law, const PairMotion& motion) {
  if (law.normal == Normal::linear) return law.kn;
  return 1.5 * law.kn * std::sqrt(motion.radius() * std::max(motion.overlap, 0.0));
}

double damping(const SoftLaw& law, double constant, double stiffness, double mass) {
  switch (law.damper) {
    case Damper::viscoelastic:
      return constant * stiffness;
    case Damper::critical:
      return constant * std::sqrt(mass * stiffness);
    case Damper::constant:
      break;
  }
  return constant;
}

double pullOff(const SoftLaw& law, double radius) {
  if (law.cohesion == Cohesion::dmt) return 2.0 * pi * law.w * radius;
  return law.cohesion == Cohesion::jkr ? 1.5 * pi * law.w * radius : 0.0;
}

/// Two spheres: the lens' circle has h² = a² − x², x = (d² + a² − b²)/2d; a sphere at a plane: x =
/// a − δ.
double areaOf(const SoftLaw& law, const PairMotion& motion) {
  const auto [a, b] = std::pair(motion.a, motion.b);
  if (law.cohesionArea == CohesionArea::lens) {
    const double d = a + b - motion.overlap;
    const double x = b > 0.0 ? (d * d + a * a - b * b) / (2.0 * d) : d;
    return pi * (a - x) * (a + x);
  }
  const bool twice = law.cohesionArea == CohesionArea::twiceBetweenDisks && b > 0.0;
  return (twice ? 4.0 : 2.0) * pi * motion.radius() * motion.overlap;
}

/// JKR: δ = a²/R − c √a with c = √(2π w/E*), E* = 3/4 k_n (Johnson, Kendall and Roberts 1971).
struct Jkr {
  double radius, modulus, c;

  Jkr(const SoftLaw& law, double r)
      : radius(r), modulus(0.75 * law.kn), c(std::sqrt(2.0 * pi * law.w / modulus)) {}

  double overlap(double root) const { return std::pow(root, 4) / radius - c * root; }
  /// √a where the branch ends, dδ/da = 0, and where the pull is largest: a³ = 9π w R²/8E*.
  double rootAtEnd() const { return std::cbrt(0.25 * c * radius); }
  double rootAtPull(double w) const {
    return std::pow(9.0 * pi * w * radius * radius / (8.0 * modulus), 1.0 / 6.0);
  }
  /// √a at an overlap, by Newton's method from above, where the polynomial is convex.
  double rootAt(double depth) const {
    double y = std::sqrt(std::sqrt(radius * std::max(depth, 0.0))) + std::cbrt(c * radius);
    const double end = rootAtEnd();
    for (int k = 0; k < 60; ++k) {
      const double slope = 4.0 * y * y * y / radius - c;
      const double next = slope > 0.0 ? std::max(y - (overlap(y) - depth) / slope, end) : end;
      if (!(next < y)) break;
      y = next;
    }
    return y;
  }
  /// 4 E* a³/3R − √(8π w E* a³).
  double force(double w, double root) const {
    const double cube = std::pow(root, 6);
    return 4.0 / 3.0 * modulus * cube / radius - std::sqrt(8.0 * pi * w * modulus * cube);
  }
};

/// k_t times the contact's radius, Hertz' or JKR's.
double tangentialStiffness(const SoftLaw& law, const PairMotion& motion) {
  if (law.normal == Normal::linear) return law.kt;
  if (law.cohesion == Cohesion::jkr) {
    const double root = Jkr(law, motion.radius()).rootAt(motion.overlap);
    return law.kt * root * root;
  }
  return law.kt * std::sqrt(motion.radius() * std::max(motion.overlap, 0.0));
}

/// Unloading by k₂(δ_max) = k_n + (k₂max − k_n) min(δ_max/δ*, 1) to δ₀ = (1 − k_n/k₂) δ_max, and on
/// −k_c δ, where δ_max falls so that the line of unloading meets the present point; beyond δ*
/// loading is elastic on the line of δ_max = δ* (Luding 2008; Singh, Magnanimo and Luding 2015).
double plasticForce(const SoftLaw& law, const PairMotion& motion, double& largest) {
  const double depth = std::max(motion.overlap, 0.0), more = law.kUnload - law.kn;
  const double full = law.kUnload / more * law.plasticDepth * 2.0 * motion.radius();  // δ*
  const auto rise = [&](double m) { return m < full ? more * m / full : more; };  // k₂ − k_n
  largest = std::max(largest, full > 0.0 ? std::min(depth, full) : depth);
  const double unloading = (law.kn + rise(largest)) * depth - rise(largest) * largest;
  if (depth > largest) return unloading;
  if (unloading >= -law.kc * depth) return std::min(unloading, law.kn * depth);
  // (k_n + r(m) + k_c) δ = r(m) m: of the limit's r, else a quadratic in m with r = more m/full.
  largest = (law.kUnload + law.kc) * depth / more;
  if (largest < full) {
    const double half = 0.5 * depth;
    largest = half + std::sqrt(half * half + (law.kn + law.kc) * depth * full / more);
    largest = std::min(largest, full);
  }
  return -law.kc * depth;
}

/// The normal force without its dashpot.
double bodyForce(const SoftLaw& law, const PairMotion& motion, PairMemory& memory) {
  switch (law.cohesion) {
    case Cohesion::area:
      return elasticForce(law, motion) - law.kc * areaOf(law, motion);
    case Cohesion::dmt:
      return elasticForce(law, motion) - pullOff(law, motion.radius());
    case Cohesion::jkr: {
      const Jkr jkr(law, motion.radius());
      return jkr.force(law.w, jkr.rootAt(motion.overlap));
    }
    case Cohesion::elastoPlastic:
      return plasticForce(law, motion, memory.largest);
    case Cohesion::none:
      break;
  }
  return elasticForce(law, motion);
}

double loadOf(const SoftLaw& law, const PairMotion& motion, double normal, double body) {
  if (law.cohesion == Cohesion::none) return normal;
  const double pull = pullOff(law, motion.radius());
  switch (law.cohesionLoad) {
    case CohesionLoad::plusTwicePullOff:
      return pull > 0.0 ? body + 2.0 * pull : normal;
    case CohesionLoad::magnitudePlusPullOff:
      return std::abs(normal) + pull;
    case CohesionLoad::netWithoutDashpot:
      return body;
    case CohesionLoad::withoutPull:
      return law.cohesion == Cohesion::elastoPlastic ? normal - std::min(body, 0.0)
                                                     : normal - body + elasticForce(law, motion);
    case CohesionLoad::net:
      break;
  }
  return normal;
}

/// A spring with a dashpot beside it and a limit.
struct Slider {
  double stiffness;  ///< what is remembered counts in
  double stretch;    ///< of this step
  double dashpot;    ///< −γ v
  bool before, outside, springOnly;

  /// @returns the force and whether it is at its bound
  std::pair<double, bool> pull(double& remembered, double bound) const {
    if (before) remembered += stretch;
    const double elastic = -stiffness * remembered, trial = elastic + dashpot;
    const double tested = outside ? elastic : trial;
    if (std::abs(tested) <= bound) {
      if (!before) remembered += stretch;
      return {trial, false};
    }
    const double force = bound * sign(tested);
    if (stiffness > 0.0) remembered = -(springOnly ? force - dashpot : force) / stiffness;
    return {force, true};
  }
};

void addTangential(const SoftLaw& law, const PairMotion& motion, double load, PairMemory& memory,
                   PairForce& force) {
  const double carrying = law.bound == Bound::compression ? std::max(load, 0.0)
                          : law.bound == Bound::magnitude ? std::abs(load)
                                                          : load;
  const double bound = law.mu * carrying, vt = motion.tangentialVelocity;
  const double stiffness = tangentialStiffness(law, motion);
  const double gt = damping(law, law.gt, stiffness, motion.mass);
  switch (law.tangential) {
    case Tangential::none:
      return;
    case Tangential::coulomb:
      force.tangential = -bound * sign(vt);
      force.sliding = true;
      return;
    case Tangential::viscous:
      force.tangential = -std::min(gt * std::abs(vt), bound) * sign(vt);
      force.sliding = gt * std::abs(vt) > bound;
      return;
    case Tangential::spring:
    case Tangential::springDashpot: {
      const bool ofForce = law.normal == Normal::hertz && law.history == History::force;
      const Slider slider{ofForce ? 1.0 : stiffness,
                          (ofForce ? stiffness : 1.0) * vt * motion.dt,
                          law.tangential == Tangential::springDashpot ? -gt * vt : 0.0,
                          law.stretchBefore,
                          law.dashpotOutsideBound,
                          law.resetSpringOnly};
      std::tie(force.tangential, force.sliding) = slider.pull(memory.spring, bound);
    }
  }
}

struct RollingArms {
  double length;     ///< L [m]
  double stiffness;  ///< k_r with what it multiplies [N m]
};

RollingArms rollingArms(const SoftLaw& law, const PairMotion& motion) {
  const auto [a, b] = std::pair(motion.a, motion.b > 0.0 ? motion.b : motion.a);
  double length = motion.radius();
  if (law.rollingLength == RollingLength::twiceEffective) length *= 2.0;
  if (law.rollingLength == RollingLength::smallerRadius) length = std::min(a, b);
  if (law.rollingLength == RollingLength::meanRadius) length = 0.5 * (a + b);
  const double square = law.rollingStiffness == RollingStiffness::lengthSquare ? length * length
                        : law.rollingStiffness == RollingStiffness::radii      ? a * b
                                                                               : 1.0;
  return {length, law.kr * square};
}

double rollingTorque(const SoftLaw& law, const PairMotion& motion, double load,
                     PairMemory& memory) {
  if (law.rolling == Rolling::none) return 0.0;
  const auto [length, stiffness] = rollingArms(law, motion);
  const double viscous = law.gr * length * length;
  if (law.rolling == Rolling::viscous) return -viscous * motion.spin;
  const double pressing = law.rollingLoad == RollingLoad::elastic     ? elasticForce(law, motion)
                          : law.rollingLoad == RollingLoad::magnitude ? std::abs(load)
                                                                      : load;
  const double bound = law.muR * length * std::max(pressing, 0.0);
  if (law.rolling == Rolling::viscousByLoad) return -bound * length * motion.spin;
  if (law.rolling == Rolling::constantTorque) return -bound * sign(motion.spin);
  const double gamma = law.rollingDamper == RollingDamper::critical
                           ? 2.0 * law.gr * std::sqrt(motion.rollingInertia * stiffness)
                           : viscous;
  const Slider slider{stiffness,         motion.spin * motion.dt,   -gamma * motion.spin,
                      law.stretchBefore, law.rollingDashpotOutside, law.rollingResetSpringOnly};
  const bool limited = law.rollingLoad != RollingLoad::whileCompressed || bound > 0.0;
  return slider.pull(memory.angle, limited ? bound : std::numeric_limits<double>::infinity()).first;
}

}  // namespace

PairForce pairForce(const SoftLaw& law, const PairMotion& motion, PairMemory& memory) {
  const double body = bodyForce(law, motion, memory);
  const double gn = damping(law, law.gn, normalStiffness(law, motion), motion.mass);
  PairForce force{body - gn * motion.normalVelocity};
  // Where tension is cut the dashpot does not pull; cohesion does.
  if (law.cutTension) force.normal = std::max(force.normal, std::min(body, 0.0));
  const double load = loadOf(law, motion, force.normal, body);
  if (law.friction()) addTangential(law, motion, load, memory, force);
  force.rolling = rollingTorque(law, motion, load, memory);
  return force;
}

double bondRange(const SoftLaw& law, double radius) {
  if (law.cohesion != Cohesion::jkr) return 0.0;
  const Jkr jkr(law, radius);
  return -jkr.overlap(law.jkrEnd == JkrEnd::branch ? jkr.rootAtEnd() : jkr.rootAtPull(law.w));
}

double storedEnergy(const SoftLaw& law, const PairMotion& motion, const PairMemory& memory) {
  const double depth = motion.overlap, elastic = elasticForce(law, motion) * depth;
  double energy = law.normal == Normal::linear ? 0.5 * elastic : 0.4 * elastic;
  if (law.cohesion == Cohesion::dmt) energy -= pullOff(law, motion.radius()) * depth;
  if (law.cohesion == Cohesion::elastoPlastic) {
    PairMemory own = memory;
    const double force = plasticForce(law, motion, own.largest);
    const double full =
        law.kUnload / (law.kUnload - law.kn) * law.plasticDepth * 2.0 * motion.radius();
    const double share = own.largest < full ? own.largest / full : 1.0;
    energy = 0.5 * force * force / (law.kn + (law.kUnload - law.kn) * share);
  }
  // By Simpson's rule over the overlap, 0 at the first touch: smooth functions of it.
  if (law.cohesion == Cohesion::area || law.cohesion == Cohesion::jkr) {
    constexpr int pieces = 32;
    energy = 0.0;
    PairMotion at = motion;
    PairMemory none;
    for (int k = 0; k <= pieces; ++k) {
      at.overlap = depth * k / pieces;
      const double weight = k == 0 || k == pieces ? 1.0 : k % 2 == 1 ? 4.0 : 2.0;
      energy += weight / 3.0 * (depth / pieces) * bodyForce(law, at, none);
    }
  }
  const double stiffness = tangentialStiffness(law, motion);
  const bool ofForce = law.normal == Normal::hertz && law.history == History::force;
  if (stiffness > 0.0)
    energy += 0.5 * memory.spring * memory.spring * (ofForce ? 1.0 / stiffness : stiffness);
  if (law.rolling == Rolling::spring)
    energy += 0.5 * rollingArms(law, motion).stiffness * memory.angle * memory.angle;
  return energy;
}

}  // namespace box2d_granular
