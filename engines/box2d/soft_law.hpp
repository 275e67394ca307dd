#pragma once

#include <algorithm>
#include <cmath>

namespace box2d_granular {

enum class Tangential { none, coulomb, viscous, spring, springDashpot };
enum class Bound { compression, magnitude, signedForce };  ///< µ times max(f_n, 0), |f_n| or f_n

enum class Normal { linear, hertz };  ///< k_n δ or k_n √R₁₂ δ^(3/2); k_t is then k_t √(R₁₂ δ)
/// What dashpots' constants multiply besides the velocity, S the stiffness: 1, S, √(m₁₂ S).
enum class Damper { constant, viscoelastic, critical };
enum class History { displacement, force };  ///< what a contact remembers where k_t follows δ
/// Torque M on i, −M on j: −µ_r L N sign ω_r, −γ_r L² ω_r, −µ_r L² N ω_r, or a spring of θ = ∫ω_r
/// dt with a dashpot, limited to µ_r L N.
enum class Rolling { none, constantTorque, viscous, viscousByLoad, spring };
enum class RollingLength { effective, twiceEffective, smallerRadius, meanRadius };  ///< L
enum class RollingStiffness { lengthSquare, radii, constant };  ///< k_r times L², a_i a_j or 1
enum class RollingDamper { constant, critical };                ///< γ_r L² or 2 γ_r √(I k_r)
/// N: max(f_n, 0), |f_n| or f_el; whileCompressed: where max(f_n, 0) is 0 a spring has no limit.
enum class RollingLoad { compression, magnitude, elastic, whileCompressed };
enum class Cohesion { none, area, dmt, jkr, elastoPlastic };
enum class CohesionArea { lens, firstOrder, twiceBetweenDisks };
enum class JkrEnd { largestPull, branch };
/// What bounds take for f_n: f_n, f_n without the pull, f_n + 2 F_po, |f_n| + F_po.
enum class CohesionLoad {
  net,
  withoutPull,
  plusTwicePullOff,
  magnitudePlusPullOff,
  netWithoutDashpot
};

/// A soft contact law and its conventions.
///
/// n points from j to i, s = z × n, overlap δ = a_i + a_j − |x_i − x_j|;
/// v_n = (v_i − v_j)·n, v_t = (v_i − v_j)·s − (l_i ω_i + l_j ω_j); the force on i is f_n n + f_t s,
/// its torque −l_i f_t.
struct SoftLaw {
  double kn = 0.0;  ///< [N/m]
  double gn = 0.0;  ///< [kg/s]
  double kt = 0.0;  ///< [N/m]
  double gt = 0.0;  ///< [kg/s]
  double mu = 0.0;  ///< [-]
  Tangential tangential = Tangential::none;
  Bound bound = Bound::compression;
  bool cutTension = false;
  bool dashpotOutsideBound = false;  ///< hold only the spring's force against the bound
  bool resetSpringOnly = false;      ///< on slip spring and dashpot together carry the bound
  bool stretchBefore = false;        ///< ξ += v_t dt before the force, not after it
  bool leverToContactPoint = false;  ///< l_i = a_i − δ a_j/(a_i + a_j) instead of a_i

  // What follows only general_law.hpp knows.
  Normal normal = Normal::linear;  ///< hertz: k_n is 4/3 E₁₂ and k_t 8 G₁₂ [Pa]
  Damper damper = Damper::constant;
  History history = History::displacement;
  Rolling rolling = Rolling::none;
  double kr = 0.0;   ///< [N/m] or [N m]
  double gr = 0.0;   ///< [kg/s] or [-]
  double muR = 0.0;  ///< [-]; viscousByLoad: [s/m]
  RollingLength rollingLength = RollingLength::effective;
  RollingStiffness rollingStiffness = RollingStiffness::lengthSquare;
  RollingDamper rollingDamper = RollingDamper::constant;
  RollingLoad rollingLoad = RollingLoad::compression;
  bool rollingDashpotOutside = false;   ///< as dashpotOutsideBound, of the rolling spring
  bool rollingResetSpringOnly = false;  ///< as resetSpringOnly
  Cohesion cohesion = Cohesion::none;
  double kc = 0.0;            ///< area: [Pa]; elastoPlastic: stiffness of the pull [N/m]
  double w = 0.0;             ///< dmt, jkr: work of adhesion [J/m²]
  double kUnload = 0.0;       ///< elastoPlastic [N/m]
  double plasticDepth = 0.0;  ///< elastoPlastic, φ [-]
  CohesionArea cohesionArea = CohesionArea::lens;
  JkrEnd jkrEnd = JkrEnd::largestPull;
  CohesionLoad cohesionLoad = CohesionLoad::withoutPull;

