#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "averaging/regime.hpp"
#include "averaging/trend.hpp"
#include "results/agreement.hpp"
#include "results/json_fields.hpp"

/// Numbers of one run of a Couette cell, or of an engine's runs together, and in what state runs
/// were while they were averaged: in which regime, and steady or not.
namespace crossgrain::inline results {

/// Absent is what is not known.
using Numbers = std::vector<std::optional<double>>;

/// Numbers of the whole cell over time, by name: "t_s", "wheel_torque", …, "energy_…" of a ledger.
/// All are as long as "t_s". @see CouetteAverages
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

  /// As of a fit: means over packings have the same members, whatever they are of.
  void fields(auto& io) {
    const bool mean = packings.has_value();
    std::optional<double> chi2;
    std::string reason;
    io("name", name, aName);
    io("value", value);
    io("unit", unit, aUnit);
    io.when(mean, "stderr", standardError);
    io.when(mean, "chi2_per_dof", chi2);
    io.when(mean, "reason", reason);
    io.present("packings", packings);
  }
};

/// Numbers read off the profile of the spin, not fitted: no χ².
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

  void fields(auto& io) {
    io("name", name, aName);
    FIELDS(io, label, value, reason, expected);
    io("unit", unit, aUnit);
    io("stderr", standardError);
    io.when(packings || name != spinInRing1, "chi2_per_dof", chi2PerDof);
    PRESENT_FIELDS(io, period, packings, ofPackings);
  }
};

/// Balance of a steady state: ring by ring, or one number.
struct CheckRow {
  std::string name, label;
  Numbers value, standardError;
  Numbers reference;  ///< as long as value
  std::optional<double> referenceError;
  std::optional<std::string> note;

  void fields(auto& io) {
    io("name", name, aName);
    FIELDS(io, label, value, reference);
    io("reference_stderr", referenceError);
    io("stderr", standardError);
    io.present("note", note);
  }
};

/// One run's regime with the figures that it was read from (averaging/regime.hpp).
struct RegimeRow {
  std::optional<Regime> regime;  ///< absent: the run does not show enough
  std::string reason;
  std::optional<double> wheelContacts, wheelSlip, shearShare, inertialNumber, blockedFraction;

  void fields(auto& io) {
    io("name", regime);
    FIELDS(io, reason, wheelContacts, wheelSlip, shearShare, inertialNumber);
    io("blocked_share", blockedFraction);
  }
};

/// How a series changed over the averaged time (averaging/trend.hpp).
struct SeriesDrift {
  std::string quantity;  ///< name of the series
  RelativeDrift drift;

  void fields(auto& io) {
    io("quantity", quantity, aName);
    FIELDS(io, drift.verdict, drift.change, drift.excluded);
    io("half_width", drift.half);
  }
};

/// Of one engine, over packings.
struct EngineDrift : SeriesDrift {
  std::string engine;
  int packings = 0;
  std::vector<int> drifting;  ///< indices of those that drift by themselves

  void fields(auto& io) {
    SeriesDrift::fields(io);
    io("engine", engine, aName);
    FIELDS(io, packings, drifting);
  }
};

/// The packings that two engines both have a regime for, and those on which it is not the same.
struct RegimesOfPair {
  std::string a, b;
  PairKind kind = PairKind::peer;
  int packings = 0;
  std::vector<int> differ;  ///< indices of packings

  void fields(auto& io) {
    io("a", a, aName);
    io("b", b, aName);
    FIELDS(io, kind, packings, differ);
  }
};

}  // namespace crossgrain::inline results
