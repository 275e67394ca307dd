#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engines/grain/ledger.hpp"
#include "engines/grain/pair_list.hpp"
#include "engines/grain/setup.hpp"

namespace grain {

template <class Real>
class Core;
/// Velocity of a body's centre, or of a wall's point, and its spin.
struct BodyMotion {
  double vx = 0.0, vy = 0.0, spin = 0.0;
};

struct ContactKinematics;

/// Keeps the energy ledger of a core: reads it before each motion and after each evaluation of
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
  /// @param tally  whether contactLosses() is to know of this step
  void afterForces(bool tally);
  /// After a checkpoint is restored.
  void placesRestored() { takeMasses(); }
  /// Places change. @param order  the old place of each new one; scratch: as of reorder()
  void renumber(std::span<const std::int32_t> order, std::span<const std::int32_t> newPlace,
                std::vector<std::byte>& scratch);

  const EnergyLedger& ledger() const { return sums_.ledger; }
  /// Power that each of these contacts turned into heat in the step that led here, at t = 0 in the
  /// half kick from there [W]: what their dashpots lost, and what sliding, rolling and yield took.
  /// @pre the last two evaluations were tallied, or all there are
  std::vector<double> contactLosses(const std::vector<Contact>& contacts) const;

  /// Calls visit(sums), visitAll(springs) and visitSame(list of known length) for all that a
  /// checkpoint has to keep.
  template <class Self, class Visit, class VisitAll, class VisitSame>
  static void forState(Self& self, Visit&& visit, VisitAll&& visitAll, VisitSame&& visitSame) {
    LedgerSums::forState(self.sums_, visit, visitAll);
    visitSame(self.plateAccounts_);
    visitAll(self.losses_);
  }

 private:
  /// By place, of the moving disks.
  struct Motions {
    std::vector<Vec<double>> velocity;
    std::vector<double> spin;  ///< empty where disks do not rotate

    BodyMotion of(std::size_t place) const {
      return {velocity[place].x, velocity[place].y, spin.empty() ? 0.0 : spin[place]};
    }
  };

  /// Losses of contacts, by numbers i < j [J].
  struct ContactLoss {
    std::int32_t i, j;
    HalfKicks loss;
  };

  void account(double time);
  void lookAtDisks(double time);
  void accountContact(const Contact& contact);
  void accountContact(const Contact& contact, const ContactKinematics& touch,
                      const BodyMotion* wall);
  void accountForces(const Contact& contact, const ContactKinematics& touch,
                     const BodyMotion* wall);
  void accountSpring(const Contact& contact, const ContactKinematics& touch, double stiffness);
  void accountRolling(const Contact& contact, const ContactKinematics& touch);
  void accountDisks();
  template <bool Spin>
  void accountPlate(std::size_t place);
  void takeMasses();
  ContactKinematics kinematicsOf(const Contact& contact, const BodyMotion* wall) const;
  BodyMotion seen(std::size_t place) const;
  BodyMotion diskMotion(std::size_t wallDisk) const;
  BodyMotion planeMotion(const Contact& contact) const;
  double wallSpinOf(std::size_t wallDiskOrPlane) const;

  const Core<Real>& core_;
  LedgerSums sums_;
  double toForces_;       ///< from the stored velocities to the time of the forces [s]
  Vec<double> middle_{};  ///< where potentials are 0 [m]
  bool plateSpin_;
  // By place, of the moving disks.
  std::vector<double> mass_, inertia_;
  Motions closing_, opening_;           ///< half way through the two parts' kicks
  std::vector<Vec<Real>> plateBefore_;  ///< springs before the last evaluation [m]
  std::vector<SpringAccount> plateAccounts_;
  std::vector<ContactLoss> losses_, lossesBefore_;  ///< of this evaluation and the one before
  bool tallies_ = false;
};

}  // namespace grain
