#pragma once

#include <string>
#include <vector>

#include "adapters/engine.hpp"
#include "adapters/engine_entry.hpp"
#include "cases/case.hpp"
#include "cases/packing.hpp"
#include "results/lockstep_findings.hpp"
#include "studies/core/executor.hpp"
#include "studies/core/run_store.hpp"

namespace crossgrain::inline studies {

/// An engine that is to be held against its mirror.
struct LockstepEngine {
  EngineEntry entry;
  std::string version;  ///< empty: it did not answer
};

/// The states that all start from, and what became of each engine.
struct LockstepPlan {
  std::vector<Packing> packings;  ///< that the flow starts from
  double dt = 0.0;                ///< the case's [s]
  std::size_t starts = 0;
  int jobs = 1;  ///< packings and engines side by side
};

/// Why an engine has no mirror in this scene; empty: it has one.
std::string noMirrorReason(const EngineEntry& entry, const Capabilities& can, const Case& setup);

/// Holds each engine against its mirror. Everything finished is kept in the store at once.
/// @throws BadInput, OutputError, Interrupted
LockstepFindings holdAgainstMirrors(const std::vector<LockstepEngine>& engines, const Case& setup,
                                    const LockstepPlan& plan, const RunStore& store,
                                    Progress& progress);

}  // namespace crossgrain::inline studies
