#include "results/run.hpp"

#include <algorithm>

#include "results/flow_fields.hpp"

namespace crossgrain::inline results {

Json toJson(const FlowRun& run) {
  return jsonOf(run);
}
FlowRun runFromJson(const Json& json) {
  return readAs<FlowRun>(json);
}

const Profile* profileOf(const std::vector<Profile>& profiles, std::string_view field) {
  const auto found = std::ranges::find(profiles, field, &Profile::field);
  return found == profiles.end() ? nullptr : &*found;
}

const Profile* profileOf(const std::vector<Profile>& profiles, std::string_view method,
                         std::string_view field) {
  const auto found = std::ranges::find_if(profiles, [&](const Profile& profile) {
    return profile.field == field && profile.method == method;
  });
  return found == profiles.end() ? nullptr : &*found;
}

}  // namespace crossgrain::inline results
