#pragma once

#include <vector>

#include "engines/grain/ledger.hpp"
#include "engines/grain/real.hpp"
#include "engines/grain/setup.hpp"

namespace grain {

template <class Real>
class Core;
struct BodyMotion;
struct Touch;

/// Keeps the energy ledger of a core: looks at it before each motion and after each evaluation of
/// the forces, and changes nothing there. A core without one does nothing for it.
template <class Real>
class LedgerObserver {
 public:
  /// @param core  observed; must outlive this and stay where it is
  LedgerObserver(const Core<Real>& core, const Setup& setup);

  /// At t = 0, after the first forces.
  void begin();
  /// Before the motion kernel stretches the plate's springs.
  void beforeMotion();
  void afterForces();

  const EnergyLedger& ledger() const { return sums_.ledger; }

  /// Calls visit(sums), visitAll(springs) and visitSame(list of known length) for all that a
  /// checkpoint has to keep.
  template <class Self, class Visit, class VisitAll, class VisitSame>
  static void forState(Self& self, Visit&& visit, VisitAll&& visitAll, VisitSame&& visitSame) {
    LedgerSums::forState(self.sums_, visit, visitAll);
    visitSame(self.plateAccounts_);
  }

 private:
  void account(double time);
  void accountContact(const Contact& contact, double time);
  void accountSpring(const Contact& contact, const Touch& touch, double stiffness);
  void accountDisk(std::size_t number, double time);
  void accountPlate(std::size_t number, double time);
  Touch touchOf(const Contact& contact, double time) const;
  BodyMotion carried(std::size_t place, double time) const;
  BodyMotion seen(std::size_t place) const;
  BodyMotion wallMotion(const Contact& contact) const;

  const Core<Real>& core_;
  LedgerSums sums_;
  double toForces_;       ///< from the stored velocities to the time of the forces [s]
  Vec<double> middle_{};  ///< where potentials are 0 [m]
  bool plateSpin_;
  std::vector<Vec<Real>> plateBefore_;  ///< springs before the last evaluation, by number [m]
  std::vector<SpringAccount> plateAccounts_;
};

}  // namespace grain
