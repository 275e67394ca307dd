#pragma once

#include <optional>

#include "reports/couette/engine_runs.hpp"

namespace crossgrain::reports {

/// Sums over an engine's finished runs, of stepping alone.
struct EngineCost {
  std::optional<double> steps, wall, cpu, simulated;  ///< [-], [s], [s], [s]

  /// CPU time that a second of the scene takes [-].
  std::optional<double> cpuPerSecond() const;
};

EngineCost costOf(const EngineRuns& engine);

/// Absent where one of both is, or b is 0.
std::optional<double> quotient(std::optional<double> a, std::optional<double> b);

}  // namespace crossgrain::reports
