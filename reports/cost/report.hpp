#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/common/report.hpp"
#include "results/cost.hpp"

/// Texts, tables and figures of a cost study.
namespace crossgrain::reports {

/// For a terminal: how many accuracies are decided, and the number of points by status.
std::string costText(const CostResults& results);

/// Output of --want, to be pasted: the fragment of each engine for the results' own target, all
/// else as TOML comments.
std::string costToml(const CostResults& results);

/// A row per point, those that did not run too. on_front is of the front over all engines; tied: it
/// is there because its time cannot be distinguished from that of a point which errs no more.
std::string costCsv(const CostResults& results);

/// A row per engine, size and number of workers, where steps were timed.
std::string scaleCsv(const CostResults& results);

/// cost_picture_MEASURE: errors of endpoints against processor time and of collisions against
/// steps; cost_KIND: error against time for collisions and trajectories.
std::vector<Figure> costFigures(const CostResults& results);

Report reportOf(const CostResults& results);

/// @name Functions that the report's parts share
/// @{

/// "precision float", "without friction", "velocity verlet, t_c/50"
std::string settingText(const std::string& knob, const std::string& setting);
/// "Ψ_f", "radial stress", "positions, compared with grain"; "Ψ_f, own limit"
std::string measureText(const std::string& measure);
/// Unit of an error kind's time: "one sweep of collisions".
std::string timeUnit(CostKind kind);

/// A measure of a kind of error.
struct CostMeasure {
  CostKind kind;
  std::string name;
  bool operator==(const CostMeasure&) const = default;
  bool has(const CostPoint& point) const { return point.kind == kind && point.measure == name; }
};

/// In the order of the points.
std::vector<CostKind> kindsIn(const std::vector<CostPoint>& points);

/// A setting that is no time step and has an error somewhere: what the numbers in plots stand for,
/// from 1.
struct OtherSetting {
  std::string knob, setting;
  bool operator==(const OtherSetting&) const = default;
};
std::vector<OtherSetting> otherSettings(const std::vector<CostPoint>& points);

/// Of rigid bodies, by engine and setting: the points with the largest of all endpoints' errors, or
/// that of the only one.
std::vector<const CostPoint*> largestErrors(const CostResults& results);

/// Per engine what smaller steps, more iterations and both take to be within the margins, and the
/// error at each step and number of iterations.
Blocks tradeBlocks(const CostResults& results);

/// cost_steps: time of a step and efficiency of workers against bodies; absent where nothing ran.
std::optional<Figure> stepFigure(const CostResults& results);
/// An engine, size and number of workers per row.
Table stepTable(const CostResults& results);

/// @}

}  // namespace crossgrain::reports
