#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"
#include "averaging/coordinates.hpp"
#include "averaging/profiles.hpp"
#include "cases/case.hpp"
#include "results/run.hpp"
#include "studies/flow/cell_averages.hpp"

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

  /// The numbers that endpoints are made of, of the run without part k of n of its snapshots:
  /// means, series and the coordination. Absent where there are too few snapshots for so many
  /// parts.
  virtual std::optional<FlowRun> without(std::size_t k, std::size_t n) const = 0;
};

/// Adds the numbers that any scene has to series: the snapshot's time, kinetic energy, what
/// contacts show and the engine's ledger, where it keeps one.
template <int D>
void addGlobalNumbers(RunSeries& rows, const SceneOf<D>& scene, const SnapshotOf<D>& now);

/// Averages of the snapshots of a flow, whether they come from an engine or from a file:
/// profiles over the bins of its region; series of the whole scene, and of the region, disks and
/// walls that endpoints ask for (cases/case.hpp); of a Couette cell those of cell_averages.hpp
/// instead. Along a periodic direction nothing has a centre of mass.
template <int D>
class FlowAverages : public RunAverages {
 public:
  /// Both outlive it.
  FlowAverages(const Case& setup, const SceneOf<D>& scene);

  /// @throws std::invalid_argument for a snapshot that does not fit the scene or those before it
  void add(const SnapshotOf<D>& snapshot);
  /// The scene has other disks from now on (SnapshotSource::disksChanged). Not of a cell.
  void changeDisks() { profiles_.changeDisks(scene_); }

  void describe(const EffectiveParameters& effective, FlowRun& run) const override;
  std::size_t snapshots() const override { return profiles_.snapshots(); }
  std::optional<FlowRun> without(std::size_t k, std::size_t n) const override;

 private:
  void addMoments(const SnapshotOf<D>& now);
  void addWalls(const SnapshotOf<D>& now);
  void addDisks(const SnapshotOf<D>& now);
  void addWallForces(const SnapshotOf<D>& now);
  void addFlanks(const SnapshotOf<D>& now);
  std::vector<HeadNumber> headOfRegion(const EffectiveParameters& effective) const;

  const Case& setup_;
  const SceneOf<D>& scene_;
  std::shared_ptr<const typename ProfileAccumulatorOf<D>::Coordinates> bins_;
  ProfileAccumulatorOf<D> profiles_;
  RunSeries series_;
  std::optional<CellAverages> cell_;
};

}  // namespace crossgrain::inline studies
