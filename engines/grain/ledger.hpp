#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engines/grain/walls.hpp"

namespace grain {

/// Where the energy is and where it went since t = 0 [J].
struct EnergyLedger {
  double initial = 0.0;  ///< the states at t = 0, added up
  double kinetic = 0.0, elasticNormal = 0.0, elasticTangential = 0.0, elasticRolling = 0.0;
  double potential = 0.0;  ///< of gravity, 0 for all disks at their mean position of t = 0
  double plateSprings = 0.0;
  double workOfWalls = 0.0;         ///< on the disks
  double gainedByConvention = 0.0;  ///< by springs that grow without being stretched
  double lostNormalDamping = 0.0, lostTangentialDamping = 0.0, lostSliding = 0.0;
  double lostRollingDamping = 0.0, lostRolling = 0.0;  ///< by dashpots, at the bound
  double lostBottom = 0.0;                             ///< to the plate
  double lostRelease = 0.0;     ///< springs still stretched when a contact ends
  double lostPlastic = 0.0;     ///< by contacts that yield
  double lostDetachment = 0.0;  ///< bonds that still pull when a contact ends

  double states() const {
    return kinetic + elasticNormal + elasticTangential + elasticRolling + potential + plateSprings;
  }
};

/// A force acts on velocities twice: in the part of the step that leads to its time, and in the one
/// that leads on from there. `closing` and `opening` are values of one quantity, each as that part
/// sees it: a velocity half way through the part's kick.
struct HalfKicks {
  double closing = 0.0, opening = 0.0;
};

/// State of a contact's spring when it was last looked at.
struct SpringAccount {
  std::int32_t i = 0, j = 0;  ///< of the contact, places; i < j
  std::int32_t sliding = 0;   ///< at the bound
  double energy = 0.0;        ///< ½ · modulus · square [J]
  double modulus = 0.0;       ///< k of a spring, 1/k of a remembered force
  double square = 0.0;        ///< of the stretch or the remembered force, that of this time
  double openingWork = 0.0;   ///< on the disks until the next evaluation [J]
};

/// Sums of an energy ledger: work of the forces of each evaluation, term by term.
///
/// The discrete kinetic-energy identity. A kick from u to u + τ a, a = F/m, changes ½ m u² by
///   τ F·(u + τ a/2),
/// exactly: the force times the velocity half way through the kick. Both Verlet schemes kick by
/// τ = dt/2 towards the time t of the force, from v − a dt/2 to v, and by dt/2 on from there; half
/// way the velocities are v ∓ a dt/4. Euler's scheme kicks once, by dt, on from t: v + a dt/2. So
///   K(t) − K(0) = Σ of τ F·u over all kicks since, but for rounding,
/// and as F is a sum over contacts, plate and gravity, so is the work. A contact's part, of wall
/// w, is f_n v_n + f_t v_t with the relative velocities that the law means, made of these u, and
/// F·v_w (+ l_w f_t ω_w), which is the wall's work.
///
/// The dampers' part of that is exact too, as forces beyond their springs' are known. Springs give
/// back what they took only as exactly as Σ τ f_el·u is the integral of f_el dδ (gravity: of F dx):
/// that difference is the ledger's residual, and nothing else is in it. Where a spring slides, its
/// ξ is set, so what it took from the motion beyond what it then holds is lost to sliding (Lätzel
/// 2003, Eq. 4.25), or, if less than nothing, gained by the convention that set it. A modulus that
/// changes with the overlap changes ½ k ξ² by ½ ξ² dk, which no force pays for: gained by
/// convention, < 0 where it falls.
class LedgerSums {
 public:
  struct Scheme {
    HalfKicks time;    ///< how long the force acts in each part [s]
    HalfKicks offset;  ///< of each part's velocity, in accelerations from the one at t [s]
  };
  explicit LedgerSums(Scheme scheme) : scheme_(scheme) {}

  const Scheme& scheme() const { return scheme_; }

  /// Adds the openings noted at the last evaluation: they have happened by now.
  void beginEvaluation();
  /// Powers [W], > 0 to the disks.
  void workOfWall(const HalfKicks& power) { add(&EnergyLedger::workOfWalls, power, 1.0); }
  /// Powers [W] of forces that are no spring's, > 0 to the disks: their opposites are losses.
  void lose(double EnergyLedger::*term, const HalfKicks& power) {
    add(term, power, -1.0);
    if (loss_ == nullptr) return;
    loss_->closing -= power.closing * scheme_.time.closing;
    loss_->opening -= power.opening * scheme_.time.opening;
  }
  /// Sets where losses from now on are added up as well, those of one contact [J]; null: nowhere.
  /// The loss of a contact as it ends is in no such sum.
  void tally(HalfKicks* loss) { loss_ = loss; }
  /// Powers [W] that a convention gives the disks.
  void gain(const HalfKicks& power) { add(&EnergyLedger::gainedByConvention, power, 1.0); }
  /// `body` is the normal force of a law that remembers: one that yields counts as sliding.
  enum class Spring { sliding, rolling, body };
  /// Account of one spring, in ascending (i, j), to be filled in, then settled.
  /// @param power  of the spring on the disks [W]
  SpringAccount& nextSpring(Spring of) { return bookOf(of).next.emplace_back(); }
  void settleSpring(Spring of, const HalfKicks& power);
  /// Settles, after the last spring, those of contacts that have ended.
  void endSprings();
  /// Renumbers the moving disks, which are the first ones. @param newPlace  old → new
  void renumber(std::span<const std::int32_t> newPlace);
  /// The plate's spring with one disk.
  void plateSpring(SpringAccount& before, SpringAccount now, const HalfKicks& power);

  /// At t = 0, after the first evaluation: nothing has happened yet.
  void begin();

  EnergyLedger ledger;  ///< its states are for the caller to keep

  /// Calls visit(sums) and visitAll(springs) for all state that a checkpoint has to keep.
  template <class Sums, class Visit, class VisitAll>
  static void forState(Sums& sums, Visit&& visit, VisitAll&& visitAll) {
    visit(sums.ledger);
    visit(sums.pending_);
    for (auto& book : sums.books_) visitAll(book.springs);
  }

 private:
  /// All contacts' springs of one kind.
  struct SpringBook {
    double EnergyLedger::*lost;      ///< term of losses at the bound
    double EnergyLedger::*released;  ///< term of energy left when a contact ends
    std::vector<SpringAccount> springs = {}, next = {};
    std::size_t place = 0;  ///< in springs
  };
  SpringBook& bookOf(Spring kind) { return books_[static_cast<std::size_t>(kind)]; }

  void add(double EnergyLedger::*term, const HalfKicks& power, double sign);
  /// @returns what is lost [J]
  double settle(const SpringAccount& before, const SpringAccount& now, double closingWork,
                double EnergyLedger::*term);
  double spend(double EnergyLedger::*term, double loss);
  void release(const SpringBook& book, const SpringAccount& before);

  Scheme scheme_;
  EnergyLedger pending_;  ///< of the openings
  HalfKicks* loss_ = nullptr;
  std::array<SpringBook, 3> books_{
      SpringBook{&EnergyLedger::lostSliding, &EnergyLedger::lostRelease},
      SpringBook{&EnergyLedger::lostRolling, &EnergyLedger::lostRelease},
      SpringBook{&EnergyLedger::lostPlastic, &EnergyLedger::lostDetachment}};
};

}  // namespace grain
