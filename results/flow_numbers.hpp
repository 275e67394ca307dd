#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Numbers of one run of a Couette cell, or of an engine's runs together.
namespace crossgrain::inline results {

/// Absent is what nobody knows.
using Numbers = std::vector<std::optional<double>>;

/// Numbers of the whole cell over time, by name: "t_s", "wheel_torque", …, "energy_…" of a ledger.
/// All are as long as "t_s". @see CouetteSeries
using RunSeries = std::map<std::string, Numbers>;

/// Empty where there is no such series.
inline const Numbers& valuesOf(const RunSeries& series, const std::string& name) {
  static const Numbers none;
  const auto found = series.find(name);
  return found == series.end() ? none : found->second;
}

/// A dimensionless number that says what kind of flow a run was.
struct HeadNumber {
  std::string name, unit;
  std::optional<double> value;
  std::optional<double> standardError;  ///< over packings
  std::optional<int> packings;          ///< that the mean is over; absent: one run
};

/// What is read off the profile of the spin, not fitted: it has no χ².
inline constexpr std::string_view spinInRing1 = "spin_ring_1";

/// A parameter of a fit, or why there is none. Means over packings are of those that could be
/// fitted, and absent where fewer than half could.
struct FitRow {
  std::string name, label, unit;
  std::optional<double> value, standardError;
  std::optional<double> chi2PerDof;  ///< where the points have errors
  std::optional<double> expected;    ///< by theory or the thesis
  std::string reason;
  std::optional<double> period;             ///< of an angle, known up to multiples of it
  std::optional<int> packings, ofPackings;  ///< fitted, of how many; absent: one run
};

/// What must hold in a steady state: ring by ring, or one number.
struct CheckRow {
  std::string name, label;
  Numbers value, standardError;
  Numbers reference;  ///< as long as value
  std::optional<double> referenceError;
  std::optional<std::string> note;
};

}  // namespace crossgrain::inline results
