#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "adapters/engine.hpp"

namespace crossgrain::inline studies {

/// State of an engine that is compared after so many steps.
template <int D>
struct LockstepFrameOf {
  double time = 0.0;               ///< of the positions, since the start [s]
  double velocityTime = 0.0;       ///< since the start [s]
  std::vector<VecOf<D>> position;  ///< of the disks [m]
  std::vector<SpinOf<D>> spin;     ///< [rad/s]; empty: nothing spins
  std::optional<ContactsOf<D>> contacts;
  double contactTime = 0.0;  ///< of the contacts and of forces on walls, since the start [s]
  std::vector<BodySnapshotOf<D>> bodies = {};
};
using LockstepFrame = LockstepFrameOf<2>;

/// An engine and its mirror over one window, at the same steps; contacts are of the same instants.
template <int D>
struct LockstepWindowOf {
  std::vector<LockstepFrameOf<D>> engine, mirror;
};
using LockstepWindow = LockstepWindowOf<2>;

/// The number of steps nearest to that time, one at least.
std::uint64_t stepsUntil(double time, double dt);

/// The first, about twelve in each tenfold, the last, and what else is given.
std::vector<std::uint64_t> stepsUpTo(std::uint64_t last, std::set<std::uint64_t> also = {});

/// The steps after which both are compared: the first, about twelve in each tenfold, and those
/// nearest to lockstepTimes.
std::vector<std::uint64_t> lockstepSteps(double dt);

/// Of those steps, since the start [s].
std::vector<double> timesOf(const std::vector<std::uint64_t>& steps, double dt);

/// Which of lockstepSteps() is nearest to that time.
std::size_t frameAt(const std::vector<std::uint64_t>& steps, double dt, double time);

/// Engines leave paths across a periodic border whole or wrap them: places become those of the
/// images nearest to others.
template <int D>
void unwrap(std::vector<VecOf<D>>& places, const std::vector<VecOf<D>>& others,
            const std::optional<BoxOf<D>>& box);

/// Frames of the in-house engine in place of another. Where it fails, for one under a law that
/// drives disks through walls, this is no failure of an engine.
/// @throws UnsupportedScene  for what it fails with
template <class Work>
auto byMirror(const Work& work) {
  try {
    return work();
  } catch (const EngineFailure& failure) {
    throw UnsupportedScene(
        std::string("the in-house engine does not come through with its law either: ") +
        failure.what());
  }
}

/// Takes both through the window; the mirror is loaded and not yet advanced.
/// @param contacts  whether the engine reports the forces of an instant
/// @param since     the engine's time at the beginning [s]: it may be in the middle of a run, and
///                  up to a step ahead
/// @param box       the scene's: the engine's places become those of the images nearest to the
///                  mirror's
/// @throws EngineFailure of the engine, UnsupportedScene where the mirror fails, Interrupted
template <int D = 2>
LockstepWindowOf<D> followBoth(Engine& engine, Engine& mirror, double dt,
                               const std::vector<std::uint64_t>& steps, bool contacts,
                               double since = 0.0, const std::optional<BoxOf<D>>& box = {});

/// One alone, loaded and not yet advanced, up to the last of the steps.
/// @param before  called before each frame, with the steps done and those of the frame; may throw
/// @throws EngineFailure, Interrupted
template <int D = 2>
std::vector<LockstepFrameOf<D>> follow(
    Engine& engine, double dt, const std::vector<std::uint64_t>& steps,
    ContactReport contacts = ContactReport::none,
    const std::function<void(std::uint64_t, std::uint64_t)>& before = {});

}  // namespace crossgrain::inline studies
