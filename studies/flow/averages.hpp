#pragma once

#include <vector>

#include "averaging/distributions.hpp"
#include "averaging/layer_spin.hpp"
#include "averaging/profiles.hpp"
#include "averaging/wall_balance.hpp"
#include "results/run.hpp"
#include "studies/flow/flow_averages.hpp"
#include "studies/flow/series.hpp"

namespace crossgrain::inline studies {

/// All that is averaged over the snapshots of a Couette cell, whether they come from an engine or
/// from a file.
class CouetteAverages : public FlowAverages {
 public:
  /// Both outlive it. @param scene  see CouetteSeries
  CouetteAverages(const Case& setup, const Scene& scene);

  void add(const Snapshot& snapshot) override;
  void describe(const EffectiveParameters& effective, FlowRun& run) const override;

 private:
  const Case& setup_;
  const Scene& scene_;
  ProfileAccumulator profiles_;
  CouetteSeries series_;
  DistributionAccumulator distributions_;
  LayerSpin spin_;
  std::vector<WallBalance> wall_;  ///< one a snapshot that holds the walls and contacts
};

}  // namespace crossgrain::inline studies
