#pragma once

#include "law/cohesion.hpp"
#include "oracle/collision_end.hpp"

namespace crossgrain::inline oracle {

using Slope = SlopeOf<double>;

/// How stiff the contact of two bodies is and how much it damps, by its overlap δ [m] alone: what
/// the problem of the plane and that of space have in common.
class ContactForces {
 protected:
  ContactForces(const ContactLaw& law, const CollidingPair& pair);

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
  /// Force of a tangential spring per unit of what it remembers.
  double springUnit(double overlap) const {
    return remembersForce() ? 1.0 : tangentialStiffness(overlap).value;
  }
  bool remembersForce() const { return law_.conventions.history == History::force; }

  /// Share of v_t t that a spring is stretched by where its contact is first evaluated at t.
  double stretchedShare() const;
  /// @param speed  of the approach [m/s]
  double contactTime(double speed) const;
  /// Differences of positions below this are rounding [m].
  double visibleLength() const;

  ContactLaw law_;  ///< without the constants that it has no use for
  CollidingPair pair_;
  double reach_;          ///< a_i + a_j [m]
  double inverseMass_;    ///< 1/m₁₂ [1/kg]
  double reducedRadius_;  ///< R₁₂ [m]
};

}  // namespace crossgrain::inline oracle
