#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "adapters/engine_entry.hpp"
#include "cases/case.hpp"
#include "results/couette_numbers.hpp"
#include "results/endpoints.hpp"
#include "runs/lockstep/starts.hpp"

namespace crossgrain::inline runs {

/// Endpoints of whole runs by name, an entry for each start.
using KeptEndpoints = std::map<std::string, Numbers>;

/// Settles and averages from every start as compare does from a packing: endpoints with a margin.
/// @param dt  the case's [s]
/// @throws EngineFailure, UnsupportedScene, BadInput, Interrupted
KeptEndpoints endpointsFrom(const EngineEntry& entry, const Case& setup,
                            const std::vector<FlowState>& starts, double dt,
                            const std::function<void(double)>& progress);

/// What an engine's averages now are against those kept, paired start by start: one look at all of
/// them. @param names  before, now
std::vector<EndpointRow> endpointChanges(const Case& setup, const KeptEndpoints& before,
                                         const KeptEndpoints& now,
                                         const std::pair<std::string, std::string>& names);

}  // namespace crossgrain::inline runs
