#pragma once

#include <chrono>
#include <mutex>

namespace crossgrain::inline support {

/// Wall time in which at least one piece of some kind of work was under way, however many are at
/// once.
class BusyTime {
 public:
  /// One piece, from here to the end of its scope.
  class Piece {
   public:
    explicit Piece(BusyTime& time) : time_(time) { time_.begin(); }
    ~Piece() { time_.end(); }
    Piece(const Piece&) = delete;
    Piece& operator=(const Piece&) = delete;

   private:
    BusyTime& time_;
  };

  /// Of pieces that have ended, and of those under way so far [s].
  double seconds() const;

 private:
  using Clock = std::chrono::steady_clock;

  void begin();
  void end();

  mutable std::mutex mutex_;
  int underWay_ = 0;
  Clock::time_point since_{};
  Clock::duration before_{};
};

/// Of this process: engines' steps, and the drawing of plots.
BusyTime& steppingTime();
BusyTime& drawingTime();

}  // namespace crossgrain::inline support
