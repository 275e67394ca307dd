#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "law/contact_law.hpp"
#include "oracle/collision_oracle.hpp"
#include "oracle/contact_forces.hpp"

namespace crossgrain::inline oracle {

/// Relative position and velocity of i against j, both spins, what the tangential spring remembers
/// (ξ, or its force with the sign of ξ); the account of the energy lost so far, as in EnergySplit;
/// θ of the rolling spring and δ_max of an elasto-plastic contact; and the account of these.
struct State {
  double x, y, vx, vy, spinI, spinJ, spring;
  double lostNormal, lostTangential, lostStiffening, lostSliding;
  double angle, largest;
  double lostRollingDamping, lostRolling;
  double lostBody;  ///< −∫ f v_n dt of the force without its dashpot, of a body that forgets
};
constexpr std::size_t dimension = 16;
/// Which of them are accounts.
constexpr std::size_t accounts[] = {7, 8, 9, 10, 13, 14, 15};
static_assert(sizeof(State) == dimension * sizeof(double));

/// Between two events the right-hand side is smooth; a phase says which branch of the law holds.
struct Phase {
  enum class Tangential {
    none,    ///< no tangential force
    damped,  ///< f_t = −γ_t v_t
    stick,   ///< f_t = −k_t ξ − γ_t v_t
    slip,    ///< f_t = bound · side
    hold     ///< Coulomb's law at v_t = 0: the force that keeps it there
  } tangential = Tangential::none;
  double side = 0.0;        ///< sign of f_t while it slips
  bool compressive = true;  ///< f_el − γ_n v_n > 0; of cohesion, more than the pull alone
  bool loaded = true;       ///< the load that bounds multiply is > 0

  /// Of cohesion: whether the bodies attract each other, their dashpot apart; whether they are
  /// beyond δ = 0; and on which line an elasto-plastic contact is.
  bool pulls = false, beyond = false;
  enum class Line { loading, unloading, pull } line = Line::loading;

  enum class Rolling {
    none,    ///< no torque, or none as there is no load
    damped,  ///< type B
    stick,   ///< type C, M = −k_r θ − γ_r ω_r
    slip,    ///< M = bound · rollingSide
    hold     ///< type A at ω_r = 0: the torque that keeps it there
  } rolling = Rolling::none;
  double rollingSide = 0.0;  ///< sign of M while it slips
};

struct Kinematics {
  double distance, nx, ny, overlap;
  double normalVelocity, tangentialVelocity;
  double sideways;        ///< the centres' own velocity along s [m/s]
  double turning;         ///< rate at which the normal turns [rad/s]
  double leverI, leverJ;  ///< of f_t [m]
  double armI, armJ;      ///< of the spins in v_t [m]
  double rollingSpin;     ///< ω_r = ω_i − ω_j [rad/s]
  double largest;         ///< δ_max of an elasto-plastic contact [m]
};

inline double sign(double value) {
  return (value > 0.0) - (value < 0.0);
}

/// The planar collision of two disks, or of a disk and a plane, in continuous time, one
/// phase after another.
class TwoBodyProblem : private ContactForces {
 public:
  TwoBodyProblem(const ContactLaw& law, const CollidingPair& pair);
  CollisionEnd solve(const CollisionStart& start);
  /// As the free function below.
  bool jumpsAtTouch(const CollisionStart& start);
  bool hasJump() const;
  bool slipsAtFirst(const CollisionStart& start);
  /// The v_t to grow from where a slip ends at 0 and CollisionEnd::noLimit may hold; rounding
  /// without it. @param speed  [m/s]
  void overshoot(double speed) { overshoot_ = speed; }

 private:
  /// A remembered force over a stiffness that goes to 0 under a pull has no energy: all its work
  /// counts as that of sticking.
  bool springHasEnergy() const { return !(remembersForce() && law_.stiffens() && law_.coheres()); }

  // The law
  Kinematics kinematics(const State& s) const;
  double trialNormal(const Kinematics& k) const {
    return bodyForce(k) - normalDamping(k.overlap).value * k.normalVelocity;
  }
  double leverFraction(int side) const { return fractionOf(law_.conventions.leverArm, side); }
  double armFraction(int side) const { return fractionOf(law_.conventions.armOfVelocity(), side); }
  double fractionOf(LeverArm arm, int side) const {
    return crossgrain::leverFraction(arm, law_.conventions.planeArm, pair_, side);
  }
  double normalForce(const Kinematics& k) const;
  double bound(double load) const;
  double boundNow(const Kinematics& k) const { return bound(load(k)); }
  double testedForce(const Kinematics& k, double spring) const;
  double tangentialForce(const State& s, const Kinematics& k) const;
  double storedEnergy(const State& s) const;
  double stiffeningLoss(const State& s, const Kinematics& k) const;
  /// The velocity that f_t does work on: v_t, taken with the arms of f_t [m/s].
  double workedVelocity(const State& s, const Kinematics& k) const {
    return k.sideways - k.leverI * s.spinI - k.leverJ * s.spinJ;
  }
  State derivative(const State& s) const;
  CollisionEnd endAt(const State& s, const CollisionStart& start) const;

