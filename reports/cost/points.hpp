#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/common/figure.hpp"
#include "results/cost.hpp"

/// The points of a study of cost as they are grouped to be shown.
namespace crossgrain::reports {

using CostPoints = std::vector<CostPoint>;

/// The point at that place, or null.
const CostPoint* pointAt(const CostPoints& points, std::optional<std::size_t> place);

/// By place: whether the point is on the front over all engines.
std::vector<bool> onFront(const CostResults& results);

/// A measure of a kind of error.
struct CostMeasure {
  CostKind kind;
  std::string name;
  bool operator==(const CostMeasure&) const = default;
  bool has(const CostPoint& point) const { return point.kind == kind && point.measure == name; }
};

/// In the order of the points, kinds together.
std::vector<CostMeasure> measuresIn(const CostPoints& points);
/// Those that have panels and columns: of averages not also those against engines' own limits.
std::vector<CostMeasure> measuresDrawn(const CostPoints& points);
std::vector<CostKind> kindsIn(const CostPoints& points);

/// An engine that has points.
struct CostEngine {
  std::string name;
  LineStyle style;
};
/// In the order of the results' engines.
std::vector<CostEngine> costEngines(const CostResults& results);

/// The time steps that points are joined over, schemeOf(); absent of other settings.
std::optional<std::string> schemeOf(const CostPoint& point);

/// A setting that belongs to no scheme and has an error somewhere: what the numbers in plots stand
/// for, from 1.
struct OtherSetting {
  std::string knob, setting;
  bool operator==(const OtherSetting&) const = default;
};
std::vector<OtherSetting> otherSettings(const CostPoints& points);

/// The point of the time step that one of another knob is held against: the same engine, kind and
/// measure with as many steps per contact, else with the same dt. Null if there is none.
const CostPoint* baseOf(const CostPoints& points, const CostPoint& point);

}  // namespace crossgrain::reports
