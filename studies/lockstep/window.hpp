#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <vector>

#include "adapters/engine.hpp"

namespace crossgrain::inline studies {

/// What is compared of an engine after so many steps.
struct LockstepFrame {
  double time = 0.0;           ///< of the positions, since the start [s]
  double velocityTime = 0.0;   ///< since the start [s]
  std::vector<Vec2> position;  ///< of the disks [m]
  std::vector<double> spin;    ///< [rad/s]; empty: nothing spins
  std::optional<Contacts> contacts;
  double contactTime = 0.0;  ///< of the contacts and of forces on walls, since the start [s]
  std::vector<BodySnapshot> bodies = {};
};

/// An engine and its mirror over one window, at the same steps; contacts are of the same instants.
struct LockstepWindow {
  std::vector<LockstepFrame> engine, mirror;
};

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

/// Takes both through the window; the mirror is loaded and not yet advanced.
/// @param contacts  whether the engine reports the forces of an instant
/// @param since     the engine's time at the beginning [s]: it may be in the middle of a run, and
///                  up to a step ahead
/// @throws EngineFailure, Interrupted
LockstepWindow followBoth(Engine& engine, Engine& mirror, double dt,
                          const std::vector<std::uint64_t>& steps, bool contacts,
                          double since = 0.0);

/// One alone, loaded and not yet advanced, up to the last of the steps.
/// @param before  called before each frame, with the steps done and those of the frame; may throw
/// @throws EngineFailure, Interrupted
std::vector<LockstepFrame> follow(
    Engine& engine, double dt, const std::vector<std::uint64_t>& steps,
    ContactReport contacts = ContactReport::none,
    const std::function<void(std::uint64_t, std::uint64_t)>& before = {});

}  // namespace crossgrain::inline studies
