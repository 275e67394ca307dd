#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "averaging/error_bounds.hpp"
#include "cases/cost_kind.hpp"

namespace crossgrain::inline results {

/// What became of a point.
enum class CostStatus {
  ran,
  failed,      ///< its engine broke down, or the step was beyond its stability limit
  refused,     ///< its engine has no such setting
  notMeasured  ///< the budget did not allow it; in files "undecided"
};
constexpr auto namesOf(CostStatus) {
  return std::array<std::string_view, 4>{"ran", "failed", "refused", "undecided"};
}
/// As in files.
inline std::string toString(CostStatus status) {
  return std::string(namesOf(status)[static_cast<std::size_t>(status)]);
}

/// What one setting of one engine costs and how wrong it is, in one kind of error and one measure:
/// a point of a work–precision plot, a row of cost.csv.
struct CostPoint {
  std::string engine;
  /// The name of a CostKnob (cases/cost_knobs.hpp); "effect:NAME" of an effect switched off; an
  /// engine's own setting goes by its name.
  std::string knob;
  std::string setting;   ///< readable, e.g. "t_c/50"
  std::string fragment;  ///< TOML that, in a case that extends this one, gives this setting
  CostKind kind = CostKind::collision;    ///< of error
  std::string measure;                    ///< what the error is of: "psi_f", "stress_rr", …
  std::optional<double> dt;               ///< absent where an engine refused [s]
  std::optional<double> stepsPerContact;  ///< t_c of the stiffest, lightest pair divided by dt

  /// Relative to a scale that the kind names (a curve's range, d, a profile's largest value) [-].
  std::optional<double> error;
  /// Of averages: the standard error in `error`, and |bias| with that part removed; absent where
  /// they cannot be told apart [-].
  std::optional<double> statistical, systematic;
  std::optional<double> referenceError;  ///< what the reference itself is uncertain by [-]
  /// Of averages: ends of the error's confidence interval, all rings and measures together [-].
  std::optional<double> low, high;
  /// Of averages at a setting that leaves the law as it is: how far it lies from small steps of the
  /// same engine, as the change of k_n that would part two runs as far (ε_eq) [-], and what that
  /// changes averages by at most (B) [-].
  std::optional<double> equivalent, bound;

  /// Of the advance alone, per unit that all points of one kind and measure share: a sweep of
  /// collisions, the trajectory's window, one rotation [s].
  std::optional<double> wallSeconds, cpuSeconds;
  std::optional<std::uint64_t> steps, contactEvaluations;  ///< per the same unit

  CostStatus status = CostStatus::ran;
  std::string reason;  ///< unless it ran: one line

  bool ran() const { return status == CostStatus::ran; }
};

/// A point's error with what it is uncertain by. Absent without an error and a bound.
std::optional<MeasuredError> measuredError(const CostPoint& point);

/// Whether a measure's error is told against its engine's own limit of small steps, whose law may
/// be another than the scene's: "psi_f_own", "position_rms_own".
bool isOwn(const std::string& measure);
/// "psi_f" → "psi_f_own"
std::string ownOf(const std::string& measure);
/// "psi_f_own" → "psi_f"; of positions, whose name says whom they are held against, what they are.
std::string sceneOf(const std::string& measure);

/// What a point counts with on a front and in plots. Absent unless it ran and its error says
/// anything.
std::optional<double> countedError(const CostPoint& point);

/// Whether a point's error is below what it is uncertain by.
bool mayBeChance(const CostPoint& point);

/// Which series of time steps a setting belongs to: that of an engine's own integrator (empty), or
/// of another one, whose settings are "INTEGRATOR, STEP". Absent of settings of other knobs.
std::optional<std::string> schemeOf(const std::string& knob, const std::string& setting);

}  // namespace crossgrain::inline results
