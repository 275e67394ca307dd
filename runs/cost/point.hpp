#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace crossgrain::inline runs {

/// What one setting of one engine costs and how wrong it is, in one kind of error and one measure:
/// a point of a work–precision plot, a row of cost.csv.
struct CostPoint {
  std::string engine;
  /// "time_step", "integrator", "precision", "tangential", "tension", "skin", "iterations",
  /// "length_unit", "method", "snapshots", "omega", "stiffness", "effect:NAME"; an engine's own
  /// setting goes by its name
  std::string knob;
  std::string setting;    ///< readable, e.g. "t_c/50"
  std::string fragment;   ///< TOML that, in a case that extends this one, gives this setting
  std::string errorKind;  ///< "collision" | "trajectory" | "averages"
  std::string measure;    ///< what the error is of: "psi_f", "position_rms_own", "stress_rr", …
  double dt = 0.0;        ///< 0: not known, as where an engine refused [s]
  std::optional<double> stepsPerContact;  ///< t_c of the stiffest, lightest pair divided by dt

  /// Relative to a scale that the kind names (a curve's range, d, a profile's largest value) [-].
  std::optional<double> error;
  /// Of averages: the standard error in `error`, and |bias| with that part removed; absent where
  /// they cannot be told apart [-].
  std::optional<double> statistical, systematic;
  std::optional<double> referenceError;  ///< what the reference itself is uncertain by [-]

  /// Of the advance alone, per unit that all points of one kind and measure share: a sweep of
  /// collisions, the trajectory's window, one rotation [s].
  std::optional<double> wallSeconds, cpuSeconds;
  std::uint64_t steps = 0, contactEvaluations = 0;  ///< per the same unit; 0: not measured

  std::string status = "ran";  ///< "ran" | "failed" | "refused" | "undecided"
  std::string reason;          ///< of the last three: one line
};

/// An entry of results.json's "points", both ways; absent numbers are null.
nlohmann::json toJson(const CostPoint& point);
CostPoint costPointFromJson(const nlohmann::json& entry);

}  // namespace crossgrain::inline runs
