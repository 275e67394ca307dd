#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "adapters/engine.hpp"
#include "results/lockstep_findings.hpp"
#include "studies/causes/closest_law.hpp"
#include "studies/lockstep/window.hpp"

namespace crossgrain::inline studies {

/// Frames of runs at some instants, by start and instant.
template <int D>
using RunsFromStartsOf = std::vector<std::vector<LockstepFrameOf<D>>>;
using RunsFromStarts = RunsFromStartsOf<2>;

/// Runs the mirror from each start with these changes. Absent where it cannot run like that.
/// @param scenes  the mirror's, by start
/// @param times   of the frames, since the start [s]
/// @throws Interrupted
template <int D>
std::optional<RunsFromStartsOf<D>> runsWith(Engine& mirror, const std::vector<SceneOf<D>>& scenes,
                                            const std::vector<AppliedChangeOf<D>>& changes,
                                            const std::vector<double>& times);

/// Separations of all starts at one instant of each, one after the other: separationVector().
template <int D>
std::vector<double> separationOfAll(const RunsFromStartsOf<D>& one, std::size_t instant,
                                    const RunsFromStartsOf<D>& other, std::size_t otherInstant,
                                    double diameter);

/// How far apart two runs from each of some starts are at one instant.
template <int D>
struct TermInstantOf {
  double time = 0.0;               ///< since the start [s]
  RunsFromStartsOf<D> unchanged;   ///< the mirror's runs, by start: one frame each
  std::vector<double> separation;  ///< of all starts
};
using TermInstant = TermInstantOf<2>;

/// Memory of windows for the search: frames without contacts of an engine and of what it is
/// compared with, all up to the first of those reported, and these.
template <int D>
class TermFramesOf {
 public:
  /// @param reported  indices of a window's frames
  void add(const LockstepWindowOf<D>& window, const std::vector<std::size_t>& reported);

  /// From the first that shows what was first seen to the first of those reported, or else that one
  /// alone. The earlier the better: a contact made or broken at another step is no term's doing;
  /// but the first may hold little but what is beside the term. `unchanged` is what the engine is
  /// compared with.
  std::vector<TermInstantOf<D>> instants(const std::optional<FirstExceedance>& first,
                                         double diameter) const;

 private:
  std::size_t firstReported_ = 0;
  RunsFromStartsOf<D> engine_, other_;
};
using TermFrames = TermFramesOf<2>;

/// Differences to be accounted for.
template <int D>
struct TermSearchOf {
  std::vector<SceneOf<D>> scenes;            ///< the mirror's, by start
  std::vector<TermInstantOf<D>> instants;    ///< in order of time
  double diameter = 0.0;                     ///< [m]
  std::vector<MirrorChangeOf<D>> more = {};  ///< to be tried besides changesOf()
};
using TermSearch = TermSearchOf<2>;

/// closestTerm() of all changes of the mirror, from every start. @throws Interrupted
template <int D>
std::optional<NamedTerm> closestTerm(Engine& mirror, const TermSearchOf<D>& search);

}  // namespace crossgrain::inline studies
