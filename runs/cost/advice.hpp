#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runs/cost/point.hpp"

namespace crossgrain::inline runs {

/// 10 %, 1 %, 0.1 % and 1e-6.
std::vector<double> usualWants();

/// The cheapest measured setting of one engine whose error is at most `want`. Nothing is
/// interpolated. A setting meets the want if its upper bound (runs/cost/front.hpp) does; it may, if
/// only the lower bound does. Of averages that is the systematic part: the statistical part falls
/// with simulated time, and `length` says how much of it the want takes.
struct Cheapest {
  std::string engine, errorKind, measure;
  double want = 0.0;
  /// "reached" | "undecided" | "not reached" | "not measured". Not reached is said where every
  /// setting of the plan was run that may do better than the best; else it is not measured.
  std::string verdict;
  /// Reached: the cheapest that meets the want. Undecided: the cheapest that may. Not reached and
  /// not measured: the one with the smallest upper bound. Absent if no point has an error.
  std::optional<std::size_t> point;
  std::optional<double> high;  ///< that point's upper bound
  /// Simulated time that makes its statistical part as small as the want, in units of what was
  /// simulated: (statistical/want)².
  std::optional<double> length;
  std::optional<std::size_t> cheaper;  ///< reached: an undecided point that would be cheaper
  std::string decides;                 ///< what would decide on the undecided point, or at all
};

Cheapest cheapest(const std::vector<CostPoint>& points, const std::string& engine,
                  const std::string& errorKind, const std::string& measure, double want);

/// For every engine, kind and measure of the points and every want, in that order.
std::vector<Cheapest> cheapestTable(const std::vector<CostPoint>& points,
                                    const std::vector<double>& wants);

/// The one setting of an engine that meets a want in collisions and in averages, in every measure
/// of both, as far as the engine was measured in them at all.
struct Advice {
  std::string engine;
  double want = 0.0;
  std::string verdict;  ///< as of Cheapest
  /// Reached: the cheapest; else the one whose largest upper bound is smallest. Absent settings are
  /// empty.
  std::string knob, setting, fragment;
  std::vector<std::string> kinds;  ///< in which it was measured
  /// Of a sweep of collisions or of one rotation, whichever `costKind` says: averages if measured.
  std::optional<double> wallSeconds;
  std::string costKind;
  std::optional<double> length;  ///< as of Cheapest, of the measure that takes longest
  /// Unless reached: the point that stands in the way, and, of undecided, what would decide on it.
  std::optional<std::size_t> obstacle;
  std::string decides;
  bool cheapest = false;  ///< of the engines that reach this want in the same kinds
};

std::vector<Advice> advice(const std::vector<CostPoint>& points, const std::vector<double>& wants);

/// What `crossgrain cost --want` prints: one fragment per engine, all else as TOML comments.
std::string adviceAsToml(const std::vector<Advice>& advice, const std::vector<CostPoint>& points);

}  // namespace crossgrain::inline runs
