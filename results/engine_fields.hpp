#pragma once

#include "adapters/worker/json.hpp"
#include "results/engine_row.hpp"
#include "results/json_fields.hpp"

namespace crossgrain::inline results {

void fields(auto& io, Stats& stats) {
  io("steps", stats.steps);
  io("contact_evaluations", stats.contactEvaluations);
  io("wall_s", stats.wallSeconds);
  io("cpu_s", stats.cpuSeconds);
  io("counters", stats.counters);
}

}  // namespace crossgrain::inline results