  bool friction() const { return tangential != Tangential::none && mu > 0.0; }
  bool turnsDisks() const { return friction() || rolling != Rolling::none; }
  /// Whether contactForce() below is all of it.
  bool plain() const {
    return normal == Normal::linear && damper == Damper::constant && rolling == Rolling::none &&
           cohesion == Cohesion::none;
  }
};

struct ContactForce {
  double normal = 0.0;      ///< f_n [N]
  double tangential = 0.0;  ///< f_t [N]
  bool sliding = false;
};

/// The force on i (Lätzel 2003, Eqs. 4.9, 4.16, 4.18, 4.20 and 4.22–4.25).
/// @tparam Damped  whether γ_n > 0
/// @tparam T       which tangential law; `law.tangential` is not looked at
/// @param spring   ξ [m], kept as long as the contact lasts
template <bool Damped, Tangential T>
ContactForce contactForce(const SoftLaw& law, double overlap, double vn, double vt, double& spring,
                          double dt) {
  double normal = law.kn * overlap;
  if constexpr (Damped) normal -= law.gn * vn;
  if (law.cutTension) normal = std::max(normal, 0.0);
  if constexpr (T == Tangential::none) return {normal};

  const double carrying = law.bound == Bound::compression ? std::max(normal, 0.0)
                          : law.bound == Bound::magnitude ? std::abs(normal)
                                                          : normal;
  const double bound = law.mu * carrying;
  const auto sign = [](double value) { return (value > 0.0) - (value < 0.0); };
  if constexpr (T == Tangential::coulomb) return {normal, -bound * sign(vt), true};
  if constexpr (T == Tangential::viscous) {
    const double trial = law.gt * std::abs(vt);
    return {normal, -std::min(trial, bound) * sign(vt), trial > bound};
  }

  if (law.stretchBefore) spring += vt * dt;
  const double elastic = -law.kt * spring;
  const double viscous = T == Tangential::springDashpot ? -law.gt * vt : 0.0;
  const double trial = elastic + viscous;
  const double tested = law.dashpotOutsideBound ? elastic : trial;
  if (std::abs(tested) <= bound) {
    if (!law.stretchBefore) spring += vt * dt;
    return {normal, trial, false};
  }
  const double force = bound * sign(tested);
  if (law.kt > 0.0) spring = -(law.resetSpringOnly ? force - viscous : force) / law.kt;
  return {normal, force, true};
}

/// Calls f.template operator()<Damped, T>() with the parts that the law really has.
template <typename F>
auto withPartsOf(const SoftLaw& law, F&& f) {
  const auto damped = [&]<bool Damped>() {
    switch (law.friction() ? law.tangential : Tangential::none) {
      case Tangential::coulomb:
        return f.template operator()<Damped, Tangential::coulomb>();
      case Tangential::viscous:
        return f.template operator()<Damped, Tangential::viscous>();
      case Tangential::spring:
        return f.template operator()<Damped, Tangential::spring>();
      case Tangential::springDashpot:
        return f.template operator()<Damped, Tangential::springDashpot>();
      case Tangential::none:
        break;
    }
    return f.template operator()<Damped, Tangential::none>();
  };
  return law.gn > 0.0 ? damped.template operator()<true>() : damped.template operator()<false>();
}

}  // namespace box2d_granular
