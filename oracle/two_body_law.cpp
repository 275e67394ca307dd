#include "law/cohesion.hpp"
#include "oracle/two_body_problem.hpp"

/// The law between two events, and the motion that it makes.
namespace crossgrain::inline oracle {

TwoBodyProblem::TwoBodyProblem(const ContactLaw& law, const CollidingPair& pair)
    : ContactForces(law, pair), bondRange_(bondRange(law, reducedRadius_)) {
  if (law.rolls()) setRollingConstants();
}

Kinematics TwoBodyProblem::kinematics(const State& s) const {
  Kinematics k{};
  k.distance = pair_.plane ? s.x : std::hypot(s.x, s.y);
  k.nx = pair_.plane ? 1.0 : s.x / k.distance;
  k.ny = pair_.plane ? 0.0 : s.y / k.distance;
  k.overlap = reach_ - k.distance;
  k.leverI = pair_.radius[0] - k.overlap * leverFraction(0);
  k.leverJ = pair_.radius[1] - k.overlap * leverFraction(1);
  k.armI = pair_.radius[0] - k.overlap * armFraction(0);
  k.armJ = pair_.radius[1] - k.overlap * armFraction(1);
  k.normalVelocity = s.vx * k.nx + s.vy * k.ny;
  k.sideways = -s.vx * k.ny + s.vy * k.nx;
  k.turning = pair_.plane ? 0.0 : k.sideways / k.distance;
  k.tangentialVelocity = k.sideways - k.armI * s.spinI - k.armJ * s.spinJ;
  k.rollingSpin = s.spinI - s.spinJ;
  k.largest = s.largest;
  return k;
}

/// Where tension is cut the dashpot does not pull; cohesion does.
double TwoBodyProblem::normalForce(const Kinematics& k) const {
  if (!cuts()) return trialNormal(k);
  return phase_.pulls ? bodyForce(k) : 0.0;
}

/// Linear in the load within a phase, so it also maps the load's rate to the bound's.
double TwoBodyProblem::bound(double load) const {
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

/// The force or torque that is compared with the bound.
double TwoBodyProblem::testedForce(const Kinematics& k, double spring) const {
  const bool outside = law_.conventions.dashpot == Dashpot::outside;
  const double dashpot = outside ? 0.0 : tangentialDamping(k.overlap).value * k.tangentialVelocity;
  return -springUnit(k.overlap) * spring - dashpot;
}

double TwoBodyProblem::tangentialForce(const State& s, const Kinematics& k) const {
  switch (phase_.tangential) {
    case Phase::Tangential::none:
      return 0.0;
    case Phase::Tangential::damped:
      return -tangentialDamping(k.overlap).value * k.tangentialVelocity;
    case Phase::Tangential::stick:
      return -springUnit(k.overlap) * s.spring -
             tangentialDamping(k.overlap).value * k.tangentialVelocity;
    case Phase::Tangential::slip:
      return boundNow(k) * phase_.side;
    case Phase::Tangential::hold:
      break;
  }
  return holdingForce(s, k);
}

/// In the tangential spring while it sticks [J].
double TwoBodyProblem::storedEnergy(const State& s) const {
  if (phase_.tangential != Phase::Tangential::stick || !springHasEnergy()) return 0.0;
  const double overlap = kinematics(s).overlap;
  const double stiffness = tangentialStiffness(overlap).value;
  if (!(stiffness > 0.0)) return 0.0;
  const double force = springUnit(overlap) * s.spring;
  return 0.5 * force * force / stiffness;
}

/// Loss of the stored energy per time because the stiffness changes, dδ/dt = −v_n: of a spring
/// that keeps ξ, −½ ξ² dk_t/dt; of one that keeps its force f, +½ (f/k_t)² dk_t/dt [W].
double TwoBodyProblem::stiffeningLoss(const State& s, const Kinematics& k) const {
  const Slope stiffness = tangentialStiffness(k.overlap);
  if (stiffness.rate == 0.0 || !springHasEnergy()) return 0.0;
  const double stretch = remembersForce() ? s.spring / stiffness.value : s.spring;
  const double rising = -0.5 * stiffness.rate * k.normalVelocity * stretch * stretch;
  return remembersForce() ? rising : -rising;
}

State TwoBodyProblem::derivative(const State& s) const {
  const Kinematics k = kinematics(s);
  const double normal = normalForce(k);
  const double tangential = tangentialForce(s, k);
  const double slip = k.tangentialVelocity;
  const double worked = workedVelocity(s, k);
  const bool sticks = phase_.tangential == Phase::Tangential::stick;
  const bool damps = sticks || phase_.tangential == Phase::Tangential::damped;
  const double torque = rollingTorque(s, k), body = bodyForce(k);
  const bool rollingDamps = phase_.rolling == Phase::Rolling::stick;
  const double rollingLoss = -torque * k.rollingSpin;
  const double sticking = springHasEnergy() ? tangentialDamping(k.overlap).value * slip * slip +
                                                  tangential * (slip - worked)
                                            : -tangential * worked;
  const double growth = remembersForce() ? tangentialStiffness(k.overlap).value * slip : slip;
  return {s.vx,
          s.vy,
          (normal * k.nx - tangential * k.ny) * inverseMass_,
          (normal * k.ny + tangential * k.nx) * inverseMass_,
          (torque - k.leverI * tangential) / pair_.inertia[0],
          (-torque - k.leverJ * tangential) / pair_.inertia[1],
          sticks ? growth : 0.0,
          (body - normal) * k.normalVelocity,
          damps ? sticking : 0.0,
          sticks ? stiffeningLoss(s, k) : 0.0,
          damps ? 0.0 : -tangential * worked,
          rollingDamps ? k.rollingSpin : 0.0,
          0.0,
          rollingDamps ? rollingDamping_ * k.rollingSpin * k.rollingSpin
          : phase_.rolling == Phase::Rolling::damped ? rollingLoss
                                                     : 0.0,
          phase_.rolling == Phase::Rolling::slip ? rollingLoss : 0.0,
          remembersBody() ? -body * k.normalVelocity : 0.0};
}

CollisionEnd TwoBodyProblem::endAt(const State& s, const CollisionStart& start) const {
  const Kinematics k = kinematics(s);
  CollisionEnd end = endOf(pair_, start, {k.normalVelocity, k.sideways, {s.spinI, s.spinJ}});
  end.noLimit = noLimit_;
  end.lost = {s.lostNormal, s.lostTangential, s.lostStiffening, s.lostSliding, storedEnergy(s)};
  const bool spring = law_.rolling == RollingLaw::spring;
  if (spring || law_.rolling == RollingLaw::constantTorque)
    end.lost->rolling = s.lostRolling + rollingEnergy(s);
  if (law_.rolls() && law_.rolling != RollingLaw::constantTorque && !(spring && law_.gr == 0.0))
    end.lost->rollingDamping = s.lostRollingDamping;
  if (law_.cohesion == CohesionLaw::elastoPlastic) end.lost->plastic = s.lostBody;
  if (law_.cohesion == CohesionLaw::jkr) end.lost->detachment = s.lostBody;
  return end;
}

}  // namespace crossgrain::inline oracle
