#include "studies/lockstep/window.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "studies/lockstep/rules.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline studies {
namespace {

template <int D>
LockstepFrameOf<D> frameOf(SnapshotOf<D>&& seen, double since = 0.0) {
  LockstepFrameOf<D> frame;
  frame.time = seen.positionTime - since;
  frame.velocityTime = seen.velocityTime - since;
  frame.position = std::move(seen.position);
  if (seen.spin) frame.spin = std::move(*seen.spin);
  frame.contacts = std::move(seen.contacts);
  frame.contactTime = seen.contactTime - since;
  frame.bodies = std::move(seen.bodies);
  return frame;
}

double timeOf(std::uint64_t steps, double dt) {
  return static_cast<double>(steps) * dt;
}

/// @throws EngineFailure also for what an engine in this process throws, a mirror for one
void takeTo(Engine& engine, std::uint64_t steps, double dt, double since = 0.0) {
  const double wanted = since + timeOf(steps, dt);
  double reached = 0.0;
  try {
    reached = engine.advance(wanted);
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& error) {
    throw EngineFailure(error.what());
  }
  if (std::abs(reached - wanted) > 0.5 * dt)
    throw EngineFailure("stopped at another time than it was asked for");
}

template <int D>
void requireFinite(const LockstepFrameOf<D>& frame) {
  for (const VecOf<D>& place : frame.position)
    if (!place.allFinite()) throw EngineFailure("a disk is at no finite place");
}

}  // namespace

std::uint64_t stepsUntil(double time, double dt) {
  return static_cast<std::uint64_t>(std::max(1ll, std::llround(time / dt)));
}

std::vector<std::uint64_t> stepsUpTo(std::uint64_t last, std::set<std::uint64_t> also) {
  constexpr double perDecade = 12.0;
  also.insert(last);
  for (double step = 1.0; step < static_cast<double>(last); step *= std::pow(10.0, 1.0 / perDecade))
    also.insert(static_cast<std::uint64_t>(std::llround(step)));
  return {also.begin(), also.end()};
}

std::vector<std::uint64_t> lockstepSteps(double dt) {
  std::set<std::uint64_t> reported;
  for (const double time : lockstepTimes) reported.insert(stepsUntil(time, dt));
  return stepsUpTo(stepsUntil(lockstepTimes.back(), dt), reported);
}

std::vector<double> timesOf(const std::vector<std::uint64_t>& steps, double dt) {
  std::vector<double> times;
  for (const std::uint64_t step : steps) times.push_back(timeOf(step, dt));
  return times;
}

std::size_t frameAt(const std::vector<std::uint64_t>& steps, double dt, double time) {
  const auto distance = [&](std::uint64_t step) { return std::abs(timeOf(step, dt) - time); };
  const auto found = std::ranges::min_element(steps, {}, distance);
  return static_cast<std::size_t>(found - steps.begin());
}

template <int D>
void unwrap(std::vector<VecOf<D>>& places, const std::vector<VecOf<D>>& others,
            const std::optional<BoxOf<D>>& box) {
  for (std::size_t i = 0; box && i < std::min(places.size(), others.size()); ++i)
    places[i] = others[i] + box->nearest(places[i] - others[i]);
}
template void unwrap<2>(std::vector<Vec2>&, const std::vector<Vec2>&,
                        const std::optional<BoxOf<2>>&);
template void unwrap<3>(std::vector<Vec3>&, const std::vector<Vec3>&,
                        const std::optional<BoxOf<3>>&);

template <int D>
LockstepWindowOf<D> followBoth(Engine& engine, Engine& mirror, double dt,
                               const std::vector<std::uint64_t>& steps, bool contacts, double since,
                               const std::optional<BoxOf<D>>& box) {
  LockstepWindowOf<D> window;
  for (const std::uint64_t step : steps) {
    throwIfInterrupted();
    takeTo(engine, step, dt, since);
    auto theirs = snapshotOf<D>(engine, contacts ? ContactReport::instant : ContactReport::none);
    window.engine.push_back(frameOf<D>(std::move(theirs), since));
    const auto stepOfForces =
        static_cast<std::uint64_t>(std::llround(window.engine.back().contactTime / dt));
    requireFinite(window.engine.back());

    // Forces of a step before are compared with those that the mirror had then.
    std::optional<ContactsOf<D>> before;
    if (contacts && stepOfForces < step) {
      byMirror([&] { takeTo(mirror, stepOfForces, dt); });
      before = snapshotOf<D>(mirror, ContactReport::instant).contacts;
    }
    byMirror([&] { takeTo(mirror, step, dt); });
    window.mirror.push_back(frameOf<D>(snapshotOf<D>(mirror, ContactReport::instant)));
    if (before) window.mirror.back().contacts = std::move(before);
    unwrap<D>(window.engine.back().position, window.mirror.back().position, box);
  }
  return window;
}
template LockstepWindowOf<2> followBoth<2>(Engine&, Engine&, double,
                                           const std::vector<std::uint64_t>&, bool, double,
                                           const std::optional<BoxOf<2>>&);
template LockstepWindowOf<3> followBoth<3>(Engine&, Engine&, double,
                                           const std::vector<std::uint64_t>&, bool, double,
                                           const std::optional<BoxOf<3>>&);

template <int D>
std::vector<LockstepFrameOf<D>> follow(
    Engine& engine, double dt, const std::vector<std::uint64_t>& steps, ContactReport contacts,
    const std::function<void(std::uint64_t, std::uint64_t)>& before) {
  std::vector<LockstepFrameOf<D>> frames;
  std::uint64_t done = 0;
  for (const std::uint64_t step : steps) {
    throwIfInterrupted();
    if (before) before(std::exchange(done, step), step);
    takeTo(engine, step, dt);
    frames.push_back(frameOf<D>(snapshotOf<D>(engine, contacts)));
    requireFinite(frames.back());
  }
  return frames;
}
template std::vector<LockstepFrameOf<2>> follow<2>(
    Engine&, double, const std::vector<std::uint64_t>&, ContactReport,
    const std::function<void(std::uint64_t, std::uint64_t)>&);
template std::vector<LockstepFrameOf<3>> follow<3>(
    Engine&, double, const std::vector<std::uint64_t>&, ContactReport,
    const std::function<void(std::uint64_t, std::uint64_t)>&);

}  // namespace crossgrain::inline studies
