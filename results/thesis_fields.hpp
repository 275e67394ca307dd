#pragma once

#include "results/collision_fields.hpp"
#include "results/flow_fields.hpp"
#include "results/thesis.hpp"

/// Members of `thesis`' results (results/json_fields.hpp).
namespace crossgrain::inline results {

void fields(auto& io, ThesisCase& setup) {
  io("name", setup.name, aName);
  io("purpose", setup.purpose);
  io("file", setup.file);
  io("families", setup.families);
  io("cell", setup.cell);
  io("label", setup.label);
  io("kn", setup.kn);
  io("mu", setup.mu);
  io("bottom_friction", setup.bottomFriction);
  io("settle_rotations", setup.settleRotations);
  io("averaged_rotations", setup.averagedRotations);
  io("toml", setup.caseToml);
}

void fields(auto& io, ThesisSpan& span) {
  io("from", span.from);
  io("to", span.to);
  io("outer_pressure", span.outerPressure);
  io("wheel_torque", span.wheelTorque);
  io("wheel_contacts", span.wheelContacts);
  io("wheel_touched", span.wheelTouched);
  io("coordination", span.coordination);
  io("volume_fraction_at_wheel", span.volumeFractionAtWheel);
  io("volume_fraction_outside", span.volumeFractionOutside);
  io("velocity_at_wheel", span.velocityAtWheel);
  io("kinetic_energy", span.kineticEnergy);
  io("max_overlap", span.maxOverlap);
  io("mean_overlap", span.meanOverlap);
}

void fields(auto& io, RingAverages& averages) {
  io("count", averages.rings);
  io("places", averages.places);
  io("profiles", averages.profiles);
}

void fields(auto& io, ThesisRun& run) {
  io("leg", run.setup, aName);
  io("engine", run.engine, aName);
  io("packing", run.packing);
  io("seed", run.seed);
  io("key", run.key);
  io("program", run.program);
  io("run", run.run);
  io("finer", run.finer);
  io("history", run.history);
}

void fields(auto& io, ClaimFigure& figure) {
  io("name", figure.name);
  io("unit", figure.unit, aUnit);
  io("value", figure.value);
  io("stderr", figure.standardError);
  io("low", figure.low);
  io("high", figure.high);
  io("key", figure.key);
  io("verdict", figure.verdict);
}

void fields(auto& io, ClaimRow& row) {
  io("id", row.id);
  io("claim", row.claim);
  io("engine", row.engine, aName);
  io("carrier", row.mirror, aName);
  io("reading", row.interpretation);
  io("figures", row.figures);
  io("verdict", row.verdict);
  io("why", row.why);
  io("reasons", row.reasons);
  io("legs", row.cases);
  io("plot", row.plot);
}

void fields(auto& io, ThesisSurrogate& surrogate) {
  io("engine", surrogate.engine, aName);
  io("mirror", surrogate.mirror, aName);
  io("carries", surrogate.accepted);
  io("equivalent", surrogate.equivalent);
  io("starts", surrogate.starts);
  io("why", surrogate.why);
}

}  // namespace crossgrain::inline results
