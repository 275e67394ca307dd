#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "adapters/engine_entry.hpp"
#include "results/conformance.hpp"
#include "runs/conformance/check_list.hpp"

namespace crossgrain::conformance {

struct Examination {
  std::vector<ConformanceRow> rows;
  std::vector<std::string> declared;           ///< declaredBy()
  std::set<std::string> examined;              ///< of that
  std::map<std::string, std::string> refused;  ///< of the rest, why it could not be asked for
};

/// Runs checks on one engine through its real worker, one row each. A worker that broke down is
/// started again for the next check; after three of them the rest is not tried.
/// @param scratch   folder for workers
/// @param progress  told the check that is run, and the fraction done
/// @throws EngineFailure if it cannot be started at all; BadInput if it is not installed;
///         Interrupted
Examination examine(const EngineEntry& entry, const std::vector<Check>& checks,
                    const std::filesystem::path& scratch,
                    const std::function<void(const std::string&, double)>& progress);

}  // namespace crossgrain::conformance
