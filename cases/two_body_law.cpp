#include "cases/two_body_problem.hpp"

/// The law between two events, and the motion that it makes.
namespace crossgrain {

TwoBodyProblem::TwoBodyProblem(const ContactLaw& law, const CollidingPair& pair)
    : law_(law),
      pair_(pair),
      reach_(pair.radius[0] + pair.radius[1]),
      inverseMass_(1.0 / pair.mass[0] + 1.0 / pair.mass[1]) {
  if (law.tangential == TangentialLaw::spring) law_.gt = 0.0;
  if (law.mu == 0.0) law_.tangential = TangentialLaw::none;
}

Kinematics TwoBodyProblem::kinematics(const State& s) const {
  Kinematics k{};
  k.distance = std::hypot(s.x, s.y);
  k.nx = s.x / k.distance;
  k.ny = s.y / k.distance;
  k.overlap = reach_ - k.distance;
  k.leverI = pair_.radius[0];
  k.leverJ = pair_.radius[1];
  k.leverI -= k.overlap * leverShare(1);
  k.leverJ -= k.overlap * leverShare(0);
  k.normalVelocity = s.vx * k.nx + s.vy * k.ny;
  const double sideways = -s.vx * k.ny + s.vy * k.nx;
  k.turning = sideways / k.distance;
  k.tangentialVelocity = sideways - k.leverI * s.spinI - k.leverJ * s.spinJ;
  return k;
}

double TwoBodyProblem::normalForce(const Kinematics& k) const {
  const bool cut = law_.conventions.tension == Tension::cut;
  return cut && !phase_.compressive ? 0.0 : trialNormal(k);
}

/// Linear in f_n within a phase, so it also maps df_n/dt to the bound's rate.
double TwoBodyProblem::bound(double normal) const {
  if (phase_.compressive) return law_.mu * normal;
  switch (law_.conventions.coulombBound) {
    case CoulombBound::compression:
      return 0.0;
    case CoulombBound::magnitude:
      return -law_.mu * normal;
    case CoulombBound::signedForce:
      break;
  }
  return law_.mu * normal;
}

/// What is held against the bound.
double TwoBodyProblem::testedForce(const Kinematics& k, double spring) const {
  const bool outside = law_.conventions.dashpot == Dashpot::outside;
  return -law_.kt * spring - (outside ? 0.0 : law_.gt * k.tangentialVelocity);
}

double TwoBodyProblem::tangentialForce(const State& s, const Kinematics& k) const {
  switch (phase_.tangential) {
    case Phase::Tangential::none:
      return 0.0;
    case Phase::Tangential::damped:
      return -law_.gt * k.tangentialVelocity;
    case Phase::Tangential::stick:
      return -law_.kt * s.spring - law_.gt * k.tangentialVelocity;
    case Phase::Tangential::slip:
      return bound(normalForce(k)) * phase_.side;
    case Phase::Tangential::hold:
      break;
  }
  return holdingForce(s, k);
}

/// In the tangential spring while it sticks [J].
double TwoBodyProblem::storedEnergy(const State& s) const {
  const bool sticks = phase_.tangential == Phase::Tangential::stick;
  return sticks ? 0.5 * law_.kt * s.spring * s.spring : 0.0;
}

State TwoBodyProblem::derivative(const State& s) const {
  const Kinematics k = kinematics(s);
  const double normal = normalForce(k);
  const double tangential = tangentialForce(s, k);
  const double slip = k.tangentialVelocity;
  const bool sticks = phase_.tangential == Phase::Tangential::stick;
  const bool damps = sticks || phase_.tangential == Phase::Tangential::damped;
  return {s.vx,
          s.vy,
          (normal * k.nx - tangential * k.ny) * inverseMass_,
          (normal * k.ny + tangential * k.nx) * inverseMass_,
          -k.leverI * tangential / pair_.inertia[0],
          -k.leverJ * tangential / pair_.inertia[1],
          sticks ? slip : 0.0,
          (law_.kn * k.overlap - normal) * k.normalVelocity,
          damps ? law_.gt * slip * slip : 0.0,
          damps ? 0.0 : -tangential * slip};
}

CollisionEnd TwoBodyProblem::endAt(const State& s, const CollisionStart& start) const {
  const Kinematics k = kinematics(s);
  CollisionEnd end =
      endOf(pair_, start, {k.normalVelocity, k.turning * k.distance, {s.spinI, s.spinJ}});
  end.limitless = limitless_;
  end.lost = {s.lostNormal, s.lostTangential, s.lostSliding, storedEnergy(s)};
  return end;
}

}  // namespace crossgrain
