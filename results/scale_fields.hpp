#pragma once

#include "results/json_fields.hpp"
#include "results/scale.hpp"

namespace crossgrain::inline results {

/// Kept by itself as soon as it is there.
void fields(auto& io, ScalePoint& point) {
  io("engine", point.engine, aName);
  io("disks", point.disks);
  io("workers", point.workers);
  io("status", point.status);
  io("reason", point.reason);
  io("steps", point.steps);
  io("step_s", point.seconds);
  io("contacts_per_step", point.contacts);
  io("memory_bytes", point.memory);
  io("precision", point.precision, aName);
  io("dt_s", point.dt);
  io("differs", point.differs);
  io("measured", point.measured);
}

}  // namespace crossgrain::inline results
