#include <limits>
#include <stdexcept>

#include "law/cohesion.hpp"
#include "oracle/two_body_problem.hpp"

/// Bodies that attract each other: their force, the load that bounds multiply, and what of both
/// changes at which instant.
namespace crossgrain::inline oracle {

/// The force without its dashpot, and its derivative by δ. Elasto-plastic: of the line that the
/// contact is on.
Slope TwoBodyProblem::cohesiveForce(const Kinematics& k) const {
  const double elastic = elasticForce(k.overlap), stiff = stiffness(k.overlap).value;
  switch (law_.cohesion) {
    case CohesionLaw::area: {
      const SlopeOf area = cohesionArea(law_, pair_, k.overlap);
      return {elastic - law_.kc * area.value, stiff - law_.kc * area.rate};
    }
    case CohesionLaw::dmt:
      return {elastic - pullOff(law_, reducedRadius_), stiff};
    case CohesionLaw::jkr: {
      // F = F_po (y⁶ − 2 y³), δ = unit (y⁴ − 4/3 y).
      const double pull = pullOff(law_, reducedRadius_), unit = jkrUnit(law_, reducedRadius_);
      const double y = jkrRoot(k.overlap / unit), cube = y * y * y;
      return {pull * (cube - 2.0) * cube,
              pull / unit * 6.0 * y * y * (cube - 1.0) / (4.0 * cube - 4.0 / 3.0)};
    }
    case CohesionLaw::elastoPlastic:
      break;
    case CohesionLaw::none:
      return {elastic, stiff};
  }
  if (phase_.line == Phase::Line::loading) return {elastic, law_.kn};
  if (phase_.line == Phase::Line::pull) return {-law_.kc * k.overlap, -law_.kc};
  const double k2 = unloadingStiffness(law_, reducedRadius_, k.largest);
  return {k2 * k.overlap - (k2 - law_.kn) * k.largest, k2};
}

/// The load that stands for f_n in bounds. @see CohesionLoad
double TwoBodyProblem::load(const Kinematics& k) const {
  const double normal = normalForce(k);
  if (!law_.coheres()) return normal;
  const double pull = pullOff(law_, reducedRadius_);
  switch (law_.conventions.cohesionLoad) {
    case CohesionLoad::net:
      return normal;
    case CohesionLoad::plusTwicePullOff:
      return pull > 0.0 ? bodyForce(k) + 2.0 * pull : normal;
    case CohesionLoad::magnitudePlusPullOff:
      return std::abs(normal) + pull;
    case CohesionLoad::netWithoutDashpot:
      return bodyForce(k);
    case CohesionLoad::withoutPull:
      break;
  }
  if (law_.cohesion == CohesionLaw::elastoPlastic)
    return phase_.pulls ? normal - bodyForce(k) : normal;
  return normal - (bodyForce(k) - elasticForce(k.overlap));
}

/// d load/dt, from df/dt = −f′ v_n of what follows the overlap and −γ_n dv_n/dt + γ_n′ v_n² of the
/// dashpot. @param acceleration  dv_n/dt [m/s²]
double TwoBodyProblem::loadRate(const Kinematics& k, double acceleration) const {
  const double elastic = -stiffness(k.overlap).value * k.normalVelocity;
  const double body = law_.coheres() ? -cohesiveForce(k).rate * k.normalVelocity : elastic;
  const Slope gn = normalDamping(k.overlap);
  double normal = body - gn.value * acceleration + gn.rate * k.normalVelocity * k.normalVelocity;
  if (cuts()) normal = phase_.pulls ? body : 0.0;
  if (!law_.coheres()) return normal;
  const CohesionLoad of = law_.conventions.cohesionLoad;
  if (of == CohesionLoad::netWithoutDashpot ||
      (of == CohesionLoad::plusTwicePullOff && pullOff(law_, reducedRadius_) > 0.0))
    return body;
  if (of == CohesionLoad::magnitudePlusPullOff) return normalForce(k) < 0.0 ? -normal : normal;
  if (of != CohesionLoad::withoutPull) return normal;
  if (law_.cohesion == CohesionLaw::elastoPlastic) return phase_.pulls ? normal - body : normal;
  return normal - (body - elastic);
}

/// By how much the force exceeds the pull alone, or of what sign that is: where tension is cut it
/// acts while this is > 0.
double TwoBodyProblem::beyondPull(const Kinematics& k) const {
  return phase_.pulls ? -k.normalVelocity : trialNormal(k);
}

/// Whether the load of this phase is zero throughout, to rounding: it has no sign to watch.
bool TwoBodyProblem::neverLoaded() const {
  const bool nothing = cuts() && !phase_.pulls;  // f_n is 0
  if (!law_.coheres()) return nothing;
  const CohesionLoad of = law_.conventions.cohesionLoad;
  const bool bare = law_.gn == 0.0 || cuts();  // f_n is the body's alone
  if (law_.cohesion == CohesionLaw::elastoPlastic) {
    if (of == CohesionLoad::withoutPull) return nothing || (phase_.pulls && bare);
    const bool empty = phase_.line == Phase::Line::pull && law_.kc == 0.0;
    if (of == CohesionLoad::netWithoutDashpot) return empty;
    return nothing || (empty && bare);
  }
  if (of == CohesionLoad::withoutPull)
    return phase_.beyond && (bare || law_.damper != Damper::constant);
  return nothing && of != CohesionLoad::netWithoutDashpot &&
         (of == CohesionLoad::net || pullOff(law_, reducedRadius_) == 0.0);
}

/// Largest change of the load by an error of the overlap [N/m].
double TwoBodyProblem::stiffest(const Kinematics& k) const {
  return std::max(stiffness(k.overlap).value, std::abs(cohesiveForce(k).rate));
}

/// The amount that a load may lack of 0 on its side of it where that was chosen by its rate, as
/// cohesionGuard() allows [N]. A bound of it holds what needs no force, as v_t = 0 on a plane.
double TwoBodyProblem::unseenLoad(const Kinematics& k) const {
  if (!law_.coheres()) return 0.0;
  return 16.0 * std::numeric_limits<double>::epsilon() * reach_ * stiffest(k);
}

/// > 0 as long as the force is the same smooth function of the motion.
double TwoBodyProblem::cohesionGuard(const Kinematics& k) const {
  double guard = std::numeric_limits<double>::infinity();
  // A sign that was chosen by its rate, within four roundings of 0, lasts until eight beyond.
  const double rounding = std::numeric_limits<double>::epsilon() * reach_;
  const auto keeps = [&](bool positive, double value, double unit = 0.0) {
    guard = std::min(guard, (positive ? value : -value) + 8.0 * unit);
  };
  bool changesSign = true;
  if (law_.cohesion == CohesionLaw::jkr) keeps(!phase_.beyond, k.overlap, rounding);
  if (law_.cohesion == CohesionLaw::elastoPlastic) {
    changesSign = phase_.line == Phase::Line::unloading;
    if (changesSign) {  // towards loading at δ_max, or towards the pull at its limit
      const double loads = onLimitBranch(k.largest) ? guard : k.largest - k.overlap;
      guard = std::min({guard, std::max(loads, k.normalVelocity),
                        std::max(bodyForce(k) + law_.kc * k.overlap, -k.normalVelocity)});
    } else
      keeps(phase_.line == Phase::Line::pull, k.normalVelocity);
    if (phase_.line == Phase::Line::loading && law_.plasticDepth > 0.0)
      guard = std::min(guard, plasticLimit(law_, reducedRadius_) - k.overlap);
  }
  if (changesSign) keeps(!phase_.pulls, bodyForce(k), std::abs(cohesiveForce(k).rate) * rounding);
  if (law_.conventions.tension == Tension::cut && law_.gn > 0.0)
    keeps(phase_.compressive, beyondPull(k));
  const bool bounded = law_.rolls() || law_.tangential != TangentialLaw::none;
  if (bounded && !neverLoaded()) keeps(phase_.loaded, load(k), stiffest(k) * rounding);
  return guard;
}

/// Whether an overlap, or a δ_max, is δ* or beyond.
bool TwoBodyProblem::onLimitBranch(double overlap) const {
  return isBeyondPlasticLimit(law_, reducedRadius_, overlap);
}

/// Loading ends at the turning point, whose overlap is remembered, or at δ*; unloading at that
/// overlap unless it is δ*, or at the limit of the pull; the pull where the bodies turn again.
void TwoBodyProblem::chooseLine(State& s) {
  const Kinematics k = kinematics(s);
  using enum Phase::Line;
  const bool limit = onLimitBranch(k.overlap);
  if (phase_.line == loading && (k.normalVelocity >= 0.0 || limit)) {
    s.largest = limit ? plasticLimit(law_, reducedRadius_) : k.overlap;
    phase_.line = unloading;
  } else if (phase_.line == pull && k.normalVelocity <= 0.0) {
    s.largest = largestAtPull(law_, reducedRadius_, k.overlap);
    phase_.line = unloading;
  } else if (phase_.line == unloading && k.normalVelocity < 0.0 && k.overlap >= k.largest &&
             !onLimitBranch(k.largest)) {
    phase_.line = loading;
  } else if (phase_.line == unloading && k.normalVelocity > 0.0 &&
             bodyForce(k) <= -law_.kc * k.overlap) {
    phase_.line = pull;
  }
}

/// The parts of a phase that are about the normal. @param anew  at the first touch
void TwoBodyProblem::chooseNormal(State& s, bool anew) {
  if (!law_.coheres()) {
    phase_.compressive = law_.gn == 0.0 || trialNormal(kinematics(s)) > 0.0;
    phase_.loaded = phase_.compressive;
    return;
  }
  const bool yields = law_.cohesion == CohesionLaw::elastoPlastic;
  if (yields) chooseLine(s);
  const Kinematics k = kinematics(s);
  // Where an event is, a value is zero to the rounding of positions: its rate says what follows.
  const double rounding = std::numeric_limits<double>::epsilon() * reach_;
  const auto isPositive = [](double value, double rate, double unit) {
    return std::abs(value) > 4.0 * unit ? value > 0.0 : rate > 0.0;
  };
  const Slope body = cohesiveForce(k);
  phase_.beyond =
      law_.cohesion == CohesionLaw::jkr && !isPositive(k.overlap, -k.normalVelocity, rounding);
  phase_.pulls =
      yields && phase_.line != Phase::Line::unloading
          ? phase_.line == Phase::Line::pull
          : !isPositive(body.value, -body.rate * k.normalVelocity, std::abs(body.rate) * rounding);
  const bool cut = law_.conventions.tension == Tension::cut && law_.gn > 0.0;
  phase_.compressive = !cut || beyondPull(k) > 0.0;
  phase_.loaded =
      !neverLoaded() && isPositive(load(k), anew ? 1.0 : loadRate(k, normalAcceleration(s, k)),
                                   stiffest(k) * rounding);
}

/// Whether there is no friction for want of a load.
bool TwoBodyProblem::hasNoBound() const {
  const bool compression = law_.conventions.coulombBound == CoulombBound::compression;
  if (law_.coheres()) return neverLoaded() || (!phase_.loaded && compression);
  return !phase_.compressive && (compression || law_.conventions.tension == Tension::cut);
}

}  // namespace crossgrain::inline oracle
