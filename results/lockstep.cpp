#include "results/lockstep.hpp"

#include "results/flow_fields.hpp"
#include "results/lockstep_fields.hpp"

namespace crossgrain::inline results {

void fields(auto& io, LockstepResults& results) {
  fields(io, static_cast<FlowStudy&>(results));
  io("lockstep", results.lockstep);
}

Json toJson(const LockstepResults& results) {
  return jsonOf(results);
}
LockstepResults lockstepFromJson(const Json& json) {
  return readAs<LockstepResults>(json);
}

}  // namespace crossgrain::inline results
