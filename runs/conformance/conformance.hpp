#pragma once

#include <optional>
#include <string>

#include "adapters/engine_entry.hpp"
#include "results/conformance.hpp"
#include "runs/common/study.hpp"

namespace crossgrain::inline runs {

/// What is asked of an engine.
struct ConformanceTask {
  EngineEntry entry;
  std::optional<std::string> only;  ///< checks with this in their name
  bool quiet = false;
  std::string commandLine;  ///< for the report
};

/// The suite, lockstep against its mirror and collisions, one after the other, and what is most
/// likely wrong with an engine that lockstep tells from its mirror. Nothing is kept.
/// @throws EngineFailure if it cannot be started; BadInput, Interrupted
ConformanceResults runConformance(const ConformanceTask& task);

/// An engine that broke down failed; a check that failed is a failure of what it declares.
Outcome outcomeOf(const ConformanceResults& results);

}  // namespace crossgrain::inline runs
