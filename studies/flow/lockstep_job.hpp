#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "results/compare.hpp"
#include "results/endpoints.hpp"
#include "studies/core/study.hpp"
#include "studies/flow/campaign.hpp"
#include "studies/lockstep/identify.hpp"

namespace crossgrain::inline studies {

/// Engines of a campaign, whose packings are there, against their mirrors.
/// @param takesPart  which of those that can run the case
/// @param budget     what is not finished so long after the campaign began is not measured [s]
LockstepFindings lockstepOf(Campaign& campaign, const Case& setup, const RunCommand& command,
                            std::size_t starts,
                            const std::function<bool(const EngineEntry&)>& takesPart,
                            double budget = std::numeric_limits<double>::infinity());

/// Late windows in a run of each of these engines of its own, on the packing after the one that
/// spot checks average, where there is one; they stay in the store.
/// @param engines  indices into Campaign::engines()
std::vector<LateWindows> lateWindowsOf(Campaign& campaign, const Case& setup,
                                       const RunCommand& command,
                                       const std::vector<std::size_t>& engines);

struct LockstepOptions {
  std::optional<double> starts;
  bool strict = false;
};

/// Whether engines are the laws that they declare, step by step from equal states.
extern const Study<LockstepOptions, LockstepResults> lockstepStudy;

/// Finds out what the one engine named does, on the case's first packing; keeps nothing.
/// @throws BadInput, UnsupportedScene, EngineFailure, Interrupted
Identification runIdentify(const Case& setup, const RunCommand& command);

}  // namespace crossgrain::inline studies
