#pragma once

#include "law/cohesion.hpp"
#include "oracle/collision_end.hpp"

namespace crossgrain::inline oracle {

using Slope = SlopeOf<double>;

/// Motion of a pair along its normal, which is all that its normal force follows.
struct NormalMotion {
  double overlap;         ///< δ [m]
  double normalVelocity;  ///< v_n [m/s]
  double largest;         ///< δ_max of an elasto-plastic contact [m]
};

/// Which branch of the normal law holds between two events.
struct NormalPhase {
  bool compressive = true;  ///< f_el − γ_n v_n > 0; of cohesion, more than the pull alone
  bool loaded = true;       ///< the load that bounds multiply is > 0

  /// Of cohesion: whether the bodies attract each other, their dashpot apart; whether they are
  /// beyond δ = 0; and on which line an elasto-plastic contact is.
  bool pulls = false, beyond = false;
  enum class Line { loading, unloading, pull } line = Line::loading;
};

/// The contact of two bodies by its motion along the normal alone, numbers in the plane and in
/// space: stiffness, dampers, f_n, the load that bounds multiply, and when they change.
class NormalForces {
 protected:
  NormalForces(const ContactLaw& law, const CollidingPair& pair);

  double elasticForce(double overlap) const {
    return contact_law::elasticForce(law_, reducedRadius_, overlap);
  }
  Slope stiffness(double overlap) const { return normalStiffness(law_, reducedRadius_, overlap); }
  Slope tangentialStiffness(double overlap) const {
    return contact_law::tangentialStiffness(law_, reducedRadius_, overlap);
  }
  Slope normalDamping(double overlap) const {
    return dashpot(law_.damper, law_.gn, stiffness(overlap), inverseMass_);
  }
  Slope tangentialDamping(double overlap) const {
    return dashpot(law_.damper, law_.gt, tangentialStiffness(overlap), inverseMass_);
  }
  bool remembersForce() const { return law_.conventions.history == History::force; }

  /// @param speed  of the approach [m/s]
  double contactTime(double speed) const;
  /// Differences of positions below this are rounding [m].
  double visibleLength() const;

  double normalForce(const NormalMotion& k) const;
  double trialNormal(const NormalMotion& k) const {
    return bodyForce(k) - normalDamping(k.overlap).value * k.normalVelocity;
  }
  double bodyForce(const NormalMotion& k) const {
    return law_.coheres() ? cohesiveForce(k).value : elasticForce(k.overlap);
  }
  Slope cohesiveForce(const NormalMotion& k) const;
  double load(const NormalMotion& k) const;
  double loadRate(const NormalMotion& k, double acceleration) const;
  double bound(double load) const;
  bool remembersBody() const {
    return law_.cohesion == CohesionLaw::jkr || law_.cohesion == CohesionLaw::elastoPlastic;
  }
  double stiffest(const NormalMotion& k) const;
  double unseenLoad(const NormalMotion& k) const;
  bool neverLoaded() const;
  bool hasNoBound() const;

  /// > 0 as long as the bodies touch and the force is the same smooth function of the motion.
  double normalGuard(const NormalMotion& k) const;
  /// The parts of a phase that are about the normal, and δ_max.
  void chooseNormal(NormalMotion& k);
  /// @param rate  at which the load changes [N/s]
  void chooseLoaded(const NormalMotion& k, double rate);

  ContactLaw law_;  ///< without the constants that it has no use for
  CollidingPair pair_;
  double reach_;          ///< a_i + a_j [m]
  double inverseMass_;    ///< 1/m₁₂ [1/kg]
  double reducedRadius_;  ///< R₁₂ [m]
  double bondRange_;      ///< bondRange() [m]
  NormalPhase phase_;

 private:
  bool cuts() const {
    return law_.conventions.tension == Tension::cut && !phase_.compressive && law_.gn > 0.0;
  }
  double beyondPull(const NormalMotion& k) const;
  bool onLimitBranch(double overlap) const;
  void chooseLine(NormalMotion& k);
};

}  // namespace crossgrain::inline oracle
