#include "results/collision.hpp"

#include "results/collision_fields.hpp"

namespace crossgrain::inline results {

Json toJson(const CollideResults& results) {
  return jsonOf(results);
}

CollideResults collideFromJson(const Json& json) {
  return readAs<CollideResults>(json);
}

}  // namespace crossgrain::inline results
