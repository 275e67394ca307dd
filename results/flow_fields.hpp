#pragma once

#include "results/compare.hpp"
#include "results/engine_fields.hpp"
#include "results/head_fields.hpp"
#include "results/scene_picture_fields.hpp"
#include "results/schema.hpp"

/// Members of what results of Couette cases are made of (results/json_fields.hpp).
namespace crossgrain::inline results {

void fields(auto& io, CouetteCell& cell) {
  io("inner_radius", cell.innerRadius);
  io("outer_radius", cell.outerRadius);
  io("wall_radius", cell.wallRadius);
  io("wall_spacing", cell.wallSpacing);
  io("height", cell.height);
  io("omega", cell.omega);
  io("small", cell.small);
  io("large", cell.large);
  io("small_radius", cell.smallRadius);
  io("large_radius", cell.largeRadius);
  io("volume_fraction", cell.volumeFraction);
  io("diameter", cell.diameter);
}

void fields(auto& io, FlowAveraging& averaging) {
  io("method", averaging.method, aName);
  io.present("settle_rotations", averaging.settleRotations);
  io.present("rotations", averaging.rotations);
  io.present("from_rotation", averaging.fromRotation);
  io.present("to_rotation", averaging.toRotation);
  io.when(averaging.fromRotation.has_value(), "prepared_rotations", averaging.preparedRotations);
  io("snapshots", averaging.snapshots);
  io("confidence", averaging.confidence);
  io.present("line_width", averaging.lineWidth);
}

void fields(auto& io, RegionRow& region) {
  io("bins", region.bins);
  io.when(!region.along.empty(), "along", region.along);
  io("height", region.height);
  io("diameter", region.diameter);
  io("disks", region.disks);
  io("x", region.x);
  io("y", region.y);
  io("from_s", region.from);
  io("to_s", region.to);
}

void fields(auto& io, RingPlaces& rings) {
  io("r", rings.r);
  io("r_tilde", rings.rTilde);
  io("width", rings.width);
}

void fields(auto& io, FlowFrame& frame) {
  fields(io, frame.head);
  io.when(!frame.region, "cell", frame.cell);
  io.present("region", frame.region);
  io("averaging", frame.averaging);
  io("effects", frame.effects, aName);
  io("rings", frame.rings);
  io("notes", frame.notes);
}

/// As of a fit: means over packings have the same members, whatever they are of.
void fields(auto& io, HeadNumber& number) {
  const bool mean = number.packings.has_value();
  std::optional<double> chi2;
  std::string reason;
  io("name", number.name, aName);
  io("value", number.value);
  io("unit", number.unit, aUnit);
  io.when(mean, "stderr", number.standardError);
  io.when(mean, "chi2_per_dof", chi2);
  io.when(mean, "reason", reason);
  io.present("packings", number.packings);
}

void fields(auto& io, FitRow& fit) {
  io("name", fit.name, aName);
  io("label", fit.label);
  io("unit", fit.unit, aUnit);
  io("value", fit.value);
  io("stderr", fit.standardError);
  io.when(fit.packings || fit.name != spinInRing1, "chi2_per_dof", fit.chi2PerDof);
  io("reason", fit.reason);
  io("expected", fit.expected);
  io.present("period", fit.period);
  io.present("packings", fit.packings);
  io.present("of_packings", fit.ofPackings);
}

void fields(auto& io, CheckRow& check) {
  io("name", check.name, aName);
  io("label", check.label);
  io("value", check.value);
  io("reference", check.reference);
  io("reference_stderr", check.referenceError);
  io("stderr", check.standardError);
  io.present("note", check.note);
}

void fields(auto& io, RegimeRow& regime) {
  io("name", regime.regime);
  io("reason", regime.reason);
  io("wheel_contacts", regime.wheelContacts);
  io("wheel_slip", regime.wheelSlip);
  io("shear_share", regime.shearShare);
  io("inertial_number", regime.inertialNumber);
  io("blocked_share", regime.blockedFraction);
}

void fields(auto& io, SeriesDrift& row) {
  io("quantity", row.quantity, aName);
  io("verdict", row.drift.verdict);
  io("change", row.drift.change);
  io("half_width", row.drift.half);
  io("excluded", row.drift.excluded);
}

void fields(auto& io, EngineDrift& row) {
  fields(io, static_cast<SeriesDrift&>(row));
  io("engine", row.engine, aName);
  io("packings", row.packings);
  io("drifting", row.drifting);
}

void fields(auto& io, RegimesOfPair& pair) {
  io("a", pair.a, aName);
  io("b", pair.b, aName);
  io("kind", pair.kind);
  io("packings", pair.packings);
  io("differ", pair.differ);
}

void fields(auto& io, Profile& profile) {
  io("method", profile.method, aName);
  io("field", profile.field, aField);
  io("unit", profile.unit, aUnit);
  io("mean", profile.mean);
  io("stderr", profile.standardError);
  io("n_eff", profile.nEff);
  io("dof", profile.dof);
}

void fields(auto& io, Bins& axis) {
  io("low", axis.low);
  io("width", axis.width);
  io("count", axis.count);
}

void fields(auto& io, Distribution& distribution) {
  io("quantity", distribution.quantity, aName);
  io("ring", distribution.ring);
  io("axes", distribution.axes);
  io("density", distribution.density);
  io("stderr", distribution.standardError);
  io("outside", distribution.outside);
  io("samples", distribution.samples);
}

void fields(auto& io, FlowRun& run) {
  io("engine", run.engine, aName);
  io.when(!run.without.empty(), "without", run.without, aName);
  io("packing", run.packing);
  io("status", run.status);
  io("reason", run.reason);
  io.present("realised", run.effective);
  io.present("stats", run.stats);
  io.when(run.finished(), "head", run.head);
  io.present("regime", run.regime);
  io.when(run.finished(), "steadiness", run.steadiness);
  io.when(run.finished(), "profiles", run.profiles);
  io.when(run.finished(), "fits", run.fits);
  io.when(run.finished(), "checks", run.checks);
  io.present("series", run.series);
  io.when(run.series.has_value(), "distributions", run.distributions);
  io.when(run.effective && run.series, "picture", run.picture);
}

void fields(auto& io, CouetteEnsemble& ensemble) {
  io("engine", ensemble.engine, aName);
  io.when(!ensemble.without.empty(), "without", ensemble.without, aName);
  io("packings", ensemble.packings);
  io("profiles", ensemble.profiles);
  io("distributions", ensemble.distributions);
  io("fits", ensemble.fits);
  io("head", ensemble.head);
}

void fields(auto& io, PackingRow& packing) {
  io("index", packing.index);
  io("seed", packing.seed);
  io("hash", packing.hash);
  io("from_cache", packing.fromCache);
}

void fields(auto& io, FlowStudy& study) {
  fields(io, static_cast<FlowFrame&>(study));
  io.present("elapsed_s", study.elapsed);
  io("engines", study.engines);
  io.when(study.head.kind != kindAverage, "packings", study.packings);
  io("runs", study.runs);
}

}  // namespace crossgrain::inline results
