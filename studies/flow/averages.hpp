#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"
#include "averaging/coordinates.hpp"
#include "averaging/distributions.hpp"
#include "averaging/layer_spin.hpp"
#include "averaging/profiles.hpp"
#include "averaging/wall_balance.hpp"
#include "cases/case.hpp"
#include "results/run.hpp"

namespace crossgrain::inline studies {

/// The bins that a case averages over: its rings, or what [average] says.
/// @param box  the scene's; without it bins are the same but for what lies beyond periodic sides
template <int D>
std::shared_ptr<const typename ProfileAccumulatorOf<D>::Coordinates> coordinatesOf(
    const Case& setup, const std::optional<BoxOf<D>>& box = {});

/// Those of a case of either dimension: how many there are, and how large.
std::shared_ptr<const BinSet> binsOf(const Case& setup);

/// All that is averaged over the snapshots of one run.
class RunAverages {
 public:
  virtual ~RunAverages() = default;

  /// Puts them, and what follows from them, into a run: all but what it was run with and its
  /// picture.
  virtual void describe(const EffectiveParameters& effective, FlowRun& run) const = 0;

  virtual std::size_t snapshots() const = 0;

  /// What endpoints are made of, of the run without part k of n of its snapshots: means, series and
  /// the coordination. Absent where there are too few snapshots for so many parts.
  virtual std::optional<FlowRun> without(std::size_t k, std::size_t n) const = 0;
};

/// The same of a scene of that dimension, snapshot by snapshot.
template <int D>
class FlowAveragesOf : public RunAverages {
 public:
  /// @throws std::invalid_argument for a snapshot that does not fit the scene or those before it
  virtual void add(const SnapshotOf<D>& snapshot) = 0;
  /// The scene has other disks from now on (SnapshotSource::disksChanged). Not of a cell.
  virtual void changeDisks() {}
};
using FlowAverages = FlowAveragesOf<2>;

/// Those of the case's kind; in space of an assembly with [average]. Both arguments outlive them.
template <int D>
std::unique_ptr<FlowAveragesOf<D>> flowAverages(const Case& setup, const SceneOf<D>& scene);

/// Adds the numbers that any scene has to series: the snapshot's time, kinetic energy, what
/// contacts show and the engine's ledger, where it keeps one.
template <int D>
void addGlobalNumbers(RunSeries& rows, const SceneOf<D>& scene, const SnapshotOf<D>& now);

/// Profiles and series, which all averages have.
template <int D>
class ProfileAveragesOf : public FlowAveragesOf<D> {
 public:
  std::size_t snapshots() const override { return profiles_.snapshots(); }
  std::optional<FlowRun> without(std::size_t k, std::size_t n) const override;

 protected:
  explicit ProfileAveragesOf(ProfileAccumulatorOf<D> profiles) : profiles_(std::move(profiles)) {}

  ProfileAccumulatorOf<D> profiles_;
  RunSeries series_;
};

/// All that is averaged over the snapshots of a Couette cell, whether they come from an engine or
/// from a file.
class CouetteAverages : public ProfileAveragesOf<2> {
 public:
  /// Both outlive it. The scene has the Couette cell's two bodies.
  CouetteAverages(const Case& setup, const Scene& scene);

  void add(const Snapshot& snapshot) override;
  void describe(const EffectiveParameters& effective, FlowRun& run) const override;

 private:
  void addSeries(const Snapshot& now);

  const Case& setup_;
  const Scene& scene_;
  DistributionAccumulator distributions_;
  LayerSpin spin_;
  std::vector<WallBalance> wall_;  ///< one a snapshot that holds the walls and contacts
};

/// What is averaged of an assembly: profiles over the bins of its region; and series of the region,
/// of the whole scene and of those disks that endpoints ask for (cases/case.hpp). Along a periodic
/// direction nothing has a centre of mass.
template <int D>
class RegionAverages : public ProfileAveragesOf<D> {
 public:
  /// Both outlive it.
  RegionAverages(const Case& setup, const SceneOf<D>& scene);

  void add(const SnapshotOf<D>& snapshot) override;
  void changeDisks() override { profiles_.changeDisks(scene_); }
  void describe(const EffectiveParameters& effective, FlowRun& run) const override;

 private:
  void addMoments(const SnapshotOf<D>& now);
  void addWalls(const SnapshotOf<D>& now);
  void addDisks(const SnapshotOf<D>& now);
  void addWallForces(const SnapshotOf<D>& now);
  void addFlanks(const SnapshotOf<D>& now);

  using ProfileAveragesOf<D>::profiles_;
  using ProfileAveragesOf<D>::series_;
  const Case& setup_;
  const SceneOf<D>& scene_;
  std::shared_ptr<const typename ProfileAccumulatorOf<D>::Coordinates> bins_;
};

}  // namespace crossgrain::inline studies
