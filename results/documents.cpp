// Results of every kind as documents and back.
#include <algorithm>
#include <concepts>

#include "adapters/worker/json.hpp"
#include "results/collision.hpp"
#include "results/compare.hpp"
#include "results/conformance.hpp"
#include "results/cost.hpp"
#include "results/effects.hpp"
#include "results/regression.hpp"
#include "results/stability.hpp"

namespace crossgrain::inline results {

std::size_t ConformanceResults::count(CheckOutcome outcome) const {
  return static_cast<std::size_t>(std::ranges::count(rows, outcome, &ConformanceRow::outcome));
}

std::optional<double> ConformanceResults::partExamined() const {
  if (declared.value_or(0) == 0) return std::nullopt;
  return 1.0 - static_cast<double>(notExamined.size()) / static_cast<double>(*declared);
}

void fields(auto& io, RingChange& ring) {
  FIELDS(io, ring.ring, ring.reference, ring.change, ring.p, ring.resolved, ring.low, ring.high,
         ring.smallest);
  io("stderr", ring.standardError);
  io("verdict", ring.verdict, agreementNames);
}

void fields(auto& io, ChangedField& field) {
  io("field", field.field, aField);
  io("unit", field.unit, aUnit);
  FIELDS(io, field.judged, field.rings);
  io("verdict", field.verdict, agreementNames);
}

template <typename Results>
Json toJson(const Results& results) {
  return jsonOf(results);
}

template <typename Results>
Results fromJson(const Json& json) {
  auto results = readAs<Results>(json);
  if constexpr (std::same_as<Results, CompareResults>)
    // Pages and tables of a comparison begin with the first engine, the reference.
    if (results.head.kind == kindCompare && results.engines.empty())
      throw FieldError("engines: are none");
  return results;
}

template Json toJson(const CollideResults&);
template Json toJson(const CompareResults&);
template Json toJson(const ConformanceResults&);
template Json toJson(const CostResults&);
template Json toJson(const DiffResults&);
template Json toJson(const EffectsResults&);
template Json toJson(const FlowRun&);
template Json toJson(const LockstepResults&);
template Json toJson(const ReplayResults&);
template Json toJson(const RevResults&);
template Json toJson(const StabilityResults&);
template CollideResults fromJson(const Json&);
template CompareResults fromJson(const Json&);
template ConformanceResults fromJson(const Json&);
template CostResults fromJson(const Json&);
template EffectsResults fromJson(const Json&);
template FlowRun fromJson(const Json&);
template LockstepResults fromJson(const Json&);
template RevResults fromJson(const Json&);
template StabilityResults fromJson(const Json&);

}  // namespace crossgrain::inline results
