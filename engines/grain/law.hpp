#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "engines/grain/real.hpp"

namespace grain {

/// The elastic part of the normal force, f_el(δ).
enum class Normal {
  linear,  ///< k_n δ
  hertz,  ///< k_n √R₁₂ δ^(3/2), k_n = 4/3 E₁₂ [Pa]; the tangential stiffness is k_t √(R₁₂ δ)
  polynomial,  ///< k_n δ² + k_n3 δ³ [N/m², N/m³]
  /// No elastic part: rigid disks, impulses within the step that finds them touching and
  /// approaching (impacts.hpp). For semi-implicit Euler steps, in which f dt is an impulse.
  impulse
};
/// Attraction of the bodies of a contact. F_po is the largest pull, w the work of adhesion [J/m²],
/// w = 2 γ of two equal surfaces.
enum class Cohesion {
  none,
  area,  ///< f_el(δ) − k_c A(δ), k_c [Pa]: linear cohesion. @see CohesionArea
  dmt,   ///< f_el(δ) − F_po, F_po = 2π w R₁₂ (Derjaguin, Muller and Toporov 1975)
  /// Instead of Hertz' force, from the first touch until JkrEnd (Johnson, Kendall and Roberts 1971;
  /// adhesion.hpp): contacts last beyond their geometric end. F_po = 3/2 π w R₁₂.
  jkr,
  /// Piecewise linear, with memory: loading by k_n, unloading by k₂(δ_max) > k_n, pull up to k_c δ
  /// (Walton and Braun 1986, k_c = 0; Luding 2008, Eqs. 6 to 8; adhesion.hpp).
  elastoPlastic
};
/// A: the lens of two spheres at that distance, π (a² − h²) of a sphere at a plane; 2π R₁₂ δ, to
/// first order the same; or twice that of two disks and as much at a plane.
enum class CohesionArea { lens, firstOrder, twiceBetweenDisks };
/// Until when surfaces that part pull under JKR: the largest pull, or the end of the branch.
enum class JkrEnd { largestPull, branch };
/// What stands for f_n in Coulomb's bound and in that of rolling: f_n; f_n without the pull; f_n
/// without its dashpot + 2 F_po, by which a contact without load slips at µ F_po; |f_n| + F_po; or
/// f_n without its dashpot.
enum class CohesionLoad {
  net,
  withoutPull,
  plusTwicePullOff,
  magnitudePlusPullOff,
  netWithoutDashpot
};

/// k₂ of an elastoPlastic contact: of δ_max in this step; or of that in the step before, and δ₀ as
/// it was worked out when δ_max changed last (YADE; laggedPlasticContact()).
enum class UnloadingStiffness { current, lagged };

struct CohesionConventions {
  CohesionArea area = CohesionArea::lens;
  JkrEnd end = JkrEnd::largestPull;
  CohesionLoad load = CohesionLoad::withoutPull;
  UnloadingStiffness unloading = UnloadingStiffness::current;

