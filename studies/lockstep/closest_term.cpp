#include "studies/lockstep/closest_term.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <ranges>
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
  for (SceneOf<D> scene : scenes) {
    throwIfInterrupted();
    try {
      for (const AppliedChangeOf<D>& one : changes) one.change.apply(scene, one.by);
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

namespace {

/// Response to a change of the mirror, from all starts, by instant. Absent where it cannot run like
/// that.
template <int D>
std::optional<std::vector<std::vector<double>>> responsesTo(const AppliedChangeOf<D>& change,
                                                            Engine& mirror,
                                                            const TermSearchOf<D>& search) {
  std::vector<double> times;
  for (const TermInstantOf<D>& instant : search.instants) times.push_back(instant.time);
  const auto moved = runsWith<D>(mirror, search.scenes, {change}, times);
  if (!moved) return std::nullopt;
  std::vector<std::vector<double>> responses;
  for (std::size_t k = 0; k < times.size(); ++k)
    responses.push_back(
        separationOfAll(*moved, k, search.instants[k].unchanged, 0, search.diameter));
  return responses;
}

double norm(const std::vector<double>& vector) {
  return std::sqrt(std::inner_product(vector.begin(), vector.end(), vector.begin(), 0.0));
}

/// A change that may account for what is seen at one of the instants, to first order.
template <int D>
struct Candidate {
  const MirrorChangeOf<D>* change;
  std::size_t instant;
  NamedTerm term;
};

/// A constant changed by as much as the candidate says, and what that leaves in the mirror itself.
/// To first order it is -59 % for a half: each further trial takes the amount in proportion to what
/// the last one did.
template <int D>
NamedTerm tried(const Candidate<D>& candidate, Engine& mirror, const TermSearchOf<D>& search) {
  constexpr int trials = 3;
  const std::vector<double>& separation = search.instants[candidate.instant].separation;
  NamedTerm best{candidate.term.name, candidate.term.amount, 1.0};
  double amount = *candidate.term.amount;
  for (int trial = 0; trial < trials; ++trial) {
    const auto responses = responsesTo<D>({*candidate.change, amount}, mirror, search);
    if (!responses || (*responses)[candidate.instant].size() != separation.size()) break;
    const std::vector<double>& response = (*responses)[candidate.instant];
    std::vector<double> rest = separation;
    for (std::size_t k = 0; k < rest.size(); ++k) rest[k] -= response[k];
    const double left = norm(rest) / norm(separation);
    if (left < best.unexplained) best = {candidate.term.name, amount, left};
    const double moved = norm(response);
    if (!(moved > 0.0)) break;
    amount *= std::inner_product(separation.begin(), separation.end(), response.begin(), 0.0) /
              (moved * moved);
  }
  return best;
}

/// Of one constant, by amounts from a hundredth to the whole of it and then between them, at the
/// last instant. To first order nothing is seen of a constant whose change makes contacts slip that
/// stuck: a rolling spring takes its whole bound then.
template <int D>
NamedTerm triedAtLarge(const MirrorChangeOf<D>& change, Engine& mirror,
                       const TermSearchOf<D>& search) {
  const std::vector<double>& separation = search.instants.back().separation;
  NamedTerm best{change.name, std::nullopt, 1.0};
  const auto attempt = [&](double amount) {
    const auto responses = responsesTo<D>({change, amount}, mirror, search);
    if (!responses || responses->back().size() != separation.size()) return false;
    std::vector<double> rest = separation;
    for (std::size_t k = 0; k < rest.size(); ++k) rest[k] -= responses->back()[k];
    const double left = norm(rest) / norm(separation);
    if (!(left < best.unexplained)) return false;
    best.unexplained = left;
    best.amount = amount;
    return true;
  };
  for (const double size : {0.01, 0.03, 0.1, 0.3, 0.6, 1.0})
    for (const double amount : {-size, size})
      if (amount > -1.0) attempt(amount);
  constexpr double worthRefining = 0.8;
  if (!(best.unexplained < worthRefining)) return best;
  for (double width = 0.5 * std::abs(*best.amount); width > 1e-3 * std::abs(*best.amount);
       width *= 0.5)
    if (const double amount = *best.amount; !attempt(amount + width)) attempt(amount - width);
  return best;
}

}  // namespace

template <int D>
std::optional<NamedTerm> closestTerm(Engine& mirror, const TermSearchOf<D>& search) {
  constexpr std::size_t mostTried = 5;
  std::vector<MirrorChangeOf<D>> changes = changesOf(search.scenes.front(), mirror.capabilities());
  changes.insert(changes.end(), search.more.begin(), search.more.end());
  std::vector<Candidate<D>> candidates;
  for (const MirrorChangeOf<D>& change : changes) {
    const auto responses = responsesTo<D>({change, termChange}, mirror, search);
    std::optional<Candidate<D>> best;
    for (std::size_t k = 0; responses && k < responses->size(); ++k) {
      const std::vector<double>& separation = search.instants[k].separation;
      if ((*responses)[k].size() != separation.size() || norm(separation) < lockstepRounding)
        continue;
      NamedTerm term = asTerm(change, separation, (*responses)[k]);
      if (!best || term.unexplained < best->term.unexplained) best = {&change, k, std::move(term)};
    }
    if (best && best->term.unexplained < termWorthTrying) candidates.push_back(*best);
  }
  std::ranges::sort(candidates, {}, [](const Candidate<D>& one) { return one.term.unexplained; });
  std::vector<NamedTerm> terms;
  for (const Candidate<D>& one : candidates | std::views::take(mostTried))
    terms.push_back(one.change->isConstant ? tried(one, mirror, search) : one.term);
  if (const auto named = bestTerm(terms)) return named;
  terms.clear();
  if (norm(search.instants.back().separation) < lockstepRounding) return std::nullopt;
  for (const MirrorChangeOf<D>& change : changes)
    if (change.isConstant) terms.push_back(triedAtLarge(change, mirror, search));
  return bestTerm(terms);
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
