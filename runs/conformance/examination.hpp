#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "adapters/engine_entry.hpp"
#include "results/conformance.hpp"
#include "runs/conformance/check_list.hpp"

namespace crossgrain::conformance {

/// Runs checks on one engine through its real worker, one row each. A worker that broke down is
/// started again for the next check; after three of them the rest is not tried.
/// @param scratch   folder for workers
/// @param progress  told the check that is run, and the fraction done
/// @throws EngineFailure if it cannot be started at all; BadInput if it is not installed;
///         Interrupted
std::vector<ConformanceRow> examine(
    const EngineEntry& entry, const std::vector<Check>& checks,
    const std::filesystem::path& scratch,
    const std::function<void(const std::string&, double)>& progress);

}  // namespace crossgrain::conformance
