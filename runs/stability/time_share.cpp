#include "runs/stability/time_share.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace crossgrain::inline runs {
namespace {

double secondsSince(std::chrono::steady_clock::time_point began) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

}  // namespace

void TimeShare::require(double seconds) const {
  if (const double left = all_ - secondsSince(began_); !(seconds <= left))
    throw OutOfTime(fmt::format("its part of the budget, {:.3g} s, leaves no time for it", all_));
}

TimeShare TimeBudget::next() {
  const std::scoped_lock lock(mutex_);
  const double left = std::max(0.0, all_ - secondsSince(began_));
  const double parts = static_cast<double>(std::max(pieces_, std::size_t{1}));
  if (pieces_ > 0) --pieces_;
  return TimeShare(left * std::min(1.0, static_cast<double>(jobs_) / parts));
}

}  // namespace crossgrain::inline runs
