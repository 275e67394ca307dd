#pragma once

#include <atomic>
#include <chrono>

#include "support/interrupt.hpp"

namespace crossgrain::inline averaging {

/// Ends what has gone on for a second after an interrupt. A snapshot's average takes milliseconds
/// as a rule: it is finished, and the run keeps where it is. @throws Interrupted
inline void throwIfLongInterrupted() {
  using Clock = std::chrono::steady_clock;
  static std::atomic<Clock::rep> seen{0};
  if (!interrupted()) return;
  const Clock::rep now = Clock::now().time_since_epoch().count();
  Clock::rep first = 0;
  if (seen.compare_exchange_strong(first, now)) return;
  if (Clock::duration(now - first) > std::chrono::seconds(1)) throwIfInterrupted();
}

}  // namespace crossgrain::inline averaging
