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
  for (auto* array : {&mass_, &inertia_}) array->resize(disks);
  for (Motions* motions : {&closing_, &opening_}) {
    motions->velocity.resize(disks);
    if (core.law_.rotation) motions->spin.resize(disks);
  }
  takeMasses();
  if (!setup.bottom) return;
  plateBefore_.resize(disks);
  plateAccounts_.resize(disks);
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
    core_.forContactsByPlace([this](const Contact& contact) { accountContact(contact); });
  sums_.endSprings();
  accountDisks();
}

/// Kinetic energy, and velocities half way through the kicks: those stored, advanced by the
/// acceleration. @param time  from the stored velocities to that of the forces [s]
template <class Real>
void LedgerObserver<Real>::lookAtDisks(double time) {
  const HalfKicks& offset = sums_.scheme().offset;
  for (std::size_t i = 0; i < core_.moving_; ++i) {
    const auto inverseMass = static_cast<double>(core_.inverseMass_[i]);
    const Vec<Real> stored = core_.velocity_[i], force = core_.force_[i];
    const auto velocity = [&](double after) {
      const auto advanced = [&](Real v, Real f) {
        return static_cast<double>(v) + after * inverseMass * static_cast<double>(f);
      };
      return Vec<double>{advanced(stored.x, force.x), advanced(stored.y, force.y)};
    };
    closing_.velocity[i] = velocity(time + offset.closing);
    opening_.velocity[i] = velocity(time + offset.opening);
    const Vec<double> now = velocity(time);
    double spin = 0.0;
    if (core_.law_.rotation) {
      const auto storedSpin = static_cast<double>(core_.spin_[i]);
      const auto spinUp = static_cast<double>(core_.torque_[i] * core_.inverseInertia_[i]);
      closing_.spin[i] = storedSpin + (time + offset.closing) * spinUp;
      opening_.spin[i] = storedSpin + (time + offset.opening) * spinUp;
      spin = storedSpin + time * spinUp;
    }
    sums_.ledger.kinetic +=
        0.5 * mass_[i] * (now.x * now.x + now.y * now.y) + 0.5 * inertia_[i] * spin * spin;
  }
}

template <class Real>
void LedgerObserver<Real>::accountDisks() {
  EnergyLedger& ledger = sums_.ledger;
  const auto gx = static_cast<double>(core_.motionConstants_.gravityX);
  const auto gy = static_cast<double>(core_.motionConstants_.gravityY);
  if (gx != 0.0 || gy != 0.0)
    for (std::size_t place = 0; place < core_.moving_; ++place) {
      const auto number = static_cast<std::size_t>(core_.idAtIndex_[place]);
      ledger.potential -=
          mass_[place] * (gx * (core_.x(number) - middle_.x) + gy * (core_.y(number) - middle_.y));
    }
  if (!plateBefore_.empty())
    for (std::size_t place = 0; place < core_.moving_; ++place)
      plateSpin_ ? accountPlate<true>(place) : accountPlate<false>(place);
}

/// The plate's force anew, from the spring that it was made of, and what it does to the disk.
template <class Real>
template <bool Spin>
GRAIN_INLINE void LedgerObserver<Real>::accountPlate(std::size_t i) {
  const BottomConstants<Real>& plate = core_.motionConstants_.plate;
  const Vec<Real> before = plateBefore_[i], u = core_.velocitySeen()[i];
  const Real us = Spin ? core_.spinSeen()[i] : Real(0), weighed = core_.gravityForce_[i];
  const Real trialX = -plate.kb * before.x - plate.gb * u.x;
  const Real trialY = -plate.kb * before.y - plate.gb * u.y;
  const bool slides = squareRoot(trialX * trialX + trialY * trialY) > plate.pressure * weighed;
  Real setX = before.x, setY = before.y;
  const BottomForce<Real> force =
      bottomForce<Spin>(plate, weighed, core_.radius_[i], u.x, u.y, us, setX, setY);
  // Where it slips the spring is set to what the force is.
  const auto x = static_cast<double>(slides ? setX : before.x);
  const auto y = static_cast<double>(slides ? setY : before.y);
  SpringAccount account;
  account.sliding = slides;
  account.modulus = static_cast<double>(plate.kb);
  account.square = x * x + y * y;
  account.energy = 0.5 * account.modulus * account.square;
  sums_.ledger.plateSprings += account.energy;
  HalfKicks spring, beyond;  // powers [W]
  const auto powers = [&](const BodyMotion& motion, double HalfKicks::*part) {
    const double ofSpring = -account.modulus * x * motion.vx + -account.modulus * y * motion.vy;
    spring.*part = ofSpring;
    beyond.*part = static_cast<double>(force.x) * motion.vx +
                   static_cast<double>(force.y) * motion.vy +
                   static_cast<double>(force.torque) * (Spin ? motion.spin : 0.0) - ofSpring;
  };
  powers(closing_.of(i), &HalfKicks::closing);
  powers(opening_.of(i), &HalfKicks::opening);
  sums_.plateSpring(plateAccounts_[i], account, spring);
  sums_.lose(&EnergyLedger::lostBottom, beyond);
}

template class LedgerObserver<double>;
template class LedgerObserver<float>;

}  // namespace grain
