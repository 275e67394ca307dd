#pragma once

#include "results/engine_fields.hpp"
#include "results/json_fields.hpp"
#include "results/stability.hpp"

namespace crossgrain::inline results {

void fields(auto& io, ScenePicture& picture) {
  io("radius", picture.radius);
  io("x", picture.x);
  io("y", picture.y);
  io("start_r", picture.startR);
  io("start_phi", picture.startPhi);
  io("wall_x", picture.wallX);
  io("wall_y", picture.wallY);
  io("wall_radius", picture.wallRadius);
  io.present("contact_i", picture.contactI);
  io.present("contact_j", picture.contactJ);
  io.present("contact_force", picture.contactForce);
  io.present("planes", picture.planes);
  io("time_s", picture.time);
  io("rotation", picture.rotation);
}

void fields(auto& io, MeasureCurve& curve) {
  io("t_s", curve.time);
  io("value", curve.value);
}

/// Kept by itself as soon as it is there.
void fields(auto& io, StabilityRun& run) {
  io("engine", run.engine);
  io("case", run.name);
  io("variant", run.variant);
  io("status", run.status);
  io("verdict", run.verdict);
  io("measure", run.measure);
  io("value", run.value);
  io("limit", run.limit);
  io("degraded_limit", run.degradedLimit);
  io("unit", run.unit);
  io("step", run.step);
  io("time_s", run.time);
  io.present("worst_time_s", run.worstTime);
  io("reason", run.reason);
  io("curve", run.curve);
  io("picture", run.picture);
  io("realised", run.realised);
  io("stats", run.stats);
}

}  // namespace crossgrain::inline results
