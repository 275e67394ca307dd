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
    &EnergyLedger::lostSliding,       &EnergyLedger::lostRollingDamping,
    &EnergyLedger::lostRolling,       &EnergyLedger::lostBottom,
    &EnergyLedger::lostRelease,       &EnergyLedger::lostPlastic,
    &EnergyLedger::lostDetachment};

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

GRAIN_INLINE void LedgerSums::settleSpring(Spring kind, const HalfKicks& power) {
  SpringBook& book = bookOf(kind);
  SpringAccount& now = book.next.back();
  while (book.place < book.springs.size() && pairOf(book.springs[book.place]) < pairOf(now))
    release(book, book.springs[book.place++]);
  now.openingWork = power.opening * scheme_.time.opening;
  const double closingWork = power.closing * scheme_.time.closing;
  double spent;
  if (book.place < book.springs.size() && pairOf(book.springs[book.place]) == pairOf(now)) {
    spent = settle(book.springs[book.place++], now, closingWork, book.lost);
  } else {  // of a contact that has only begun
    SpringAccount before;
    before.modulus = now.modulus;
    spent = settle(before, now, closingWork, book.lost);
  }
  if (loss_ != nullptr) loss_->closing += spent;
}

void LedgerSums::endSprings() {
  for (SpringBook& book : books_) {
    while (book.place < book.springs.size()) release(book, book.springs[book.place++]);
    book.springs.swap(book.next);
    book.next.clear();
    book.place = 0;
  }
}

void LedgerSums::renumber(std::span<const std::int32_t> newPlace) {
  for (SpringBook& book : books_) {
    for (SpringAccount& spring : book.springs) {
      for (std::int32_t* place : {&spring.i, &spring.j})
        if (static_cast<std::size_t>(*place) < newPlace.size())
          *place = newPlace[static_cast<std::size_t>(*place)];
      if (spring.j < spring.i) std::swap(spring.i, spring.j);
    }
    std::ranges::sort(book.springs, {}, pairOf);
  }
}

GRAIN_INLINE void LedgerSums::plateSpring(SpringAccount& spring, SpringAccount now,
                                          const HalfKicks& power) {
  settle(spring, now, power.closing * scheme_.time.closing, &EnergyLedger::lostBottom);
  now.openingWork = power.opening * scheme_.time.opening;
  spring = now;
}

GRAIN_INLINE double LedgerSums::settle(const SpringAccount& before, const SpringAccount& now,
                                       double closingWork, double EnergyLedger::*term) {
  const double stiffening = 0.25 * (now.modulus - before.modulus) * (before.square + now.square);
  ledger.gainedByConvention += stiffening;
  if (before.sliding == 0 && now.sliding == 0) return 0.0;
  const double taken = -(before.openingWork + closingWork);
  return spend(term, taken - (now.energy - before.energy - stiffening));
}

GRAIN_INLINE double LedgerSums::spend(double EnergyLedger::*term, double loss) {
  if (loss >= 0.0) {
    ledger.*term += loss;
    return loss;
  }
  ledger.gainedByConvention -= loss;
  return 0.0;
}

void LedgerSums::release(const SpringBook& book, const SpringAccount& before) {
  ledger.*book.released += before.energy;
  if (before.sliding != 0) spend(book.lost, -before.openingWork);
}

}  // namespace grain
