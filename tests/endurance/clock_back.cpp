// For LD_PRELOAD: after CLOCK_BACK_AFTER looks at the time of day in a process the clock has been
// set back by an hour. Clocks that only count on are left alone.
#include <dlfcn.h>

#include <atomic>
#include <cstdlib>
#include <ctime>

extern "C" int clock_gettime(clockid_t clock, timespec* now) {
  static const auto real =
      reinterpret_cast<int (*)(clockid_t, timespec*)>(dlsym(RTLD_NEXT, "clock_gettime"));
  static const char* const after = std::getenv("CLOCK_BACK_AFTER");
  static std::atomic<long> looks;
  const int status = real(clock, now);
  if (clock == CLOCK_REALTIME && after != nullptr && ++looks > std::atol(after))
    now->tv_sec -= 3600;
  return status;
}
