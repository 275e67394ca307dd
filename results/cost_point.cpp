#include "results/cost_point.hpp"

namespace crossgrain::inline results {

std::optional<MeasuredError> measuredError(const CostPoint& point) {
  if (!point.error && !point.bound) return std::nullopt;
  // Packings differ.
  const bool scatters = point.kind == CostKind::averages;
  // Of one that is only bounded the bound is all that is known.
  MeasuredError error{point.error ? *point.error : *point.bound, point.statistical,
                      point.referenceError, scatters};
  if (point.low && point.high) error.interval = {*point.low, *point.high};
  error.bound = point.bound;
  return error;
}

namespace {
constexpr std::string_view ownSuffix = "_own";
}

bool isOwn(const std::string& measure) {
  return measure.ends_with(ownSuffix);
}

std::string ownOf(const std::string& measure) {
  return measure + std::string(ownSuffix);
}

std::optional<double> countedError(const CostPoint& point) {
  const auto error = measuredError(point);
  return point.ran() && error ? error->counted() : std::nullopt;
}

bool mayBeChance(const CostPoint& point) {
  const auto error = measuredError(point);
  return error && error->mayBeChance();
}

std::string sceneOf(const std::string& measure) {
  const bool isOther = isOwn(measure) && !measure.starts_with("position_rms_");
  return isOther ? measure.substr(0, measure.size() - ownSuffix.size()) : measure;
}

std::optional<std::string> schemeOf(const std::string& knob, const std::string& setting) {
  if (knob == "time_step") return std::string();
  const auto comma = setting.find(',');
  if (knob != "integrator" || comma == std::string::npos) return std::nullopt;
  return setting.substr(0, comma);
}

}  // namespace crossgrain::inline results
