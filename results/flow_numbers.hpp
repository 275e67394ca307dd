#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "averaging/regime.hpp"
#include "averaging/trend.hpp"
#include "results/schema.hpp"

/// Engines compared with each other; numbers of one run of a Couette cell, or of an engine's runs
/// together, and in what state runs were while they were averaged: in which regime, and steady or
/// not.
namespace crossgrain::inline results {

/// Why two engines are compared.
enum class PairKind {
  peer,                  ///< both were named
  mirrorModel,           ///< the reference and a mirror of a peer
  mirrorImplementation,  ///< a mirror and its peer
  effect,                ///< an engine and itself without an effect
  closedForm             ///< an expected value of the case (EndpointRow::reference) and an engine
};
constexpr auto namesOf(PairKind) {
  return std::array<std::string_view, 5>{"peer", "mirror_model", "mirror_implementation", "effect",
                                         "closed_form"};
}
/// `a` of such a pair.
inline constexpr const char* closedFormName = "closed-form";
/// `a` of an engine and the median of the others, packing by packing, where no engine is the
/// reference.
inline constexpr const char* medianName = "median";

/// On which scale a ring was tested: of values, or of their ratios.
enum class TestScale { linear, logarithmic };
constexpr auto namesOf(TestScale) {
  return std::array<std::string_view, 2>{"linear", "logarithmic"};
}

/// One ring of one field, in the field's unit: a ratio as the difference that it makes.
struct AgreementRing {
  std::size_t ring = 0;                             ///< from 0
  std::optional<double> difference, standardError;  ///< b − a
  std::optional<double> low, high;                  ///< interval of the difference
  std::optional<double> margin;                     ///< absent: relative, and there is nothing
  std::optional<double> detects;         ///< the smallest true difference found in 9 of 10 repeats
  std::optional<double> withinFraction;  ///< of the variance, due to finite runs
  TestScale scale = TestScale::linear;
  std::optional<int> packings;  ///< that both have
  Verdict verdict = Verdict::undecided;

  void fields(auto& io) {
    FIELDS(io, ring, difference, low, high, margin, detects, scale, packings);
    io("stderr", standardError);
    io("within_share", withinFraction);
    io("verdict", verdict, agreementNames);
  }
};

/// The verdict on one field of two engines.
struct AgreementRow {
  std::string a, b;  ///< the reference first
  PairKind kind = PairKind::peer;
  std::string field;
  std::optional<double>
      margin;  ///< of the reference where marginRelative, else in the field's unit
  bool marginRelative = false;
  std::string marginWhy;
  Verdict verdict = Verdict::undecided;
  std::optional<double> detects;  ///< in the ring that shows it best
  std::vector<AgreementRing> rings;

  void fields(auto& io) {
    io("a", a, aName);
    io("b", b, aName);
    FIELDS(io, kind, margin, marginRelative, marginWhy, detects, rings);
    io("field", field, aField);
    io("verdict", verdict, agreementNames);
  }
};

/// Where a command that judges has judged nothing: that is never a success by itself.
struct NothingJudged {
  std::string reason;      ///< ends the line "nothing was judged: …"
  bool byRequest = false;  ///< one engine: there was nothing to compare it with

  void fields(auto& io) { FIELDS(io, reason, byRequest); }
};

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
