#pragma once

#include "results/cost.hpp"
#include "results/cost_averages.hpp"
#include "results/json_fields.hpp"

/// Also for what is kept while a study of cost is under way.
namespace crossgrain::inline results {

void fields(auto& io, CostPoint& point) {
  io("engine", point.engine, aName);
  io("knob", point.knob, aName);
  io("setting", point.setting);
  io("fragment", point.fragment);
  io("error_kind", point.kind);
  io("measure", point.measure, aName);
  io("dt_s", point.dt);
  io("steps_per_contact", point.stepsPerContact);
  io("error", point.error);
  io("statistical", point.statistical);
  io("systematic", point.systematic);
  io("reference_error", point.referenceError);
  io("low", point.low);
  io("high", point.high);
  io("equivalent", point.equivalent);
  io("bound", point.bound);
  io("wall_s", point.wallSeconds);
  io("cpu_s", point.cpuSeconds);
  io("steps", point.steps);
  io("contact_evaluations", point.contactEvaluations);
  io("status", point.status);
  io("reason", point.reason);
}

void fields(auto& io, LeftOut& left) {
  io("point", left.point);
  io("why", left.why);
}

void fields(auto& io, OrderFit& fit) {
  io("engine", fit.engine, aName);
  io("error_kind", fit.kind);
  io("measure", fit.measure, aName);
  io("integrator", fit.integrator);
  io("order", fit.order);
  io("stderr", fit.standardError);
  io("half_width", fit.halfWidth);
  io("amplitude", fit.amplitude);
  io("dt_low_s", fit.dtLow);
  io("dt_high_s", fit.dtHigh);
  io("used", fit.used);
  io("left_out", fit.leftOut);
  io("theory", fit.theory);
  io("verdict", fit.verdict);
  io("reason", fit.reason);
}

void fields(auto& io, Front& front) {
  io("error_kind", front.kind);
  io("measure", front.measure, aName);
  io("engine", front.engine, aName);
  io("points", front.points);
  io("errors", front.errors);
}

void fields(auto& io, Cheapest& row) {
  io("engine", row.engine, aName);
  io("error_kind", row.kind);
  io("measure", row.measure, aName);
  io("want", row.target);
  io("verdict", row.verdict);
  io("point", row.point);
  io("high", row.high);
  io("length", row.length);
  io("cheaper", row.cheaper);
  io("decides", row.decides);
}

void fields(auto& io, Advice& advice) {
  io("engine", advice.engine, aName);
  io("want", advice.target);
  io("verdict", advice.verdict);
  io("knob", advice.knob, aName);
  io("setting", advice.setting);
  io("fragment", advice.fragment);
  io("kinds", advice.kinds);
  io("wall_s", advice.wallSeconds);
  const auto kind = advice.costKind();
  std::string costKind = kind ? toString(*kind) : "";  // for readers of the file: it follows
  io("cost_kind", costKind);
  io("length", advice.length);
  io("obstacle", advice.obstacle);
  io("decides", advice.decides);
  io("cheapest", advice.cheapest);
}

void fields(auto& io, CostCell& cell) {
  io("engine", cell.engine, aName);
  io("error_kind", cell.kind);
  io("basis", cell.basis);
  io("want", cell.target);
  io("verdict", cell.verdict);
  io("knob", cell.knob, aName);
  io("setting", cell.setting);
  io("wall_s", cell.wallSeconds);
  io("point", cell.point);
  io("model", cell.model);
  io("decides", cell.decides);
}

void fields(auto& io, Separation& at) {
  io("t_s", at.time);
  io("separation", at.value);
}

void fields(auto& io, ChaosStudy& study) {
  io("growth", study.separations);
  io("exponent_per_s", study.growth.exponent);
  io("exponent_stderr", study.growth.standardError);
  io("window_s", study.window.length);
  io("why", study.window.why);
}

void fields(auto& io, AveragedPacking& run) {
  io("dt_s", run.dt);
  io("wall_s", run.wallSeconds);
  io("cpu_s", run.cpuSeconds);
  io("steps", run.steps);
  io("contact_evaluations", run.contactEvaluations);
  io("views", run.samplings);
}

void fields(auto& io, CostReference& reference) {
  io("error_kind", reference.kind);
  io("engine", reference.engine, aName);
  io("setting", reference.setting);
  io("error", reference.error);
  io("note", reference.note);
}

void fields(auto& io, CostModel& model) {
  io("engine", model.engine, aName);
  io("error_kind", model.kind);
  io("measure", model.measure, aName);
  io("error", model.error);
  io("low", model.low);
  io("high", model.high);
}

void fields(auto& io, Startup& startup) {
  io("engine", startup.engine, aName);
  io("start_s", startup.start);
  io("load_s", startup.load);
}

void fields(auto& io, StatisticalFall& fall) {
  io("engine", fall.engine, aName);
  io("measure", fall.measure, aName);
  io("rotations", fall.rotations);
  io("statistical", fall.statistical);
}

void fields(auto& io, CostResponse& response) {
  io("measure", response.measure, aName);
  io("constant", response.constant, aName);
  io("change", response.change);
  io("response", response.response);
  io("bound", response.bound);
}

void fields(auto& io, CostAverages& averages) {
  io("falls", averages.falls);
  io("responses", averages.responses);
}

}  // namespace crossgrain::inline results
