#include "engines/grain/ledger.hpp"
#include "engines/grain/real.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace grain {
namespace {

constexpr double EnergyLedger::*sums[] = {
    &EnergyLedger::workOfWalls,       &EnergyLedger::gainedByConvention,
    &EnergyLedger::lostNormalDamping, &EnergyLedger::lostTangentialDamping,
    &EnergyLedger::lostSliding,       &EnergyLedger::lostBottom,
    &EnergyLedger::lostRelease};

auto pairOf(const SpringAccount& spring) {
  return std::tie(spring.i, spring.j);
}

}  // namespace

void LedgerSums::beginEvaluation() {
  for (const auto sum : sums) ledger.*sum += std::exchange(pending_.*sum, 0.0);
}

void LedgerSums::begin() {
  for (const auto sum : sums) ledger.*sum = 0.0;
  ledger.initial = ledger.states();
}

GRAIN_INLINE void LedgerSums::add(double EnergyLedger::*term, const HalfKicks& power, double sign) {
  ledger.*term += sign * power.closing * scheme_.time.closing;
  pending_.*term += sign * power.opening * scheme_.time.opening;
}

GRAIN_INLINE void LedgerSums::settleSpring(const HalfKicks& power) {
  SpringAccount& now = next_.back();
  while (place_ < springs_.size() && pairOf(springs_[place_]) < pairOf(now))
    release(springs_[place_++]);
  now.openingWork = power.opening * scheme_.time.opening;
  const double closingWork = power.closing * scheme_.time.closing;
  if (place_ < springs_.size() && pairOf(springs_[place_]) == pairOf(now)) {
    settle(springs_[place_++], now, closingWork, &EnergyLedger::lostSliding);
  } else {  // of a contact that has only begun
    SpringAccount before;
    before.modulus = now.modulus;
    settle(before, now, closingWork, &EnergyLedger::lostSliding);
  }
}

void LedgerSums::endSprings() {
  while (place_ < springs_.size()) release(springs_[place_++]);
  springs_.swap(next_);
  next_.clear();
  place_ = 0;
}

void LedgerSums::renumber(std::span<const std::int32_t> newPlace) {
  for (SpringAccount& spring : springs_) {
    for (std::int32_t* place : {&spring.i, &spring.j})
      if (static_cast<std::size_t>(*place) < newPlace.size())
        *place = newPlace[static_cast<std::size_t>(*place)];
    if (spring.j < spring.i) std::swap(spring.i, spring.j);
  }
  std::ranges::sort(springs_, {}, pairOf);
}

GRAIN_INLINE void LedgerSums::plateSpring(SpringAccount& spring, SpringAccount now,
                                          const HalfKicks& power) {
  settle(spring, now, power.closing * scheme_.time.closing, &EnergyLedger::lostBottom);
  now.openingWork = power.opening * scheme_.time.opening;
  spring = now;
}

GRAIN_INLINE void LedgerSums::settle(const SpringAccount& before, const SpringAccount& now,
                                     double closingWork, double EnergyLedger::*term) {
  const double stiffening = 0.25 * (now.modulus - before.modulus) * (before.square + now.square);
  ledger.gainedByConvention += stiffening;
  if (before.sliding == 0 && now.sliding == 0) return;
  const double taken = -(before.openingWork + closingWork);
  spend(term, taken - (now.energy - before.energy - stiffening));
}

GRAIN_INLINE void LedgerSums::spend(double EnergyLedger::*term, double loss) {
  if (loss >= 0.0)
    ledger.*term += loss;
  else
    ledger.gainedByConvention -= loss;
}

void LedgerSums::release(const SpringAccount& before) {
  ledger.lostRelease += before.energy;
  if (before.sliding != 0) spend(&EnergyLedger::lostSliding, -before.openingWork);
}

}  // namespace grain
