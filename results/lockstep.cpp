#include "results/lockstep.hpp"

#include "results/couette_fields.hpp"
#include "results/lockstep_fields.hpp"

namespace crossgrain::inline results {

void fields(auto& io, LockstepResults& results) {
  fields(io, static_cast<CouetteStudy&>(results));
  io("rules", results.rules);
  io("starts", results.starts);
  io("lockstep", results.rows);
}

Json toJson(const LockstepResults& results) {
  return jsonOf(results);
}
LockstepResults lockstepFromJson(const Json& json) {
  return readAs<LockstepResults>(json);
}

}  // namespace crossgrain::inline results
