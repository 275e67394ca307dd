#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <vector>

namespace crossgrain::inline runs {

/// How long work goes on at its speed so far, in words: "12 s left". Nothing is foretold of the
/// first second and of the first hundredth.
/// @param fraction  of the work that is done
/// @param elapsed  since it began [s]
std::string timeLeft(double fraction, double elapsed);

/// What is done of some pieces of work, shown on standard error: one line that is redrawn with the
/// time left on a terminal, a plain line per finished piece elsewhere. Safe to call from all
/// threads.
class Progress {
 public:
  /// @param quiet  shows nothing
  explicit Progress(bool quiet);
  ~Progress();

  /// A new stage of work; weights [any unit] say how long each of its pieces takes.
  void begin(const std::string& stage, std::vector<double> weights);

  /// Piece `index` is done to that fraction; label is shown while it runs.
  void update(std::size_t index, const std::string& label, double fraction);
  /// Piece `index` is over; `line` says how it ended.
  void finish(std::size_t index, const std::string& line);
  /// A line of its own.
  void say(const std::string& line);

 private:
  void draw();
  void erase();

  bool quiet_, terminal_;
  std::mutex mutex_;
  std::string stage_;
  std::vector<double> weights_, fractions_;
  std::size_t finished_ = 0;
  std::vector<std::string> running_;
  std::chrono::steady_clock::time_point started_, drawn_;
  bool lineOpen_ = false;
};

}  // namespace crossgrain::inline runs
