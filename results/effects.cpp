#include "results/effects.hpp"

namespace crossgrain::inline results {

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

Json toJson(const EffectsResults& results) {
  return jsonOf(results);
}
EffectsResults effectsFromJson(const Json& json) {
  return readAs<EffectsResults>(json);
}

}  // namespace crossgrain::inline results
