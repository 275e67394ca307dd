#pragma once

#include <functional>
#include <string>

#include "results/lockstep.hpp"
#include "runs/common/study.hpp"
#include "runs/couette/campaign.hpp"
#include "runs/lockstep/identify.hpp"

namespace crossgrain::inline runs {

/// Engines of a campaign, whose packings are there, against their mirrors.
/// @param takesPart  which of those that can run the case
LockstepFindings lockstepOf(Campaign& campaign, const Case& setup, const RunCommand& command,
                            std::size_t starts,
                            const std::function<bool(const EngineEntry&)>& takesPart);

struct LockstepOptions {
  std::optional<double> starts;
  bool strict = false;
};

/// Whether engines are the laws that they declare, step by step from equal states.
extern const Study<LockstepOptions, LockstepResults> lockstepStudy;

/// Finds out what the one engine named does, on the case's first packing; keeps nothing.
/// @throws BadInput, UnsupportedScene, EngineFailure, Interrupted
Identification runIdentify(const Case& setup, const RunCommand& command);

}  // namespace crossgrain::inline runs
