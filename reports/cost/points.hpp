#pragma once

#include <optional>
#include <string>
#include <vector>

#include "averaging/error_bounds.hpp"
#include "reports/common/engines.hpp"
#include "reports/common/json_view.hpp"

/// results["points"] of kind "cost", and how they are told.
namespace crossgrain::reports {

/// One setting of one engine in one measure, as in results.json (reports/README.md).
struct CostRow {
  std::string engine, knob, setting, fragment, kind, measure, status, reason;
  std::optional<double> dt, stepsPerContact;                        ///< [s], [-]
  std::optional<double> error, statistical, systematic, reference;  ///< shares of a scale
  std::optional<double> wall, cpu, steps, contacts;                 ///< [s], [s], [-], [-]
  bool onFront = false;                                             ///< over all engines

  bool ran() const { return status == "ran"; }
  /// @pre the row has an error
  MeasuredError measured() const;
  /// MeasuredError::counted() of a point that ran: absent of averages over a single packing.
  std::optional<double> counted() const;
  bool mayBeChance() const;
  /// Of points that are joined over their time steps: empty, or the integrator of a setting
  /// "INTEGRATOR, STEP". Absent for all others.
  std::optional<std::string> scheme() const;
};

/// In the order of the results: places in "fronts", "orders" and "cheapest" are places here.
std::vector<CostRow> costRows(const Json& results);

/// The row at that place, or null.
const CostRow* rowAt(const std::vector<CostRow>& rows, const Json& place);

/// A measure of a kind of error.
struct CostMeasure {
  std::string kind, name;
  bool operator==(const CostMeasure&) const = default;
  bool has(const CostRow& row) const { return row.kind == kind && row.measure == name; }
};

/// In the order of the points, kinds together.
std::vector<CostMeasure> costMeasures(const std::vector<CostRow>& rows);
std::vector<std::string> costKinds(const std::vector<CostRow>& rows);

/// Engines that have points, in the order of the results' engines.
std::vector<EngineResults> costEngines(const Json& results);

/// A setting that belongs to no scheme and has an error somewhere: what the numbers in plots stand
/// for, from 1.
struct OtherSetting {
  std::string knob, setting;
  bool operator==(const OtherSetting&) const = default;
};
std::vector<OtherSetting> otherSettings(const std::vector<CostRow>& rows);

/// "precision float", "friction off"
std::string settingWords(const OtherSetting& setting);

/// The row of the time step that a row of another knob is held against: the same engine, kind and
/// measure with as many steps per contact, else with the same dt. Null if there is none.
const CostRow* baseOf(const std::vector<CostRow>& rows, const CostRow& row);

/// HTML: "Ψ<sub>f</sub>"; gnuplot's enhanced text; plain words.
std::string measureHtml(const std::string& measure);
std::string measureEnhanced(const std::string& measure);
std::string measureWords(const std::string& measure);

/// What one unit of an error kind's time is: "one sweep of collisions".
std::string timeUnit(const std::string& kind);

/// A share as people say it: 3.2 %, 0.0041 %, 2.1×10⁻⁷.
std::string shareText(std::optional<double> share);
/// A wanted accuracy: 10 %, 0.1 %, 10⁻⁶.
std::string wantText(double want);

}  // namespace crossgrain::reports