  // Cohesion
  double bodyForce(const Kinematics& k) const {
    return law_.coheres() ? cohesiveForce(k).value : elasticForce(k.overlap);
  }
  Slope cohesiveForce(const Kinematics& k) const;
  double load(const Kinematics& k) const;
  double loadRate(const Kinematics& k, double acceleration) const;
  bool remembersBody() const {
    return law_.cohesion == CohesionLaw::jkr || law_.cohesion == CohesionLaw::elastoPlastic;
  }
  bool cuts() const {
    return law_.conventions.tension == Tension::cut && !phase_.compressive && law_.gn > 0.0;
  }
  double beyondPull(const Kinematics& k) const;
  bool neverLoaded() const;
  double stiffest(const Kinematics& k) const;
  double unseenLoad(const Kinematics& k) const;
  double cohesionGuard(const Kinematics& k) const;
  bool onLimitBranch(double overlap) const;
  void chooseLine(State& s);
  void chooseNormal(State& s, bool anew);
  bool hasNoBound() const;

  // Rolling
  void setRollingConstants();
  double rollingLoad(const Kinematics& k) const;
  bool rollingHasNoLimit() const;
  bool hasNoRollingBound() const;
  double rollingBound(const Kinematics& k) const {
    return law_.muR * rollingLength_ * std::max(rollingLoad(k), 0.0);
  }
  double rollingTested(const State& s, const Kinematics& k) const;
  double rollingTorque(const State& s, const Kinematics& k) const;
  double rollingEnergy(const State& s) const;
  double holdingTorque(const State& s, const Kinematics& k) const;
  double rollingBoundRate(const State& s, const Kinematics& k) const;
  double rollingDashpotRate(const State& s, const Kinematics& k) const;
  double rollingStretching(const Kinematics& k) const;
  double rollingSlipGuard(const State& s, const Kinematics& k) const;
  double slippedAngle(const Kinematics& k) const;
  double unseenBound(const Kinematics& k) const;
  double rollingGuard(const State& s, const Kinematics& k) const;
  void chooseRolling(State& s, bool anew);
  void chooseRollingSpring(State& s);
  /// ω_r set by the first spin.
  void setRollingSpin(State& s, double spin) const { s.spinI = s.spinJ + spin; }
  /// d ω_r/dt per M [1/(kg m²)], and per −f_t [1/(kg m)].
  double rollingCompliance() const { return 1.0 / pair_.inertia[0] + 1.0 / pair_.inertia[1]; }
  double turningBySlip(const Kinematics& k) const {
    return k.leverI / pair_.inertia[0] - k.leverJ / pair_.inertia[1];
  }
  /// d v_t/dt per −M [1/(kg m)].
  double slippingByTorque(const Kinematics& k) const {
    return k.armI / pair_.inertia[0] - k.armJ / pair_.inertia[1];
  }

  // Events
  double slipDrift(const State& s, const Kinematics& k) const;
  double normalAcceleration(const State& s, const Kinematics& k) const;
  bool tangentialLasts(const State& s) const;
  double compliance(const Kinematics& k) const;
  double holdingForce(const State& s, const Kinematics& k) const;
  double boundRate(const State& s, const Kinematics& k) const;
  double slippedSpring(const Kinematics& k) const;
  double slipGuard(const State& s, const Kinematics& k) const;
  double dashpotRate(const State& s, const Kinematics& k) const;
  double tangentialGuard(const State& s) const;
  double firstGuard(const State& s) const;
  void enterPhase(State& s, bool anew = false);
  void choosePhase(State& s);
  void chooseSpringPhase(State& s, const Kinematics& k);

  // Integration
  State firstTouch(const CollisionStart& start) const;
  State along(const State& s, double time) const;
  double roundingOfForce(const State& s) const;

  static int rightHandSide(double t, const double y[], double dydt[], void* self);

  double bondRange_;               ///< bondRange() [m]
  double rollingLength_ = 0.0;     ///< L [m]
  double rollingStiffness_ = 0.0;  ///< k_r (…) [N m]
  double rollingDamping_ = 0.0;    ///< of its dashpot [N m s]
  Phase phase_;
  double stillness_ = 0.0;  ///< v_t that counts as 0 [m/s]
  double overshoot_ = 0.0;  ///< overshoot() [m/s]
  bool noLimit_ = false;    ///< CollisionEnd::noLimit
};

}  // namespace crossgrain::inline oracle
