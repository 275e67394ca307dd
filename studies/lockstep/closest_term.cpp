#include "studies/lockstep/closest_term.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "studies/lockstep/rules.hpp"
#include "studies/lockstep/separation.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline studies {

template <int D>
std::optional<RunsFromStartsOf<D>> runsWith(Engine& mirror, const std::vector<SceneOf<D>>& scenes,
                                            const std::vector<AppliedChangeOf<D>>& changes,
                                            const std::vector<double>& times) {
  RunsFromStartsOf<D> runs;
  for (const SceneOf<D>& start : scenes) {
    throwIfInterrupted();
    try {
      const SceneOf<D> scene = withChanges(start, changes);
      std::vector<std::uint64_t> steps;
      for (const double time : times) steps.push_back(stepsUntil(time, scene.dt));
      loadOn(mirror, scene, {});
      runs.push_back(follow<D>(mirror, scene.dt, steps));
    } catch (const Interrupted&) {
      throw;
    } catch (const std::exception&) {
      return std::nullopt;
    }
  }
  return runs;
}

template <int D>
std::vector<double> separationOfAll(const RunsFromStartsOf<D>& one, std::size_t instant,
                                    const RunsFromStartsOf<D>& other, std::size_t otherInstant,
                                    double diameter) {
  std::vector<double> separation;
  for (std::size_t s = 0; s < one.size(); ++s)
    std::ranges::copy(separationVector(one[s][instant], other[s][otherInstant], diameter),
                      std::back_inserter(separation));
  return separation;
}

template <int D>
void TermFramesOf<D>::add(const LockstepWindowOf<D>& window,
                          const std::vector<std::size_t>& reported) {
  firstReported_ = reported.front();
  const auto chosen = [&](const std::vector<LockstepFrameOf<D>>& frames) {
    std::vector<LockstepFrameOf<D>> some(
        frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(firstReported_));
    for (const std::size_t frame : reported) some.push_back(frames[frame]);
    for (LockstepFrameOf<D>& frame : some) frame.contacts.reset();
    return some;
  };
  engine_.push_back(chosen(window.engine));
  other_.push_back(chosen(window.mirror));
}

template <int D>
std::vector<TermInstantOf<D>> TermFramesOf<D>::instants(const std::optional<FirstExceedance>& first,
                                                        double diameter) const {
  constexpr double rounding = 1e-9;  // of a time
  const std::vector<LockstepFrameOf<D>>& frames = other_.front();
  std::size_t when = 0;
  while (when + 1 < frames.size() &&
         !(first && frames[when].time >= (1.0 - rounding) * first->until))
    ++when;
  std::vector<TermInstantOf<D>> found;
  do {
    TermInstantOf<D>& instant = found.emplace_back();
    instant.time = frames[when].time;
    for (const auto& window : other_) instant.unchanged.push_back({window[when]});
    instant.separation = separationOfAll(engine_, when, other_, when, diameter);
  } while (++when <= firstReported_);
  return found;
}

template <int D>
std::optional<NamedTerm> closestTerm(Engine& mirror, const TermSearchOf<D>& search) {
  std::vector<MirrorChangeOf<D>> changes = changesOf(search.scenes.front(), mirror.capabilities());
  changes.insert(changes.end(), search.more.begin(), search.more.end());
  std::vector<double> times;
  for (const TermInstantOf<D>& instant : search.instants) times.push_back(instant.time);
  const SeparationsWith<D> with = [&](const std::vector<AppliedChangeOf<D>>& applied,
                                      double) -> std::optional<Separations> {
    Separations separations;
    for (const TermInstantOf<D>& instant : search.instants)
      separations.push_back(instant.separation);
    if (applied.empty()) return separations;
    const auto moved = runsWith<D>(mirror, search.scenes, applied, times);
    if (!moved) return std::nullopt;
    for (std::size_t k = 0; k < times.size(); ++k) {
      const std::vector<double> response =
          separationOfAll(*moved, k, search.instants[k].unchanged, 0, search.diameter);
      if (response.size() != separations[k].size()) return std::nullopt;
      for (std::size_t c = 0; c < response.size(); ++c) separations[k][c] -= response[c];
    }
    return separations;
  };
  return closestTerm<D>(changes, with, lockstepRounding);
}

template std::optional<RunsFromStartsOf<2>> runsWith(Engine&, const std::vector<SceneOf<2>>&,
                                                     const std::vector<AppliedChangeOf<2>>&,
                                                     const std::vector<double>&);
template std::vector<double> separationOfAll(const RunsFromStartsOf<2>&, std::size_t,
                                             const RunsFromStartsOf<2>&, std::size_t, double);
template class TermFramesOf<2>;
template std::optional<NamedTerm> closestTerm(Engine&, const TermSearchOf<2>&);
template std::optional<RunsFromStartsOf<3>> runsWith(Engine&, const std::vector<SceneOf<3>>&,
                                                     const std::vector<AppliedChangeOf<3>>&,
                                                     const std::vector<double>&);
template std::vector<double> separationOfAll(const RunsFromStartsOf<3>&, std::size_t,
                                             const RunsFromStartsOf<3>&, std::size_t, double);
template class TermFramesOf<3>;
template std::optional<NamedTerm> closestTerm(Engine&, const TermSearchOf<3>&);

}  // namespace crossgrain::inline studies
