#include "engines/grain/ledger_observer.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "engines/grain/contact_force.hpp"
#include "engines/grain/core.hpp"
#include "engines/grain/reorder.hpp"

namespace grain {

namespace {

/// Euler's scheme kicks once, after the forces; Verlet's by halves before and after.
LedgerSums::Scheme schemeOf(const Setup& setup) {
  const double dt = setup.dt;
  if (setup.law.conventions.integrator == Integrator::semiImplicitEuler)
    return {{0.0, dt}, {0.0, 0.5 * dt}};
  return {{0.5 * dt, 0.5 * dt}, {-0.25 * dt, 0.25 * dt}};
}

}  // namespace

template <class Real>
LedgerObserver<Real>::LedgerObserver(const Core<Real>& core, const Setup& setup)
    : core_(core),
      sums_(schemeOf(setup)),
      toForces_(setup.law.conventions.integrator == Integrator::semiImplicitEuler ? 0.0
                                                                                  : 0.5 * setup.dt),
      plateSpin_(setup.bottom && setup.bottom->spin && core.law_.rotation) {
  const std::size_t disks = setup.disks.x.size();
  for (std::size_t i = 0; i < disks; ++i) {
    middle_.x += setup.disks.x[i] / static_cast<double>(disks);
    middle_.y += setup.disks.y[i] / static_cast<double>(disks);
  }
  for (auto* array : {&mass_, &inertia_, &kinetic_}) array->resize(disks);
  for (Motions* motions : {&closing_, &opening_}) {
    motions->velocity.resize(disks);
    if (core.law_.rotation) motions->spin.resize(disks);
  }
  takeMasses();
  if (!setup.bottom) return;
  plateBefore_.resize(disks);
  plateAccounts_.resize(disks);
  for (auto* array : {&plateSlides_, &plateSquare_}) array->resize(disks);
  for (auto* array : {&plateClosing_, &plateOpening_}) array->resize(disks);
}

template <class Real>
void LedgerObserver<Real>::takeMasses() {
  for (std::size_t place = 0; place < core_.moving_; ++place) {
    const auto number = static_cast<std::size_t>(core_.idAtIndex_[place]);
    mass_[place] = core_.mass_[number];
    inertia_[place] = core_.inertia_[number];
  }
}

template <class Real>
void LedgerObserver<Real>::beforeMotion() {
  plateBefore_.assign(core_.plateSpring_.begin(), core_.plateSpring_.end());
}

template <class Real>
void LedgerObserver<Real>::renumber(std::span<const std::int32_t> order,
                                    std::span<const std::int32_t> newPlace,
                                    std::vector<std::byte>& scratch) {
  if (!plateAccounts_.empty()) {
    reorder(plateBefore_, order, scratch);
    reorder(plateAccounts_, order, scratch);
  }
  sums_.renumber(newPlace);
  takeMasses();
}

template <class Real>
void LedgerObserver<Real>::begin() {
  tallies_ = true;
  account(0.0);
  sums_.begin();
}

template <class Real>
void LedgerObserver<Real>::afterForces(bool tally) {
  tallies_ = tally;
  std::swap(losses_, lossesBefore_);
  losses_.clear();
  account(toForces_);
}

template <class Real>
std::vector<double> LedgerObserver<Real>::contactLosses(
    const std::vector<Contact>& contacts) const {
  const auto pairOf = [](const auto& of) { return std::pair(of.i, of.j); };
  const auto sorted = [&](std::vector<ContactLoss> losses) {
    std::ranges::sort(losses, {}, pairOf);
    return losses;
  };
  const auto now = sorted(losses_), before = sorted(lossesBefore_);
  const auto of = [&](const std::vector<ContactLoss>& losses, const Contact& contact) {
    const auto found = std::ranges::lower_bound(losses, pairOf(contact), {}, pairOf);
    return found != losses.end() && pairOf(*found) == pairOf(contact) ? found->loss : HalfKicks{};
  };
  const HalfKicks& time = sums_.scheme().time;
  std::vector<double> powers;
  for (const Contact& contact : contacts) {
    const double closing = of(now, contact).closing, opening = of(now, contact).opening;
    powers.push_back(core_.steps() == 0
                         ? opening / time.opening
                         : (of(before, contact).opening + closing) / (time.opening + time.closing));
  }
  return powers;
}

/// @param time  from the stored velocities to that of the forces [s]
template <class Real>
void LedgerObserver<Real>::account(double time) {
  EnergyLedger& ledger = sums_.ledger;
  sums_.beginEvaluation();
  ledger.kinetic = ledger.elasticNormal = ledger.elasticTangential = ledger.elasticRolling = 0.0;
  ledger.potential = ledger.plateSprings = 0.0;
  lookAtDisks(time);
  if (core_.law_.normal == NormalLaw::rigid)
    for (Contact contact : core_.contacts()) {
      for (std::int32_t* disk : {&contact.i, &contact.j})
        if (static_cast<std::size_t>(*disk) < core_.moving_)
          *disk = core_.indexOfId_[static_cast<std::size_t>(*disk)];
      accountContact(contact);
    }
  else
    accountPairs();
  sums_.endSprings();
  accountDisks();
}

/// @param time  from the stored velocities to that of the forces [s]
template <class Real>
void LedgerObserver<Real>::lookAtDisks(double time) {
  const LedgerSums::Scheme& scheme = sums_.scheme();
  const LedgerDisks<Real> disks{core_.velocity_.data(),
                                core_.force_.data(),
                                core_.spin_.data(),
                                core_.torque_.data(),
                                core_.inverseMass_.data(),
                                core_.inverseInertia_.data(),
                                mass_.data(),
                                inertia_.data(),
                                time,
                                time + scheme.offset.closing,
                                time + scheme.offset.opening,
                                closing_.view(),
                                opening_.view(),
                                kinetic_.data(),
                                core_.motionConstants_.plate,
                                core_.gravityForce_.data(),
                                core_.radius_.data(),
                                core_.velocitySeen().data(),
                                core_.spinSeen().data(),
                                plateBefore_.data(),
                                plateSlides_.data(),
                                plateSquare_.data(),
                                plateClosing_.data(),
                                plateOpening_.data()};
  const bool plate = !plateBefore_.empty();
  core_.kernels_.ledgerDisks[ledgerDiskVariant(core_.law_.rotation, plate, plateSpin_)](
      disks, core_.moving_);
}

template <class Real>
void LedgerObserver<Real>::accountDisks() {
  EnergyLedger& ledger = sums_.ledger;
  const auto gx = static_cast<double>(core_.motionConstants_.gravityX);
  const auto gy = static_cast<double>(core_.motionConstants_.gravityY);
  for (const double energy : kinetic_) ledger.kinetic += energy;
  if (gx != 0.0 || gy != 0.0)
    for (std::size_t place = 0; place < core_.moving_; ++place) {
      const auto number = static_cast<std::size_t>(core_.idAtIndex_[place]);
      ledger.potential -=
          mass_[place] * (gx * (core_.x(number) - middle_.x) + gy * (core_.y(number) - middle_.y));
    }
  if (!plateBefore_.empty())
    for (std::size_t place = 0; place < core_.moving_; ++place) accountPlate(place);
}

template <class Real>
GRAIN_INLINE void LedgerObserver<Real>::accountPlate(std::size_t place) {
  SpringAccount account;
  account.sliding = plateSlides_[place] != 0.0;
  account.modulus = static_cast<double>(core_.motionConstants_.plate.kb);
  account.square = plateSquare_[place];
  account.energy = 0.5 * account.modulus * account.square;
  sums_.ledger.plateSprings += account.energy;
  const PlatePower closing = plateClosing_[place], opening = plateOpening_[place];
  sums_.plateSpring(plateAccounts_[place], account, {closing.spring, opening.spring});
  sums_.lose(&EnergyLedger::lostBottom, {closing.beyond, opening.beyond});
}

template class LedgerObserver<double>;
template class LedgerObserver<float>;

}  // namespace grain
