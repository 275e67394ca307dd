#include "results/rev.hpp"

#include "results/flow_fields.hpp"

namespace crossgrain::inline results {

void fields(auto& io, RevCurve& curve) {
  io("method", curve.method, aName);
  io("field", curve.field, aField);
  io("unit", curve.unit, aUnit);
  io("r", curve.r);
  io("width", curve.width);
  io("mean", curve.mean);
  io("stderr", curve.standardError);
}

void fields(auto& io, RevMeeting& meeting) {
  io("method", meeting.method, aName);
  io("field", meeting.field, aField);
  io("near", meeting.near);
  io("width", meeting.width);
  io("difference", meeting.difference);
}

Json toJson(const RevResults& results) {
  return jsonOf(results);
}
RevResults revFromJson(const Json& json) {
  return readAs<RevResults>(json);
}

}  // namespace crossgrain::inline results
