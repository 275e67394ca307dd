#include "results/lockstep.hpp"

#include "adapters/worker/json.hpp"
#include "results/lockstep_findings.hpp"

namespace crossgrain::inline results {

Json toJson(const LockstepResults& results) {
  return jsonOf(results);
}
LockstepResults lockstepFromJson(const Json& json) {
  return readAs<LockstepResults>(json);
}

}  // namespace crossgrain::inline results
