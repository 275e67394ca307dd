#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "adapters/engine_entry.hpp"
#include "results/regression.hpp"
#include "runs/common/study.hpp"
#include "runs/regression/baseline.hpp"

namespace crossgrain::inline runs {

/// What one engine does from the same starts and in the same collisions, compared with a baseline.
/// @param engine  started; that of `entry`
/// @param cases   as it is to run them now
/// @param before  that of the baseline's cases
/// @throws UnsupportedScene, BadInput, Interrupted; a failure of the engine is in the row
DiffRow diffEngine(Engine& engine, const EngineEntry& entry, const std::vector<Case>& cases,
                   const Baseline& baseline, const BaselineEngine& before,
                   const std::function<void(double)>& progress);

/// Every engine named, compared with what was kept of it, or else of the first engine that was.
/// @throws UnsupportedScene, BadInput, Interrupted
DiffResults diffAgainst(const std::filesystem::path& file,
                        const std::vector<std::string>& overrides, const RunCommand& command);

/// An engine that failed, then one that differs; nothing measured is no success.
Outcome outcomeOf(const DiffResults& results);

}  // namespace crossgrain::inline runs
