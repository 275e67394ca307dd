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

std::optional<RunsFromStarts> runsWith(Engine& mirror, const std::vector<Scene>& scenes,
                                       const std::vector<AppliedChange>& changes,
                                       const std::vector<double>& times) {
  RunsFromStarts runs;
  for (Scene scene : scenes) {
    throwIfInterrupted();
    try {
      for (const AppliedChange& one : changes) one.change.apply(scene, one.by);
      std::vector<std::uint64_t> steps;
      for (const double time : times) steps.push_back(stepsUntil(time, scene.dt));
      mirror.load(scene, {});
      runs.push_back(follow(mirror, scene.dt, steps));
    } catch (const Interrupted&) {
      throw;
    } catch (const std::exception&) {
      return std::nullopt;
    }
  }
  return runs;
}

std::vector<double> separationOfAll(const RunsFromStarts& one, std::size_t instant,
                                    const RunsFromStarts& other, std::size_t otherInstant,
                                    double diameter) {
  std::vector<double> separation;
  for (std::size_t s = 0; s < one.size(); ++s)
    std::ranges::copy(separationVector(one[s][instant], other[s][otherInstant], diameter),
                      std::back_inserter(separation));
  return separation;
}

void TermFrames::add(const LockstepWindow& window, const std::vector<std::size_t>& reported) {
  firstReported_ = reported.front();
  const auto chosen = [&](const std::vector<LockstepFrame>& frames) {
    std::vector<LockstepFrame> some(frames.begin(),
                                    frames.begin() + static_cast<std::ptrdiff_t>(firstReported_));
    for (const std::size_t frame : reported) some.push_back(frames[frame]);
    for (LockstepFrame& frame : some) frame.contacts.reset();
    return some;
  };
  engine_.push_back(chosen(window.engine));
  other_.push_back(chosen(window.mirror));
}

std::vector<TermInstant> TermFrames::instants(const std::optional<FirstExceedance>& first,
                                              double diameter) const {
  constexpr double rounding = 1e-9;  // of a time
  const std::vector<LockstepFrame>& frames = other_.front();
  std::size_t when = 0;
  while (when + 1 < frames.size() &&
         !(first && frames[when].time >= (1.0 - rounding) * first->until))
    ++when;
  std::vector<TermInstant> found;
  do {
    TermInstant& instant = found.emplace_back();
    instant.time = frames[when].time;
    for (const auto& window : other_) instant.unchanged.push_back({window[when]});
    instant.separation = separationOfAll(engine_, when, other_, when, diameter);
  } while (++when <= firstReported_);
  return found;
}

namespace {

/// What a change of the mirror does, from all starts, by instant. Absent where it cannot run like
/// that.
std::optional<std::vector<std::vector<double>>> responsesTo(const AppliedChange& change,
                                                            Engine& mirror,
                                                            const TermSearch& search) {
  std::vector<double> times;
  for (const TermInstant& instant : search.instants) times.push_back(instant.time);
  const auto moved = runsWith(mirror, search.scenes, {change}, times);
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
struct Candidate {
  const MirrorChange* change;
  std::size_t instant;
  NamedTerm term;
};

/// A constant changed by as much as the candidate says, and what that leaves in the mirror itself.
/// To first order it is -59 % for a half: each further trial takes the amount in proportion to what
/// the last one did.
NamedTerm tried(const Candidate& candidate, Engine& mirror, const TermSearch& search) {
  constexpr int trials = 3;
  const std::vector<double>& separation = search.instants[candidate.instant].separation;
  NamedTerm best{candidate.term.name, candidate.term.amount, 1.0};
  double amount = *candidate.term.amount;
  for (int trial = 0; trial < trials; ++trial) {
    const auto responses = responsesTo({*candidate.change, amount}, mirror, search);
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
NamedTerm triedAtLarge(const MirrorChange& change, Engine& mirror, const TermSearch& search) {
  const std::vector<double>& separation = search.instants.back().separation;
  NamedTerm best{change.name, std::nullopt, 1.0};
  const auto attempt = [&](double amount) {
    const auto responses = responsesTo({change, amount}, mirror, search);
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

std::optional<NamedTerm> closestTerm(Engine& mirror, const TermSearch& search) {
  constexpr std::size_t mostTried = 5;
  std::vector<MirrorChange> changes = changesOf(search.scenes.front(), mirror.capabilities());
  changes.insert(changes.end(), search.more.begin(), search.more.end());
  std::vector<Candidate> candidates;
  for (const MirrorChange& change : changes) {
    const auto responses = responsesTo({change, termChange}, mirror, search);
    std::optional<Candidate> best;
    for (std::size_t k = 0; responses && k < responses->size(); ++k) {
      const std::vector<double>& separation = search.instants[k].separation;
      if ((*responses)[k].size() != separation.size() || norm(separation) < lockstepRounding)
        continue;
      NamedTerm term = asTerm(change, separation, (*responses)[k]);
      if (!best || term.unexplained < best->term.unexplained) best = {&change, k, std::move(term)};
    }
    if (best && best->term.unexplained < termWorthTrying) candidates.push_back(*best);
  }
  std::ranges::sort(candidates, {}, [](const Candidate& one) { return one.term.unexplained; });
  std::vector<NamedTerm> terms;
  for (const Candidate& one : candidates | std::views::take(mostTried))
    terms.push_back(one.change->isConstant ? tried(one, mirror, search) : one.term);
  if (const auto named = bestTerm(terms)) return named;
  terms.clear();
  if (norm(search.instants.back().separation) < lockstepRounding) return std::nullopt;
  for (const MirrorChange& change : changes)
    if (change.isConstant) terms.push_back(triedAtLarge(change, mirror, search));
  return bestTerm(terms);
}

}  // namespace crossgrain::inline studies
