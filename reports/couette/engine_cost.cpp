#include "reports/couette/engine_cost.hpp"

#include "reports/common/numbers.hpp"

namespace crossgrain::reports {

namespace {

void addTo(std::optional<double>& sum, std::optional<double> value) {
  if (value) sum = sum.value_or(0.0) + *value;
}

}  // namespace

std::optional<double> EngineCost::cpuPerSecond() const {
  return quotient(cpu, simulated);
}

EngineCost costOf(const EngineRuns& engine) {
  EngineCost cost;
  for (const CouetteRun* run : engine.finished) {
    if (!run->stats) continue;
    const auto steps = static_cast<double>(run->stats->steps);
    addTo(cost.steps, steps);
    addTo(cost.wall, finite(run->stats->wallSeconds));
    addTo(cost.cpu, finite(run->stats->cpuSeconds));
    if (run->realised) addTo(cost.simulated, finite(steps * run->realised->dt));
  }
  return cost;
}

std::optional<double> quotient(std::optional<double> a, std::optional<double> b) {
  if (!a || !b || *b == 0.0) return std::nullopt;
  return *a / *b;
}

}  // namespace crossgrain::reports
