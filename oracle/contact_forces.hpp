#pragma once

#include "law/contact_law.hpp"
#include "oracle/collision_end.hpp"

namespace crossgrain::inline oracle {

/// A function of the overlap and its derivative.
struct Slope {
  double value, rate;
};

/// How stiff the contact of two bodies is and how much it damps, by its overlap δ [m] alone: what
/// the problem of the plane and that of space have in common.
class ContactForces {
 protected:
  ContactForces(const ContactLaw& law, const CollidingPair& pair);

  double elasticForce(double overlap) const;
  Slope stiffness(double overlap) const;
  Slope tangentialStiffness(double overlap) const;
  Slope damping(double constant, const Slope& stiffness) const;
  Slope normalDamping(double overlap) const { return damping(law_.gn, stiffness(overlap)); }
  Slope tangentialDamping(double overlap) const {
    return damping(law_.gt, tangentialStiffness(overlap));
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
