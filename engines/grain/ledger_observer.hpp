#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engines/grain/ledger.hpp"
#include "engines/grain/real.hpp"
#include "engines/grain/setup.hpp"

namespace grain {

template <class Real>
class Core;
/// Velocity of a body's centre, or of a wall's point, and its spin.
struct BodyMotion {
  double vx = 0.0, vy = 0.0, spin = 0.0;
};

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
  /// Places change. @param order  the old place of each new one; scratch: as of reorder()
  void renumber(std::span<const std::int32_t> order, std::span<const std::int32_t> newPlace,
                std::vector<std::byte>& scratch);

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
  void accountContact(const Contact& contact);
  void accountSpring(const Contact& contact, const Touch& touch, double stiffness);
  void accountDisk(std::size_t place, double time);
  void accountPlate(std::size_t place);
  Touch touchOf(const Contact& contact, const BodyMotion* wall) const;
  BodyMotion carried(std::size_t place, double time) const;
  BodyMotion seen(std::size_t place) const;
  BodyMotion wallMotion(const Contact& contact) const;

  const Core<Real>& core_;
  LedgerSums sums_;
  double toForces_;       ///< from the stored velocities to the time of the forces [s]
  Vec<double> middle_{};  ///< where potentials are 0 [m]
  bool plateSpin_;
  // By place, of the moving disks.
  std::vector<BodyMotion> closing_, opening_;  ///< half way through the two parts' kicks
  std::vector<BodyMotion> seen_;               ///< as the law saw them
  std::vector<Vec<Real>> plateBefore_;         ///< springs before the last evaluation [m]
  std::vector<SpringAccount> plateAccounts_;
};

}  // namespace grain
