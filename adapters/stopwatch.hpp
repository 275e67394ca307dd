#pragma once

#include <ctime>

namespace crossgrain {

/// Wall and CPU time summed over laps.
struct Stopwatch {
  /// Whose CPU time: the calling thread's; the whole process' where threads share the work.
  clockid_t cpuClock = CLOCK_THREAD_CPUTIME_ID;
  double wallSeconds = 0.0;
  double cpuSeconds = 0.0;

  /// Adds the time from its construction to its destruction.
  class Lap {
   public:
    explicit Lap(Stopwatch& watch)
        : watch_(watch), wall_(now(CLOCK_MONOTONIC)), cpu_(now(watch.cpuClock)) {}
    ~Lap() {
      watch_.wallSeconds += now(CLOCK_MONOTONIC) - wall_;
      watch_.cpuSeconds += now(watch_.cpuClock) - cpu_;
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
