#pragma once

#include <functional>
#include <string>

#include "adapters/engine.hpp"
#include "cases/case.hpp"
#include "cases/packing.hpp"

/// The part of a case that is run and averaged, whatever its kind: all that `compare` and lockstep
/// need of it.
namespace crossgrain::inline cases {

/// Whether there is anything to be averaged: a Couette cell, or an assembly with [average].
bool hasFlow(const Case& setup);

/// When a run is averaged; times are since the hand-over.
struct FlowTimes {
  double settled = 0.0;   ///< start of averaging [s]
  double interval = 0.0;  ///< between snapshots; the first is one interval after `settled` [s]
  int samples = 1;        ///< snapshots

  double end() const { return settled + samples * interval; }  ///< [s]
};
FlowTimes flowTimes(const Case& setup);

/// Duration of a run [s], that of flowTimes() but for rounding.
double flowDuration(const Case& setup);

/// The time that pictures count by: one rotation of the wheel, or a second [s].
double flowUnit(const Case& setup);

/// d: the diameter of the smallest disks [m].
double flowDiameter(const Case& setup);

/// q in J = q m a² of the case's own bodies.
double inertiaFactorOf(const Case& setup);

/// Whether packings are files of the user's own, of which nothing is prepared.
bool packingsAreFiles(const Case& setup);

/// Runs of a start with closed forms: where they differ, nothing is judged.
inline constexpr int closedFormRuns = 2;

/// Whether its endpoints have expected values by closed forms, on which one start is enough.
bool hasClosedForms(const Case& setup);

/// Number of packings that a campaign begins with; each file is one, whatever the case would make.
int flowPackings(const Case& setup);

/// The scene with that packing at t = 0.
template <int D = 2>
SceneOf<D> flowScene(const Case& setup, const Packing& packing, double dt);

/// Disks of the case at any places: a scene to query engines about, not to be run.
template <int D = 2>
SceneOf<D> unplacedScene(const Case& setup, double dt);

/// A packing from the user's file, kept from an earlier command, or made anew.
/// @param engine  the in-house one  @param progress  called with the fraction done, 0 … 1
/// @throws UnsupportedScene, EngineFailure, BadInput
Packing flowPacking(const Case& setup, int index, double dt, Engine& engine,
                    const std::function<void(double)>& progress);

/// Fingerprint of a packing before it is made, and whether it needs no preparation.
struct ExpectedPacking {
  std::string hash;
  bool there = false;
};
ExpectedPacking expectedPacking(const Case& setup, int index, double dt);

/// Refuses what flowPacking() refuses of the first `count` packings, without an engine: of
/// those that have to be prepared, the start of the first one's preparation. @throws BadInput
void checkPackings(const Case& setup, int count, double dt);

/// The last time up to t at which a scene can begin anew [s]: swinging walls begin in the middle,
/// so that only whole periods will do.
double flowRestart(const Case& setup, double t);

/// A run's state as a packing to start from, all springs relaxed.
/// @param from  the packing that the run began with
template <int D>
Packing packingAt(const Packing& from, const SceneOf<D>& scene, const SnapshotOf<D>& now);

}  // namespace crossgrain::inline cases
