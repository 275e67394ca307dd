#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adapters/engine.hpp"
#include "results/head.hpp"
#include "runs/baseline/kept_collisions.hpp"
#include "runs/baseline/kept_endpoints.hpp"
#include "runs/lockstep/account.hpp"
#include "runs/lockstep/starts.hpp"
#include "runs/lockstep/window.hpp"

namespace crossgrain::inline runs {

/// What an engine did from one start.
struct BaselineWindow {
  std::vector<LockstepFrame> frames;  ///< at lockstepSteps() of its own step
  /// What changes of the yardstick did to it, at the frames nearest to lockstepTimes: measured in
  /// the engine itself, so that no mirror is needed, and when it was kept, so that nothing that a
  /// later version does bends the measure.
  Responses responses;
};

/// What one engine did, and as what it presented itself.
struct BaselineEngine {
  std::string name, version;
  Capabilities can;
  std::optional<Realised> realised;     ///< of the first start; absent of cases of collisions
  std::vector<BaselineWindow> windows;  ///< by start
  std::vector<KeptCollisions> collisions;
  KeptEndpoints endpoints;  ///< by start; empty: not asked for
};

/// What some engines did on one case, with all that is needed to do the same again: nothing outside
/// of it is read.
struct Baseline {
  std::string version;            ///< of the crossgrain that kept it
  CaseHead setup;                 ///< its text is the merged case, with all variants
  std::vector<FlowState> starts;  ///< springs relaxed; none of cases of collisions
  std::vector<BaselineEngine> engines;
};

}  // namespace crossgrain::inline runs
