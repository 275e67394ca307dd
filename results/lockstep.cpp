#include "results/lockstep.hpp"

#include "results/engine_fields.hpp"
#include "results/flow_fields.hpp"
#include "results/lockstep_findings.hpp"

namespace crossgrain::inline results {

Json toJson(const LockstepResults& results) {
  return jsonOf(results);
}
LockstepResults lockstepFromJson(const Json& json) {
  return readAs<LockstepResults>(json);
}

}  // namespace crossgrain::inline results