  bool operator==(const CohesionConventions&) const = default;
};

/// What a dashpot's constant multiplies besides the velocity; S is f_el′(δ), or the tangential
/// stiffness.
enum class Damper {
  constant,   ///< 1
  stiffness,  ///< S: viscoelastic bodies, γ [s] (Brilliantov et al. 1996): e falls with the speed
  critical    ///< √(m₁₂ S): γ [-]; e does not depend on the speed (Tsuji et al. 1992)
};
/// What a contact remembers while k_t changes with the overlap.
enum class History {
  displacement,  ///< ξ: f* = −k_t(δ) ξ
  force  ///< the force itself, which grows by −k_t(δ) v_t dt (Mindlin and Deresiewicz 1953)
};
enum class Tangential { none, coulomb, viscous, spring, springDashpot };
enum class Bound { compression, magnitude, signedForce };  ///< µ times max(f_n,0), |f_n| or f_n
enum class Lever {
  radius,
  contactPoint,
  overlapMiddle
};  ///< a_i, a_i − δ a_j/(a_i + a_j), a_i − δ/2
/// What an arm is at a plane unless it is the radius: a_i − δ, a_i − δ/2, a_i.
enum class PlaneLever { surface, middle, radius };
enum class Damping { lagged, predicted, implicit };
enum class Stretch { after, before, midpoint };  ///< when ξ += v_t dt, relative to the force
/// The part of v_t dt that ξ has grown by when the force is evaluated.
template <class Real>
GRAIN_INLINE constexpr Real partBefore(Stretch when) {
  return when == Stretch::after ? Real(0) : when == Stretch::before ? Real(1) : Real(0.5);
}
/// Resistance of a contact against the relative spin ω_r = ω_i − ω_j of its bodies: a torque M on i
/// and −M on j (the types of Ai et al. 2011). L is a length, N a load. @see RollingConventions
enum class Rolling {
  none,
  constantTorque,  ///< A: M = −µ_r L N sign(ω_r)
  viscous,         ///< B: M = −γ_r L² ω_r
  viscousByLoad,   ///< B: M = −µ_r L N · L ω_r, µ_r [s/m] (Zhou et al. 1999)
  spring  ///< C: M* = −k_r θ − γ_r L² ω_r with θ = ∫ω_r dt, limited to µ_r L N
};
/// L; R₁₂ = a_i a_j/(a_i + a_j), at a plane a_i.
enum class RollingLength { effective, twiceEffective, smallerRadius, meanRadius };
/// k_r of a spring: its constant times L², times a_i a_j, or as it is [N m].
enum class RollingStiffness { lengthSquare, radii, constant };
/// What a rolling spring's dashpot is: γ_r L² with γ_r [kg/s], or 2 η √(I k_r) with η [-] and
/// 1/I = Σ 1/(J + m a²) over the bodies that move.
enum class RollingDamper { constant, critical };
/// N: max(f_n, 0), |f_n|, or the elastic part of f_n alone; whileCompressed: as the first, but
/// where it is 0 a spring has no limit.
enum class RollingLoad { compression, magnitude, elastic, whileCompressed };

/// What engines differ in that resist rolling alike.
struct RollingConventions {
  RollingLength length = RollingLength::effective;
  RollingStiffness stiffness = RollingStiffness::lengthSquare;
  RollingDamper damper = RollingDamper::constant;
  RollingLoad load = RollingLoad::compression;
  bool dashpotOutsideBound = false;  ///< hold only the spring's torque against the bound, which
                                     ///< alone is left while it slips
  bool resetSpringOnly = false;  ///< on slip spring and dashpot, not the spring, carry the bound

  bool operator==(const RollingConventions&) const = default;
};

enum class Integrator { positionVerlet, velocityVerlet, semiImplicitEuler };

/// The contact law and its conventions.
///
/// n points from j to i, s = z × n, overlap δ = a_i + a_j − |x_i − x_j|;
/// v_n = (v_i − v_j)·n, v_t = (v_i − v_j)·s − (c_i ω_i + c_j ω_j); the force on i is f_n n + f_t s,
/// its torque −l_i f_t.
struct Law {
  double kn = 0.0;   ///< [N/m] or as `normal` says
  double kn3 = 0.0;  ///< k_n3 of a polynomial [N/m³]
  double gn = 0.0;   ///< [kg/s] or as `damper` says
  double kt = 0.0;   ///< [N/m]; with Hertz 8 G₁₂ [Pa]
  double gt = 0.0;   ///< [kg/s] or as `damper` says
  double mu = 0.0;   ///< [-]
  double en = 1.0;   ///< restitution of impulses, along the normal [-]
  double et0 = 0.0;  ///< and along the tangent, while they stick [-]
  Normal normal = Normal::linear;
  Damper damper = Damper::constant;
  History history = History::displacement;
  Tangential tangential = Tangential::none;
  Bound bound = Bound::compression;
  bool cutTension = false;
  bool dashpotOutsideBound = false;  ///< hold only the spring's force against the bound
  bool resetSpringOnly = false;  ///< on slip spring and dashpot, not the spring, carry the bound
  Lever lever = Lever::radius;   ///< l
  std::optional<Lever> velocityLever;  ///< c, if it is another one
  PlaneLever planeLever = PlaneLever::surface;
  Stretch stretch = Stretch::after;
  Damping damping = Damping::predicted;
  Cohesion cohesion = Cohesion::none;
  double kc = 0.0;  ///< area: [Pa]; elastoPlastic: the stiffness of the pull [N/m]
  double w = 0.0;   ///< dmt, jkr [J/m²]
  double k2 = 0.0;  ///< elastoPlastic: the largest stiffness of unloading [N/m]
  /// elastoPlastic: φ, the largest δ₀/(2 R₁₂), from which on it is elastic with k₂ [-]; 0: k₂ from
  /// the beginning, and no largest
  double plasticDepth = 0.0;
  CohesionConventions cohesionConventions;
  Rolling rolling = Rolling::none;
  double kr = 0.0;   ///< rolling stiffness [N/m], of RollingStiffness::constant [N m]
  double gr = 0.0;   ///< rolling damping [kg/s] or as RollingDamper says
  double muR = 0.0;  ///< [-], of Rolling::viscousByLoad [s/m]
  RollingConventions rollingConventions;

