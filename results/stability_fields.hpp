#pragma once

#include "results/engine_fields.hpp"
#include "results/json_fields.hpp"
#include "results/scene_picture_fields.hpp"
#include "results/stability.hpp"

namespace crossgrain::inline results {

void fields(auto& io, MeasureCurve& curve) {
  io("t_s", curve.time);
  io("value", curve.value);
}

/// Kept by itself as soon as it is there.
void fields(auto& io, StabilityRun& run) {
  io("engine", run.engine, aName);
  io("case", run.name, aName);
  io("variant", run.variant);
  io("status", run.status);
  io("verdict", run.verdict);
  io("measure", run.measure, aName);
  io("value", run.value);
  io("limit", run.limit);
  io("degraded_limit", run.degradedLimit);
  io("unit", run.unit, aUnit);
  io("step", run.step);
  io("time_s", run.time);
  io.present("worst_time_s", run.worstTime);
  io("reason", run.reason);
  io("curve", run.curve);
  io("picture", run.picture);
  io("realised", run.effective);
  io("stats", run.stats);
}

}  // namespace crossgrain::inline results
