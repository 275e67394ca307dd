#pragma once

#include "results/endpoints.hpp"
#include "results/json_fields.hpp"

namespace crossgrain::inline results {

void fields(auto& io, EndpointRow& row) {
  io("a", row.a, aName);
  io("b", row.b, aName);
  io("kind", row.kind);
  io("endpoint", row.endpoint, aName);
  io("unit", row.unit, aUnit);
  io("margin", row.margin);
  io("margin_relative", row.marginRelative);
  io("margin_why", row.marginWhy);
  io("answer", row.answer);
  io("reference", row.reference);
  io("difference", row.difference);
  io("low", row.low);
  io("high", row.high);
  io("distance", row.distance);
  io("distance_low", row.distanceLow);
  io("distance_high", row.distanceHigh);
  io("look", row.look);
  io("packings", row.packings);
  io("lost", row.lost);
  io.when(!row.reason.empty(), "reason", row.reason);
  io.present("needs", row.needs);
  io.present("needs_at_most", row.needsAtMost);
  io.when(!row.surrogateA.empty(), "carrier_a", row.surrogateA, aName);
  io.when(!row.surrogateB.empty(), "carrier_b", row.surrogateB, aName);
  io.present("bound", row.bound);
  io.present("reach", row.reach);
}

void fields(auto& io, InterimRow& look) {
  io("packings", look.packings);
  io("alpha", look.alpha);
}

void fields(auto& io, InterimFindings& looks) {
  io("planned", looks.planned);
  io.present("agree_alpha", looks.agreeAlpha);
  io("taken", looks.taken);
  io("budget_s", looks.budget);
  io("ended", looks.ended);
}

void fields(auto& io, EndpointResponse& response) {
  io("endpoint", response.endpoint, aName);
  io("constant", response.constant, aName);
  io("change", response.change);
  io("difference", response.difference);
  io("bound", response.bound);
  io("scatter", response.scatter);
  io("packings", response.packings);
}

void fields(auto& io, SpotCheckNumber& number) {
  io("endpoint", number.endpoint, aName);
  io("difference", number.difference);
  io("floor", number.floor);
  io("chance", number.chance);
  io("reach", number.reach);
}

void fields(auto& io, EquivalentChange& equivalent) {
  io("constant", equivalent.constant);
  io("change", equivalent.change);
}

void fields(auto& io, LateWindows& late) {
  io("packing", late.packing);
  io("times_s", late.times);
  io("length_s", late.length);
  io("equivalents", late.equivalents);
  io("failure", late.failure);
}

void fields(auto& io, SurrogateEngine& carried) {
  io("engine", carried.engine, aName);
  io("mirror", carried.mirror, aName);
  io("equivalent", carried.equivalent);
  io("starts", carried.starts);
  io("canary_packing", carried.spotCheckPacking);
  io("canary", carried.spotCheck);
  io("alarm", carried.alarm);
  io("carried", carried.carried);
  io("late", carried.late);
}

void fields(auto& io, AlarmRow& alarm) {
  io("a", alarm.a, aName);
  io("b", alarm.b, aName);
  io("kind", alarm.kind);
  io("what", alarm.what);
}

void fields(auto& io, EndpointFindings& findings) {
  io("looks", findings.looks);
  io("rows", findings.rows);
  io("alarms", findings.alarms);
  io("carried", findings.carried);
  io("responses", findings.responses);
}

}  // namespace crossgrain::inline results
