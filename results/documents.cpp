// Results of every kind as documents and back.
#include <algorithm>
#include <concepts>

#include "adapters/worker/json.hpp"
#include "results/collision.hpp"
#include "results/conformance.hpp"
#include "results/cost.hpp"
#include "results/effects.hpp"
#include "results/regression.hpp"
#include "results/rev.hpp"
#include "results/stability.hpp"

namespace crossgrain::inline results {

void fields(auto& io, ConformanceRow& row) {
  io("part", row.part);
  io("check", row.name);
  io("what", row.what);
  io("outcome", row.outcome, checkNames);
  io("detail", row.detail);
  io("faults", row.faults);
  io("cause", row.cause);
  io("wall_s", row.seconds);
  io("about", row.about);
}

void fields(auto& io, ConformanceResults& results) {
  results.head.fields(io);
  io.present("elapsed_s", results.elapsed);
  io("engine", results.engine);
  io("checks", results.rows);
  io("cause", results.cause);
  io.present("declared", results.declared);
  io("not_examined", results.notExamined);
  io("at_defaults", results.atDefaults);
}

std::size_t ConformanceResults::count(CheckOutcome outcome) const {
  return static_cast<std::size_t>(std::ranges::count(rows, outcome, &ConformanceRow::outcome));
}

std::optional<double> ConformanceResults::partExamined() const {
  if (declared.value_or(0) == 0) return std::nullopt;
  return 1.0 - static_cast<double>(notExamined.size()) / static_cast<double>(*declared);
}

void fields(auto& io, RingChange& ring) {
  io("ring", ring.ring);
  io("reference", ring.reference);
  io("change", ring.change);
  io("stderr", ring.standardError);
  io("p", ring.p);
  io("resolved", ring.resolved);
  io("low", ring.low);
  io("high", ring.high);
  io("smallest", ring.smallest);
  io("verdict", ring.verdict, agreementNames);
}

void fields(auto& io, ChangedField& field) {
  io("field", field.field, aField);
  io("unit", field.unit, aUnit);
  io("judged", field.judged);
  io("verdict", field.verdict, agreementNames);
  io("rings", field.rings);
}

void fields(auto& io, EffectVariant& variant) {
  const bool ran = variant.status != Status::refused;
  const bool changes = ran && variant.isSwitched();
  io("engine", variant.engine, aName);
  io("effect", variant.effect, aName);
  io("status", variant.status, engineStatusNames);
  io("reason", variant.reason);
  io.when(ran, "step_s", variant.step);
  io.when(ran, "contacts_per_step", variant.contacts);
  io.when(ran, "time_ratio", variant.timeRatio);
  io.when(ran, "time_ratio_stderr", variant.timeRatioError);
  io.present("precision", variant.precision);
  io.present("effects", variant.effects);
  io.when(changes, "packings", variant.changes.packings);
  io.when(changes, "stderr_kind", variant.changes.bars);
  io.when(changes, "fields", variant.changes.fields);
  io.when(changes && !variant.changes.endpoints.empty(), "endpoints", variant.changes.endpoints);
}

void fields(auto& io, SwitchRow& row) {
  io("effect", row.effect, aName);
  io("what", row.what);
}

void fields(auto& io, TimingPlan& plan) {
  io("seconds", plan.seconds);
  io("rounds", plan.rounds);
}

void fields(auto& io, DeclaredChange& change) {
  io("name", change.name);
  io("before", change.before);
  io("now", change.now);
}

void fields(auto& io, CollisionChange& change) {
  io("name", change.name);
  io("variant", change.variant);
  io("quantity", change.quantity, aName);
  io("changed", change.changed);
  io("points", change.points);
  io("largest", change.largest);
  io("relative", change.relative);
  io("psi_i", change.psi);
  io("v_n", change.vn);
}

void fields(auto& io, ForcesChange& change) {
  io("frames", change.frames);
  io("normal", change.normal);
  io("tangential", change.tangential);
  io("walls", change.walls);
}

void fields(auto& io, DiffRow& row) {
  io("engine", row.engine, aName);
  io("version", row.version);
  io("before", row.before);
  io("version_before", row.versionBefore);
  io("verdict", row.verdict);
  io("reason", row.reason);
  io("failure", row.failure);
  io("declared", row.declared);
  io("windows", row.windows);
  io("mirrored", row.mirrored);
  io("windows_verdict", row.windowsVerdict);
  io("forces", row.forces);
  io("forces_verdict", row.forcesVerdict);
  io("collisions", row.collisions);
  io("sweeps", row.sweeps);
  io("collisions_verdict", row.collisionsVerdict);
  io("endpoints", row.endpoints);
}

void fields(auto& io, DiffResults& results) {
  results.head.fields(io);
  io("baseline", results.baseline);
  io("baseline_version", results.baselineVersion);
  io("changed_keys", results.changedKeys);
  io("rules", results.rules);
  io("starts", results.starts);
  io("engines", results.rows);
}

/// The list writes place and field as one.
void fields(auto& io, AnswerDifference& difference) {
  std::string where = difference.field + difference.place;
  io("field", where);
  io("then", difference.then);
  io("now", difference.now);
  io("off", difference.off);
  io("differ", difference.differ);
  io("of", difference.of);
}

void fields(auto& io, ReplayResults& results) {
  io("engine", results.engine);
  io("version", results.version);
  io("recorded_engine", results.recordedEngine);
  io("recorded_version", results.recordedVersion);
  io("recorded_stamp", results.recordedStamp);
  io("case", results.caseName);
  io("asked", results.asked);
  io("declared", results.declared);
  io("request", results.request);
  io("differences", results.differences);
  io("failure", results.failure);
}

void fields(auto& io, HardCase& setup) {
  io("case", setup.name, aName);
  io("variant", setup.variant);
  io("file", setup.file);
  io("tests", setup.tests);
  io("measure", setup.measure, aName);
  io("what", setup.what);
  io("unit", setup.unit, aUnit);
  io("limit", setup.limit);
  io("degraded_limit", setup.degradedLimit);
  io("why", setup.why);
  io("toml", setup.toml);
}

void fields(auto& io, StabilityResults& results) {
  results.head.fields(io);
  io.present("elapsed_s", results.elapsed);
  io("engines", results.engines);
  io("cases", results.cases);
  io("runs", results.runs);
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
