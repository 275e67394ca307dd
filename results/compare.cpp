#include "results/compare.hpp"

#include "results/endpoints.hpp"
#include "results/engine_fields.hpp"
#include "results/flow_fields.hpp"
#include "results/lockstep_findings.hpp"

namespace crossgrain::inline results {

void fields(auto& io, AgreementRing& ring) {
  io("ring", ring.ring);
  io("difference", ring.difference);
  io("stderr", ring.standardError);
  io("low", ring.low);
  io("high", ring.high);
  io("margin", ring.margin);
  io("detects", ring.detects);
  io("within_share", ring.withinFraction);
  io("scale", ring.scale);
  io("packings", ring.packings);
  io("verdict", ring.verdict, agreementNames);
}

void fields(auto& io, AgreementRow& row) {
  io("a", row.a, aName);
  io("b", row.b, aName);
  io("kind", row.kind);
  io("field", row.field, aField);
  io("margin", row.margin);
  io("margin_relative", row.marginRelative);
  io("margin_why", row.marginWhy);
  io("verdict", row.verdict, agreementNames);
  io("detects", row.detects);
  io("rings", row.rings);
}

void fields(auto& io, NothingJudged& nothing) {
  io("reason", nothing.reason);
  io("by_request", nothing.byRequest);
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

}  // namespace crossgrain::inline results
