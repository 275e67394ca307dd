#pragma once

#include <vector>

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"
#include "averaging/distributions.hpp"
#include "averaging/layer_spin.hpp"
#include "averaging/wall_balance.hpp"
#include "cases/case.hpp"
#include "results/run.hpp"

namespace crossgrain::inline studies {

/// Averages of a Couette cell beside its profiles: what wheel and ring feel and how the
/// wheel drives the disks, distributions, spins layer by layer, and what follows from them.
class CellAverages {
 public:
  /// Both outlive it. The scene has the cell's two bodies.
  CellAverages(const Case& setup, const Scene& scene);

  /// Its numbers go to series.
  void add(const Snapshot& snapshot, RunSeries& series);

  /// All of a run that has its profiles and series.
  void describe(const EffectiveParameters& effective, FlowRun& run) const;

 private:
  const Case& setup_;
  const Scene& scene_;
  DistributionAccumulator distributions_;
  LayerSpin spin_;
  std::vector<WallBalance> wall_;  ///< one a snapshot that holds the walls and contacts
};

}  // namespace crossgrain::inline studies
