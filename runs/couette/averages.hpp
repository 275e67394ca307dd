#pragma once

#include <vector>

#include "averaging/distributions.hpp"
#include "averaging/layer_spin.hpp"
#include "averaging/profiles.hpp"
#include "averaging/wall_balance.hpp"
#include "results/run.hpp"
#include "runs/couette/series.hpp"

namespace crossgrain::inline runs {

/// All that is averaged over the snapshots of a Couette cell, whether they come from an engine or
/// from a file.
class CouetteAverages {
 public:
  /// Both outlive it. @param scene  see CouetteSeries
  CouetteAverages(const Case& setup, const Scene& scene);

  /// @throws std::invalid_argument for a snapshot that does not fit the scene or those before it
  void add(const Snapshot& snapshot);

  /// Puts them, and what follows from them, into a run: all but what it was run with and its
  /// picture.
  void describe(const Realised& realised, CouetteRun& run) const;

 private:
  const Case& setup_;
  const Scene& scene_;
  ProfileAccumulator profiles_;
  CouetteSeries series_;
  DistributionAccumulator distributions_;
  LayerSpin spin_;
  std::vector<WallBalance> wall_;  ///< one a snapshot that holds the walls and contacts
};

}  // namespace crossgrain::inline runs
