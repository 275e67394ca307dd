#pragma once

#include <memory>

#include "adapters/snapshot.hpp"
#include "averaging/coordinates.hpp"
#include "cases/case.hpp"
#include "results/run.hpp"

namespace crossgrain::inline studies {

/// The bins that a case averages over: its rings, or what [average] says.
std::shared_ptr<const Coordinates> binsOf(const Case& setup);

/// All that is averaged over the snapshots of one run.
class FlowAverages {
 public:
  virtual ~FlowAverages() = default;

  /// @throws std::invalid_argument for a snapshot that does not fit the scene or those before it
  virtual void add(const Snapshot& snapshot) = 0;

  /// Puts them, and what follows from them, into a run: all but what it was run with and its
  /// picture.
  virtual void describe(const EffectiveParameters& effective, FlowRun& run) const = 0;
};

/// Those of the case's kind. Both arguments outlive them.
std::unique_ptr<FlowAverages> flowAverages(const Case& setup, const Scene& scene);

}  // namespace crossgrain::inline studies
