#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "adapters/contact_law.hpp"
#include "oracle/collision_oracle.hpp"

namespace crossgrain::inline oracle {

/// Relative position and velocity of i against j, both spins, what the tangential spring remembers
/// (ξ, or its force with the sign of ξ); and the account of the energy lost so far, as in
/// EnergySplit.
struct State {
  double x, y, vx, vy, spinI, spinJ, spring;
  double lostNormal, lostTangential, lostStiffening, lostSliding;
};
constexpr std::size_t dimension = 11;
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
  bool compressive = true;  ///< f_el − γ_n v_n > 0
};

struct Kinematics {
  double distance, nx, ny, overlap;
  double normalVelocity, tangentialVelocity;
  double sideways;        ///< the centres' own velocity along s [m/s]
  double turning;         ///< rate at which the normal turns [rad/s]
  double leverI, leverJ;  ///< of f_t [m]
  double armI, armJ;      ///< of the spins in v_t [m]
};

/// A function of the overlap and its derivative.
struct Slope {
  double value, rate;
};

/// The planar collision of two disks, or of a disk and a plane, in continuous time, one
/// phase after another.
class TwoBodyProblem {
 public:
  TwoBodyProblem(const ContactLaw& law, const CollidingPair& pair);
  CollisionEnd solve(const CollisionStart& start);
  /// As the free function below.
  bool jumpsAtTouch(const CollisionStart& start);
  bool hasJump() const;
  bool slipsAtFirst(const CollisionStart& start);
  /// What v_t is let grow from where a slip ends at 0 and CollisionEnd::noLimit may hold; rounding
  /// without it. @param speed  [m/s]
  void overshoot(double speed) { overshoot_ = speed; }

 private:
  // How stiff a contact is and how much it damps
  double elasticForce(double overlap) const;
  Slope stiffness(double overlap) const;
  Slope tangentialStiffness(double overlap) const;
  Slope damping(double constant, const Slope& stiffness) const;
  Slope normalDamping(double overlap) const { return damping(law_.gn, stiffness(overlap)); }
  Slope tangentialDamping(double overlap) const {
    return damping(law_.gt, tangentialStiffness(overlap));
  }
  /// What the spring's force is per unit of what it remembers.
  double springUnit(double overlap) const {
    return remembersForce() ? 1.0 : tangentialStiffness(overlap).value;
  }
  bool remembersForce() const { return law_.conventions.history == History::force; }

  // The law
  Kinematics kinematics(const State& s) const;
  double trialNormal(const Kinematics& k) const {
    return elasticForce(k.overlap) - normalDamping(k.overlap).value * k.normalVelocity;
  }
  double leverFraction(int side) const { return fractionOf(law_.conventions.leverArm, side); }
  double armFraction(int side) const { return fractionOf(law_.conventions.armOfVelocity(), side); }
  double fractionOf(LeverArm arm, int side) const {
    return crossgrain::leverFraction(arm, law_.conventions.planeArm, pair_, side);
  }
  double normalForce(const Kinematics& k) const;
  double bound(double normal) const;
  double testedForce(const Kinematics& k, double spring) const;
  double tangentialForce(const State& s, const Kinematics& k) const;
  double storedEnergy(const State& s) const;
  double stiffeningLoss(const State& s, const Kinematics& k) const;
  /// What f_t does work on: v_t, taken with the arms of f_t [m/s].
  double workedVelocity(const State& s, const Kinematics& k) const {
    return k.sideways - k.leverI * s.spinI - k.leverJ * s.spinJ;
  }
  State derivative(const State& s) const;
  CollisionEnd endAt(const State& s, const CollisionStart& start) const;

  // Events
  double compliance(const Kinematics& k) const;
  double holdingForce(const State& s, const Kinematics& k) const;
  double boundRate(const State& s, const Kinematics& k) const;
  double slippedSpring(const Kinematics& k) const;
  double slipGuard(const State& s, const Kinematics& k) const;
  double dashpotRate(const State& s, const Kinematics& k) const;
  double tangentialGuard(const State& s) const;
  double firstGuard(const State& s) const;
  void enterPhase(State& s);
  void choosePhase(State& s);
  void chooseSpringPhase(State& s, const Kinematics& k);

  // Integration
  double contactTime(double speed) const;
  State firstTouch(const CollisionStart& start) const;
  double stretchedShare() const;
  double visibleLength() const;
  State along(const State& s, double time) const;
  double roundingOfForce(const State& s) const;

  static int rightHandSide(double t, const double y[], double dydt[], void* self);

  ContactLaw law_;
  CollidingPair pair_;
  double reach_, inverseMass_;
  Phase phase_;
  double stillness_ = 0.0;  ///< v_t that counts as 0 [m/s]
  double overshoot_ = 0.0;  ///< overshoot() [m/s]
  bool noLimit_ = false;    ///< CollisionEnd::noLimit
};

}  // namespace crossgrain::inline oracle
