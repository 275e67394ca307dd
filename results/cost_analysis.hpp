#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cases/cost_kind.hpp"

/// What is found out from the points of a study of cost. Points are given by their place in
/// CostResults::points.
namespace crossgrain::inline results {

enum class OrderVerdict {
  met,
  notMet,
  exceeded,
  undecided,  ///< the interval is wider than half an order
  noClaim,
  noFit
};
constexpr auto namesOf(OrderVerdict) {
  return std::array<std::string_view, 6>{"met",       "not met",  "exceeded",
                                         "undecided", "no claim", "no fit"};
}
inline std::string toString(OrderVerdict verdict) {
  return std::string(namesOf(verdict)[static_cast<std::size_t>(verdict)]);
}

/// A point that a fit does not use, and why: one line.
struct LeftOut {
  std::size_t point = 0;
  std::string why;
};

/// The order p of error ∝ dt^p, fitted to the points of one engine, one scheme and one measure.
struct OrderFit {
  std::string engine;
  CostKind kind = CostKind::collision;
  std::string measure;
  std::string integrator;                      ///< empty: the one the engine has by itself
  std::optional<double> order, standardError;  ///< absent: no fit
  std::optional<double> halfWidth;             ///< of the 95 % interval, Student's t
  std::optional<double> amplitude;             ///< the fit's error at dt = 1 s
  std::optional<double> dtLow, dtHigh;         ///< of the points used [s]
  std::vector<std::size_t> used;               ///< by rising dt
  std::vector<LeftOut> leftOut;
  std::optional<double> theory;  ///< the order that is claimed
  OrderVerdict verdict = OrderVerdict::noFit;
  std::string reason;  ///< of no fit: one line
};

/// The points of one kind and measure that no other beats in both error and time.
struct Front {
  CostKind kind = CostKind::collision;
  std::string measure;
  std::string engine;  ///< empty: over all engines
  std::vector<std::size_t> points;
  std::vector<double> errors;  ///< that these points count with
};

/// Whether an accuracy that is wanted, the target, is reached.
enum class CostVerdict {
  reached,
  undecided,   ///< the error's interval holds the target
  notReached,  ///< and every setting of the plan that may do better was run
  notMeasured  ///< nor was every such setting
};
constexpr auto namesOf(CostVerdict) {
  return std::array<std::string_view, 4>{"reached", "undecided", "not reached", "not measured"};
}
inline std::string toString(CostVerdict verdict) {
  return std::string(namesOf(verdict)[static_cast<std::size_t>(verdict)]);
}

/// "collision and averages"
std::string inWords(const std::vector<CostKind>& kinds);

/// The cheapest measured setting of one engine whose error is at most the target. Nothing is
/// interpolated. A setting meets the target if its upper bound (measuredError()) does; it may, if
/// only the lower bound does. Of averages that is the systematic part: the statistical part falls
/// with simulated time, and `length` says how much of it the target takes.
struct Cheapest {
  std::string engine;
  CostKind kind = CostKind::collision;
  std::string measure;
  double target = 0.0;  ///< 0.01 is 1 %
  CostVerdict verdict = CostVerdict::notMeasured;
  /// Reached: the cheapest that meets the target. Undecided: the cheapest that may. Not reached and
  /// not measured: the one with the smallest upper bound. Absent if no point has an error.
  std::optional<std::size_t> point = {};
  std::optional<double> high = {};  ///< that point's upper bound
  /// Simulated time that makes its statistical part as small as the target, in units of what was
  /// simulated: (statistical/target)².
  std::optional<double> length = {};
  std::optional<std::size_t> cheaper = {};  ///< reached: an undecided point that would be cheaper
  std::string decides = {};                 ///< what would decide on the undecided point, or at all
};

/// The one setting of an engine that meets a target in collisions and in averages, in every measure
/// of both, as far as the engine was measured in them at all.
struct Advice {
  std::string engine;
  double target = 0.0;
  CostVerdict verdict = CostVerdict::notMeasured;  ///< as of Cheapest
  /// Reached: the cheapest; else the one whose largest upper bound is smallest. Absent settings are
  /// empty.
  std::string knob, setting, fragment;
  std::vector<CostKind> kinds;  ///< in which it was measured
  /// Of a sweep of collisions or of one rotation, whichever costKind() says [s].
  std::optional<double> wallSeconds;
  std::optional<double> length;  ///< as of Cheapest, of the measure that takes longest
  /// Unless reached: the point that stands in the way, and, of undecided, what would decide on it.
  std::optional<std::size_t> obstacle;
  std::string decides;
  bool cheapest = false;  ///< of the engines that reach this target in the same kinds

  /// Whose time counts: averages if they were measured.
  std::optional<CostKind> costKind() const {
    return kinds.empty() ? std::nullopt : std::optional(kinds.back());
  }
};

/// What an engine's error is told against.
enum class CostBasis {
  own,   ///< its own limit of small steps: what is left is discretisation
  scene  ///< the case's law: its model included
};
constexpr auto namesOf(CostBasis) {
  return std::array<std::string_view, 2>{"own", "scene"};
}
inline constexpr std::array costBases = {CostBasis::own, CostBasis::scene};

/// Which setting of an engine reaches an accuracy in one kind of error, in all its measures, for
/// the least time.
struct CostCell {
  std::string engine;
  CostKind kind = CostKind::collision;
  CostBasis basis = CostBasis::own;
  double target = 0.0;  ///< 0.01 is 1 %
  CostVerdict verdict = CostVerdict::notMeasured;
  std::string knob = {}, setting = {};     ///< as of Advice
  std::optional<double> wallSeconds = {};  ///< of that setting [s]
  std::optional<std::size_t> point = {};   ///< its measured figure: the measure that decides
  /// Not reached, of the case's law: place in CostResults::models of a model error that alone lies
  /// above the target.
  std::optional<std::size_t> model = {};
  std::string decides = {};  ///< as of Advice

  bool decided() const {
    return verdict == CostVerdict::reached || verdict == CostVerdict::notReached;
  }
};

}  // namespace crossgrain::inline results
