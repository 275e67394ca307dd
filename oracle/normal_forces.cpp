#include "oracle/normal_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle/impact.hpp"

/// The force along n, of bodies that attract each other too, the load that bounds multiply, and
/// what of both changes at which instant.
namespace crossgrain::inline oracle {

NormalForces::NormalForces(const ContactLaw& law, const CollidingPair& pair)
    : law_(law),
      pair_(pair),
      reach_(pair.radius[0] + pair.radius[1]),
      inverseMass_(1.0 / pair.mass[0] + 1.0 / pair.mass[1]),
      reducedRadius_(pair.reducedRadius()),
      bondRange_(bondRange(law, reducedRadius_)) {
  if (law.tangential == TangentialLaw::spring) law_.gt = 0.0;
  if (law.mu == 0.0) law_.tangential = TangentialLaw::none;
}

double NormalForces::contactTime(double speed) const {
  return impactTime(law_, {pair_.reducedMass(), reducedRadius_, speed});
}

double NormalForces::visibleLength() const {
  return 64.0 * std::numeric_limits<double>::epsilon() * reach_;
}

/// Where tension is cut the dashpot does not pull; cohesion does.
double NormalForces::normalForce(const NormalMotion& k) const {
  if (!cuts()) return trialNormal(k);
  return phase_.pulls ? bodyForce(k) : 0.0;
}

/// Linear in the load within a phase, so it also maps the load's rate to the bound's.
double NormalForces::bound(double load) const {
  if (phase_.loaded) return law_.mu * load;
  switch (law_.conventions.coulombBound) {
    case CoulombBound::compression:
      return 0.0;
    case CoulombBound::magnitude:
      return -law_.mu * load;
    case CoulombBound::signedForce:
      break;
  }
  return law_.mu * load;
}

/// The force without its dashpot, and its derivative by δ. Elasto-plastic: of the line that the
/// contact is on.
Slope NormalForces::cohesiveForce(const NormalMotion& k) const {
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
  if (phase_.line == NormalPhase::Line::loading) return {elastic, law_.kn};
  if (phase_.line == NormalPhase::Line::pull) return {-law_.kc * k.overlap, -law_.kc};
  const double k2 = unloadingStiffness(law_, reducedRadius_, k.largest);
  return {k2 * k.overlap - (k2 - law_.kn) * k.largest, k2};
}

/// The load that stands for f_n in bounds. @see CohesionLoad
double NormalForces::load(const NormalMotion& k) const {
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
double NormalForces::loadRate(const NormalMotion& k, double acceleration) const {
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
double NormalForces::beyondPull(const NormalMotion& k) const {
  return phase_.pulls ? -k.normalVelocity : trialNormal(k);
}

/// Whether the load of this phase is zero throughout, to rounding: it has no sign to watch.
bool NormalForces::neverLoaded() const {
  const bool nothing = cuts() && !phase_.pulls;  // f_n is 0
  if (!law_.coheres()) return nothing;
  const CohesionLoad of = law_.conventions.cohesionLoad;
  const bool bare = law_.gn == 0.0 || cuts();  // f_n is the body's alone
  if (law_.cohesion == CohesionLaw::elastoPlastic) {
    if (of == CohesionLoad::withoutPull) return nothing || (phase_.pulls && bare);
    const bool empty = phase_.line == NormalPhase::Line::pull && law_.kc == 0.0;
    if (of == CohesionLoad::netWithoutDashpot) return empty;
    return nothing || (empty && bare);
  }
  if (of == CohesionLoad::withoutPull)
    return phase_.beyond && (bare || law_.damper != Damper::constant);
  return nothing && of != CohesionLoad::netWithoutDashpot &&
         (of == CohesionLoad::net || pullOff(law_, reducedRadius_) == 0.0);
}

/// Largest change of the load by an error of the overlap [N/m].
double NormalForces::stiffest(const NormalMotion& k) const {
  return std::max(stiffness(k.overlap).value, std::abs(cohesiveForce(k).rate));
}

/// The amount that a load may lack of 0 on its side of it where that was chosen by its rate, as
/// cohesionGuard() allows [N]. A bound of it holds what needs no force, as v_t = 0 on a plane.
double NormalForces::unseenLoad(const NormalMotion& k) const {
  if (!law_.coheres()) return 0.0;
  return 16.0 * std::numeric_limits<double>::epsilon() * reach_ * stiffest(k);
}

double NormalForces::normalGuard(const NormalMotion& k) const {
  double guard = k.overlap + bondRange_;
  if (!law_.coheres()) {
    if (law_.gn == 0.0) return guard;
    return std::min(guard, phase_.compressive ? trialNormal(k) : -trialNormal(k));
  }
  // A sign that was chosen by its rate, within four roundings of 0, lasts until eight beyond.
  const double rounding = std::numeric_limits<double>::epsilon() * reach_;
  const auto keeps = [&](bool positive, double value, double unit = 0.0) {
    guard = std::min(guard, (positive ? value : -value) + 8.0 * unit);
  };
  bool changesSign = true;
  if (law_.cohesion == CohesionLaw::jkr) keeps(!phase_.beyond, k.overlap, rounding);
  if (law_.cohesion == CohesionLaw::elastoPlastic) {
    changesSign = phase_.line == NormalPhase::Line::unloading;
    if (changesSign) {  // towards loading at δ_max, or towards the pull at its limit
      const double loads = onLimitBranch(k.largest) ? guard : k.largest - k.overlap;
      guard = std::min({guard, std::max(loads, k.normalVelocity),
                        std::max(bodyForce(k) + law_.kc * k.overlap, -k.normalVelocity)});
    } else
      keeps(phase_.line == NormalPhase::Line::pull, k.normalVelocity);
    if (phase_.line == NormalPhase::Line::loading && law_.plasticDepth > 0.0)
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
bool NormalForces::onLimitBranch(double overlap) const {
  return isBeyondPlasticLimit(law_, reducedRadius_, overlap);
}

/// Loading ends at the turning point, whose overlap is remembered, or at δ*; unloading at that
/// overlap unless it is δ*, or at the limit of the pull; the pull where the bodies turn again.
void NormalForces::chooseLine(NormalMotion& k) {
  using enum NormalPhase::Line;
  const bool limit = onLimitBranch(k.overlap);
  if (phase_.line == loading && (k.normalVelocity >= 0.0 || limit)) {
    k.largest = limit ? plasticLimit(law_, reducedRadius_) : k.overlap;
    phase_.line = unloading;
  } else if (phase_.line == pull && k.normalVelocity <= 0.0) {
    k.largest = largestAtPull(law_, reducedRadius_, k.overlap);
    phase_.line = unloading;
  } else if (phase_.line == unloading && k.normalVelocity < 0.0 && k.overlap >= k.largest &&
             !onLimitBranch(k.largest)) {
    phase_.line = loading;
  } else if (phase_.line == unloading && k.normalVelocity > 0.0 &&
             bodyForce(k) <= -law_.kc * k.overlap) {
    phase_.line = pull;
  }
}

/// Of a value that is zero to the rounding of positions, as one is at an event, by its rate.
/// @param unit  of the value by a rounding
bool isPositive(double value, double rate, double unit) {
  return std::abs(value) > 4.0 * unit ? value > 0.0 : rate > 0.0;
}

void NormalForces::chooseNormal(NormalMotion& k) {
  if (!law_.coheres()) {
    phase_.compressive = law_.gn == 0.0 || trialNormal(k) > 0.0;
    return;
  }
  const bool yields = law_.cohesion == CohesionLaw::elastoPlastic;
  if (yields) chooseLine(k);
  const double rounding = std::numeric_limits<double>::epsilon() * reach_;
  const Slope body = cohesiveForce(k);
  phase_.beyond =
      law_.cohesion == CohesionLaw::jkr && !isPositive(k.overlap, -k.normalVelocity, rounding);
  phase_.pulls =
      yields && phase_.line != NormalPhase::Line::unloading
          ? phase_.line == NormalPhase::Line::pull
          : !isPositive(body.value, -body.rate * k.normalVelocity, std::abs(body.rate) * rounding);
  const bool cut = law_.conventions.tension == Tension::cut && law_.gn > 0.0;
  phase_.compressive = !cut || beyondPull(k) > 0.0;
}

void NormalForces::chooseLoaded(const NormalMotion& k, double rate) {
  const double rounding = std::numeric_limits<double>::epsilon() * reach_;
  phase_.loaded = law_.coheres()
                      ? !neverLoaded() && isPositive(load(k), rate, stiffest(k) * rounding)
                      : phase_.compressive;
}

/// Whether there is no friction for want of a load.
bool NormalForces::hasNoBound() const {
  const bool compression = law_.conventions.coulombBound == CoulombBound::compression;
  if (law_.coheres()) return neverLoaded() || (!phase_.loaded && compression);
  return !phase_.compressive && (compression || law_.conventions.tension == Tension::cut);
}

}  // namespace crossgrain::inline oracle
