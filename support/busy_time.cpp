#include "support/busy_time.hpp"

namespace crossgrain::inline support {

double BusyTime::seconds() const {
  const std::scoped_lock lock(mutex_);
  const Clock::duration now = underWay_ > 0 ? Clock::now() - since_ : Clock::duration{};
  return std::chrono::duration<double>(before_ + now).count();
}

void BusyTime::begin() {
  const std::scoped_lock lock(mutex_);
  if (underWay_++ == 0) since_ = Clock::now();
}

void BusyTime::end() {
  const std::scoped_lock lock(mutex_);
  if (--underWay_ == 0) before_ += Clock::now() - since_;
}

BusyTime& steppingTime() {
  static BusyTime time;
  return time;
}

BusyTime& drawingTime() {
  static BusyTime time;
  return time;
}

}  // namespace crossgrain::inline support
