#pragma once

#include <ctime>

namespace crossgrain {

/// Wall and CPU time summed over laps.
struct Stopwatch {
  double wallSeconds = 0.0;
  double cpuSeconds = 0.0;  ///< of the calling thread

  /// Adds the time from its construction to its destruction.
  class Lap {
   public:
    explicit Lap(Stopwatch& watch)
        : watch_(watch), wall_(now(CLOCK_MONOTONIC)), cpu_(now(CLOCK_THREAD_CPUTIME_ID)) {}
    ~Lap() {
      watch_.wallSeconds += now(CLOCK_MONOTONIC) - wall_;
      watch_.cpuSeconds += now(CLOCK_THREAD_CPUTIME_ID) - cpu_;
    }
    Lap(const Lap&) = delete;
    Lap& operator=(const Lap&) = delete;

   private:
    static double now(clockid_t clock) {
      timespec time{};
      clock_gettime(clock, &time);
      return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }
    Stopwatch& watch_;
    double wall_, cpu_;
  };
};

}  // namespace crossgrain
