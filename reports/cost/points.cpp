#include "reports/cost/points.hpp"

#include <algorithm>
#include <cmath>

#include "reports/common/engines.hpp"

namespace crossgrain::reports {

namespace {

template <class Value>
void addOnce(std::vector<Value>& values, const Value& value) {
  if (std::ranges::find(values, value) == values.end()) values.push_back(value);
}

}  // namespace

const CostPoint* pointAt(const CostPoints& points, std::optional<std::size_t> place) {
  return place && *place < points.size() ? &points[*place] : nullptr;
}

std::vector<bool> onFront(const CostResults& results) {
  std::vector<bool> is(results.points.size(), false);
  for (const Front& front : results.fronts)
    for (const std::size_t place : front.points)
      if (front.engine.empty() && place < is.size()) is[place] = true;
  return is;
}

std::vector<CostKind> kindsIn(const CostPoints& points) {
  std::vector<CostKind> kinds;
  for (const CostPoint& point : points) addOnce(kinds, point.kind);
  return kinds;
}

std::vector<CostMeasure> measuresIn(const CostPoints& points) {
  std::vector<CostMeasure> measures;
  for (const CostKind kind : kindsIn(points))
    for (const CostPoint& point : points)
      if (point.kind == kind) addOnce(measures, CostMeasure{kind, point.measure});
  return measures;
}

std::vector<CostMeasure> measuresDrawn(const CostPoints& points) {
  auto measures = measuresIn(points);
  std::erase_if(measures, [](const CostMeasure& measure) {
    return measure.kind == CostKind::averages && isOwn(measure.name);
  });
  return measures;
}

std::vector<CostEngine> costEngines(const CostResults& results) {
  const std::vector<LineStyle> styles = engineStyles(results.engines);
  std::vector<CostEngine> engines;
  for (std::size_t k = 0; k < results.engines.size(); ++k)
    if (const std::string& name = results.engines[k].name;
        std::ranges::find(results.points, name, &CostPoint::engine) != results.points.end())
      engines.push_back({name, styles[k]});
  return engines;
}

std::optional<std::string> schemeOf(const CostPoint& point) {
  return crossgrain::schemeOf(point.knob, point.setting);
}

std::vector<OtherSetting> otherSettings(const CostPoints& points) {
  std::vector<OtherSetting> settings;
  for (const CostPoint& point : points)
    if (countedError(point) && !schemeOf(point)) addOnce(settings, {point.knob, point.setting});
  return settings;
}

const CostPoint* baseOf(const CostPoints& points, const CostPoint& point) {
  const auto near = [](const std::optional<double>& a, const std::optional<double>& b) {
    constexpr double rounding = 1e-6;
    return a && b && std::abs(*a - *b) <= rounding * std::abs(*b);
  };
  const CostPoint* sameStep = nullptr;
  for (const CostPoint& base : points) {
    if (base.knob != "time_step" || base.engine != point.engine || base.kind != point.kind ||
        base.measure != point.measure)
      continue;
    if (near(base.stepsPerContact, point.stepsPerContact)) return &base;
    if (!sameStep && near(base.dt, point.dt)) sameStep = &base;
  }
  return sameStep;
}

}  // namespace crossgrain::reports
