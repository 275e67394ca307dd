#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "results/thesis_runs.hpp"

/// Numbers of one run as formulas, of which the tables of claims and figures are made.
namespace crossgrain::inline results {

/// A run's number. What one run alone knows of its error counts only where there is no second run.
struct Measured {
  double value = 0.0;
  std::optional<double> within;  ///< standard error within the run

  Measured(double number, std::optional<double> error = {})  // NOLINT: a number is one
      : value(number), within(error) {}
};

/// A number, or one for each ring.
struct FormulaValue {
  Numbers values;
  bool perRing = false;
  bool exact = false;  ///< has no error, as what somebody chose
  Numbers errors;      ///< standard errors within the run; absent where they are not known
};

/// What a formula is evaluated for.
struct FormulaContext {
  const CaseRun& at;
  const std::vector<Profile>& profiles;  ///< of the run, on one width of rings
  std::string method = {};               ///< empty: the first one
  /// Numbers that the user of the formula gives: by name; exact where somebody chose them. Absent:
  /// it knows none of that name.
  std::function<std::optional<FormulaValue>(std::string_view name)> named = {};
};

// clang-format off
/// A formula as one would write it: + − * / and parentheses of
///   numbers and names   pi; d, R_i, R_o, height, omega, kn, kt of the case; cpu_s, steps, dt of
///                       the run; those that the context names
///   rings               any field of profiles.csv; r [m], r_tilde
///   functions           abs ln lg exp sqrt cos positive (absent unless > 0)
///   of rings            mean median rms scatter (relative) max min axis (of angles up to π, by
///                       their doubled angles) (x), or (x, from, to) of r̃ within from ≤ r̃ < to, or
///                       (x, zone) of band, inside_band, bulk (numbers that the context names) or
///                       off_walls; ring(x, k) from 0, near(x, r̃), last(x); where(x, y, limit): x
///                       of the rings whose y is that at least
///   of other averages   by(method, x); fine(x) on the finest rings that there are fewest_fine of
///   of the run          fit(name), head(name), averaged(number of its history)
/// A number that is missing, not finite, or ÷ 0 makes what it is part of absent. An error within
/// the run survives × and ÷ with exact numbers, abs, positive, and the choice of a ring.
// clang-format on
class Formula {
 public:
  using Evaluator = std::function<FormulaValue(const FormulaContext&)>;

  /// @throws std::logic_error for text that is no formula
  Formula(std::string_view text);  // NOLINT: a text is one
  Formula(const char* text) : Formula(std::string_view(text)) {}

  /// @throws std::logic_error for a name that nobody knows
  FormulaValue operator()(const FormulaContext& context) const { return evaluate_(context); }
  std::optional<Measured> number(const FormulaContext& context) const;
  /// Ring by ring, as many as the profiles have.
  FormulaValue rings(const FormulaContext& context) const;
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  Evaluator evaluate_;
};

/// A number without an error that is known; one that has none.
FormulaValue uncertain(std::optional<double> value);
FormulaValue chosen(double value);

/// The finest rings of a run that are at least so many; null if there are none.
const RingAverages* finestOf(const ThesisRun& run, double fewest = 0.0);

}  // namespace crossgrain::inline results
