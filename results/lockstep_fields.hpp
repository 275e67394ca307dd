#pragma once

#include "results/engine_fields.hpp"
#include "results/lockstep_findings.hpp"

namespace crossgrain::inline results {

void fields(auto& io, LockstepRules& rules) {
  io("rounding", rules.rounding);
  io("same_law", rules.sameLaw);
  io("yardstick", rules.referencePerturbation);
  io("yardstick_change", rules.referenceChange);
  io("stray_share", rules.strayShare);
}

void fields(auto& io, LockstepStart& start) {
  io("packing", start.packing);
  io("time_s", start.time);
  io("wheel_angle", start.wheelAngle);
}

void fields(auto& io, LockstepSeparation& separation) {
  io("time_s", separation.time);
  io("median", separation.median);
  io("largest", separation.largest);
  io("yardstick", separation.referencePerturbation);
  io("rounding", separation.rounding);
  io("equivalent", separation.equivalent);
}

void fields(auto& io, StartReading& reading) {
  io("equivalent", reading.equivalent);
  io("until_s", reading.until);
  io("beyond", reading.beyond);
}

void fields(auto& io, ContactKinds& kinds) {
  io("sticking", kinds.sticking);
  io("sliding", kinds.sliding);
  io("new", kinds.made);
  io("opening", kinds.opened);
  io("wall", kinds.wall);
}

void fields(auto& io, FirstExceedance& first) {
  io("start", first.start);
  io("after_s", first.after);
  io("until_s", first.until);
  io("disk", first.disk);
  io("partner", first.partner);
  io("contact", first.contact);
  io("touching", first.touching);
}

void fields(auto& io, LockstepForces& forces) {
  io("contacts", forces.contacts);
  io("missing", forces.missing);
  io("extra", forces.extra);
  io("normal", forces.normal);
  io("tangential", forces.tangential);
}

void fields(auto& io, NamedTerm& term) {
  io("name", term.name);
  io("amount", term.amount);
  io("unexplained", term.unexplained);
}

void fields(auto& io, LockstepRow& row) {
  io("engine", row.engine, aName);
  io("verdict", row.verdict);
  io("reason", row.reason);
  io("equivalent", row.equivalent);
  io("equivalent_low", row.equivalentLow);
  io("equivalent_high", row.equivalentHigh);
  io("readings", row.readings);
  io("read", row.read);
  io("beyond", row.beyond);
  io("share_high", row.shareHigh);
  io.when(row.severalAtOnce, "several_at_once", row.severalAtOnce);
  io("resolution", row.resolution);
  io("starts", row.starts);
  io("same_to_its_precision", row.precise);
  io("failure", row.failure);
  io("separations", row.separations);
  io("track_time_s", row.trackTime);
  io("track", row.track);
  io("kinds", row.kinds);
  io("first", row.first);
  io("forces", row.forces);
  io("term", row.term);
  io("realised", row.effective);
  io("wall_s", row.wallSeconds);
}

void fields(auto& io, LockstepFindings& findings) {
  io("rules", findings.rules);
  io("starts", findings.starts);
  io("rows", findings.rows);
}

}  // namespace crossgrain::inline results
