#include "results/cost.hpp"

#include "adapters/worker/json.hpp"

namespace crossgrain::inline results {

namespace {
constexpr std::string_view ownSuffix = "_own";
}

bool isOwn(const std::string& measure) {
  return measure.ends_with(ownSuffix);
}

std::string ownOf(const std::string& measure) {
  return measure + std::string(ownSuffix);
}

std::string withoutOwn(const std::string& measure) {
  const bool hasOther = isOwn(measure) && !measure.starts_with("position_rms_");
  return hasOther ? measure.substr(0, measure.size() - ownSuffix.size()) : measure;
}

std::optional<std::string> schemeOf(const std::string& knob, const std::string& setting) {
  if (knob == "time_step") return std::string();
  const auto comma = setting.find(',');
  if (knob != "integrator" || comma == std::string::npos) return std::nullopt;
  return setting.substr(0, comma);
}

std::size_t CostResults::count(Status status) const {
  return static_cast<std::size_t>(std::ranges::count(points, status, &CostPoint::status));
}

Json toJson(const CostResults& results) {
  return jsonOf(results);
}

CostResults costFromJson(const Json& json) {
  return readAs<CostResults>(json);
}

}  // namespace crossgrain::inline results