  /// Whether contacts remember more than their springs: a bond, or their largest overlap.
  bool remembers() const {
    return cohesion == Cohesion::jkr || cohesion == Cohesion::elastoPlastic;
  }
  /// Whether they remember δ₀ besides.
  bool remembersRest() const {
    return cohesion == Cohesion::elastoPlastic &&
           cohesionConventions.unloading == UnloadingStiffness::lagged;
  }
  /// Whether any torque acts on disks.
  bool turnsDisks() const { return friction() || rolling != Rolling::none; }
  bool rollingSprings() const { return rolling == Rolling::spring && kr > 0.0; }
  bool friction() const { return tangential != Tangential::none && mu > 0.0; }
  bool springs() const {
    return friction() &&
           (tangential == Tangential::spring || tangential == Tangential::springDashpot);
  }
};

/// Motion of one contact that the law sees.
template <class Real>
struct ContactMotion {
  Real overlap;             ///< δ [m]
  Real normalVelocity;      ///< v_n [m/s]
  Real tangentialVelocity;  ///< v_t [m/s]
  Real normalCompliance;    ///< dt/2 · (1/m_i + 1/m_j); read by implicit damping [s/kg]
  /// dt/2 · (1/m_i + 1/m_j + c_i l_i/J_i + c_j l_j/J_j), likewise [s/kg]
  Real tangentialCompliance;
  Real radius = 0;  ///< R₁₂ = a_i a_j/(a_i + a_j); read by Hertz' law and cohesion [m]
  Real reach = 0;   ///< a_i + a_j; 0: a plane; read by cohesion [m]
  Real mass = 0;    ///< m₁₂ = m_i m_j/(m_i + m_j); read by critical dampers [kg]
};

/// The same of its rolling.
template <class Real>
struct RollingMotion {
  Real spin;         ///< ω_r = ω_i − ω_j [rad/s]
  Real length;       ///< L [m]
  Real square;       ///< what k_r's constant multiplies [m²] or 1
  Real inertia = 0;  ///< I; read by critical dampers [kg m²]
};

template <class Real>
struct RollingTorque {
  Real torque;   ///< M on i; −M on j [N m]
  Real sliding;  ///< 1 where the bound holds, else 0
};

template <class Real>
struct ContactForce {
  Real normal;      ///< f_n [N]
  Real tangential;  ///< f_t [N]
  Real sliding;     ///< 1 where the Coulomb bound holds, else 0
  Real load;        ///< what stands for f_n in bounds [N]
};

/// Bodies of several materials: the law of each two of them.
struct Materials {
  std::vector<std::int32_t> ofDisk, ofWall;  ///< of each disk, and of each wall with all it has
  std::size_t count = 0;
  /// Of a and b at a · count + b; symmetric. They have Setup::law's options and no effect that it
  /// has not; other constants.
  std::vector<Law> laws;
};

/// Of two materials: without friction no spring and no dashpot acts along the tangent.
inline Law lawOfPair(Law law) {
  if (!(law.mu > 0.0)) law.kt = law.gt = 0.0;
  return law;
}

}  // namespace grain
