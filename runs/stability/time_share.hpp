#pragma once

#include <chrono>
#include <cstddef>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>

namespace crossgrain::inline runs {

/// The part of a budget that one piece of work has, from its making on.
class TimeShare {
 public:
  /// @param seconds  infinite: as long as it takes
  explicit TimeShare(double seconds = std::numeric_limits<double>::infinity()) : all_(seconds) {}

  /// To be called before what is likely to take `seconds`. @throws OutOfTime where it would end
  /// later
  void require(double seconds) const;

 private:
  using Clock = std::chrono::steady_clock;
  double all_;  ///< [s]
  Clock::time_point began_ = Clock::now();
};

/// What was not run for want of time: no verdict on anybody.
class OutOfTime : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A budget that several pieces of work have together. Each has an equal part of what is left when
/// it begins, so that a slow engine takes no other's time, and what quick ones leave is used.
class TimeBudget {
 public:
  /// @param seconds  for all, from now on; infinite: as long as it takes
  /// @param pieces   of work, of which `jobs` are done at a time
  TimeBudget(double seconds, std::size_t pieces, int jobs)
      : all_(seconds), pieces_(pieces), jobs_(static_cast<std::size_t>(jobs)) {}

  /// Of the next piece; any thread may ask.
  TimeShare next();

 private:
  using Clock = std::chrono::steady_clock;
  double all_;  ///< [s]
  Clock::time_point began_ = Clock::now();
  std::mutex mutex_;
  std::size_t pieces_;  ///< not begun
  std::size_t jobs_;
};

}  // namespace crossgrain::inline runs
