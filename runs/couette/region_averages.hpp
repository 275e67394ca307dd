#pragma once

#include "averaging/profiles.hpp"
#include "results/run.hpp"
#include "runs/couette/flow_averages.hpp"

namespace crossgrain::inline runs {

/// The numbers of a region at each snapshot, of the whole scene, and of those disks that endpoints
/// ask for (cases/case.hpp).
class RegionSeries {
 public:
  /// Both outlive it.
  RegionSeries(const Case& setup, const Scene& scene);

  void add(const Snapshot& now);

  /// By name; "t_s" are the snapshots' times.
  const RunSeries& rows() const { return rows_; }

 private:
  void addMoments(const Snapshot& now);
  void addDisks(const Snapshot& now);

  const Average& average_;
  const Region& region_;
  const Scene& scene_;
  std::shared_ptr<const Coordinates> bins_;
  RunSeries rows_;
};

/// What is averaged of an assembly: profiles over the bins of its region, and series.
class RegionAverages : public FlowAverages {
 public:
  /// Both outlive it.
  RegionAverages(const Case& setup, const Scene& scene);

  void add(const Snapshot& snapshot) override;
  void describe(const Realised& realised, CouetteRun& run) const override;

 private:
  const Case& setup_;
  ProfileAccumulator profiles_;
  RegionSeries series_;
};

}  // namespace crossgrain::inline runs
