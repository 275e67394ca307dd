#include <algorithm>

#include "results/compare.hpp"
#include "results/rev.hpp"

namespace crossgrain::inline results {

Json toJson(const FlowRun& run) {
  return jsonOf(run);
}
FlowRun runFromJson(const Json& json) {
  return readAs<FlowRun>(json);
}

Json toJson(const CompareResults& results) {
  return jsonOf(results);
}
CompareResults compareFromJson(const Json& json) {
  auto results = readAs<CompareResults>(json);
  // Pages and tables of a comparison begin with the first engine, the reference.
  if (results.head.kind == kindCompare && results.engines.empty())
    throw FieldError("engines: are none");
  return results;
}

Json toJson(const LockstepResults& results) {
  return jsonOf(results);
}
LockstepResults lockstepFromJson(const Json& json) {
  return readAs<LockstepResults>(json);
}

Json toJson(const RevResults& results) {
  return jsonOf(results);
}
RevResults revFromJson(const Json& json) {
  return readAs<RevResults>(json);
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
