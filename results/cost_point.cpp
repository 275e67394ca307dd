#include "results/cost_point.hpp"

namespace crossgrain::inline results {

std::optional<MeasuredError> measuredError(const CostPoint& point) {
  if (!point.error) return std::nullopt;
  // Packings differ.
  const bool scatters = point.kind == CostKind::averages;
  return MeasuredError{*point.error, point.statistical, point.referenceError, scatters};
}

std::optional<double> countedError(const CostPoint& point) {
  const auto error = measuredError(point);
  return point.ran() && error ? error->counted() : std::nullopt;
}

bool mayBeChance(const CostPoint& point) {
  const auto error = measuredError(point);
  return error && error->mayBeChance();
}

std::optional<std::string> schemeOf(const std::string& knob, const std::string& setting) {
  if (knob == "time_step") return std::string();
  const auto comma = setting.find(',');
  if (knob != "integrator" || comma == std::string::npos) return std::nullopt;
  return setting.substr(0, comma);
}

}  // namespace crossgrain::inline results
