#include "studies/lockstep/closest_term.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ranges>
#include <utility>

#include "studies/lockstep/rules.hpp"
#include "studies/lockstep/separation.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline studies {
namespace {

void append(std::vector<double>& all, const std::vector<double>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// What a change of the mirror does, from all starts, by look. Absent where it cannot run like
/// that.
/// @param by  of a constant, the relative change
std::optional<std::vector<std::vector<double>>> responsesTo(const MirrorChange& change, double by,
                                                            Engine& mirror,
                                                            const TermSearch& search) {
  std::vector<std::vector<double>> responses(search.looks.size());
  for (std::size_t s = 0; s < search.scenes.size(); ++s) {
    throwIfInterrupted();
    Scene changed = search.scenes[s];
    change.apply(changed, by);
    std::vector<std::uint64_t> steps;
    for (const TermLook& look : search.looks) steps.push_back(stepsUntil(look.time, changed.dt));
    std::vector<LockstepFrame> moved;
    try {
      mirror.load(changed, {});
      moved = follow(mirror, changed.dt, steps);
    } catch (const Interrupted&) {
      throw;
    } catch (const std::exception&) {
      return std::nullopt;
    }
    for (std::size_t k = 0; k < moved.size(); ++k)
      append(responses[k],
             separationVector(moved[k], search.looks[k].unchanged[s], search.diameter));
  }
  return responses;
}

double norm(const std::vector<double>& vector) {
  return std::sqrt(std::inner_product(vector.begin(), vector.end(), vector.begin(), 0.0));
}

/// A change that may account for what is seen at one of the looks, to first order.
struct Candidate {
  const MirrorChange* change;
  std::size_t look;
  NamedTerm term;
};

/// A constant changed by as much as the candidate says, and what that leaves in the mirror itself.
/// To first order it is -59 % for a half: each further trial takes the amount in proportion to what
/// the last one did.
NamedTerm tried(const Candidate& candidate, Engine& mirror, const TermSearch& search) {
  constexpr int trials = 3;
  const std::vector<double>& separation = search.looks[candidate.look].separation;
  NamedTerm best{candidate.term.name, candidate.term.amount, 1.0};
  double amount = *candidate.term.amount;
  for (int trial = 0; trial < trials; ++trial) {
    const auto responses = responsesTo(*candidate.change, amount, mirror, search);
    if (!responses || (*responses)[candidate.look].size() != separation.size()) break;
    const std::vector<double>& response = (*responses)[candidate.look];
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

}  // namespace

std::optional<NamedTerm> closestTerm(Engine& mirror, const TermSearch& search) {
  constexpr std::size_t mostTried = 5;
  std::vector<MirrorChange> changes = changesOf(search.scenes.front(), mirror.capabilities());
  changes.insert(changes.end(), search.more.begin(), search.more.end());
  std::vector<Candidate> candidates;
  for (const MirrorChange& change : changes) {
    const auto responses = responsesTo(change, termChange, mirror, search);
    std::optional<Candidate> best;
    for (std::size_t k = 0; responses && k < responses->size(); ++k) {
      const std::vector<double>& separation = search.looks[k].separation;
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
  return bestTerm(terms);
}

std::vector<double> separationOfAll(const std::vector<std::vector<LockstepFrame>>& one,
                                    const std::vector<std::vector<LockstepFrame>>& other,
                                    std::size_t frame, double diameter) {
  std::vector<double> separation;
  for (std::size_t s = 0; s < one.size(); ++s)
    append(separation, separationVector(one[s][frame], other[s][frame], diameter));
  return separation;
}

std::vector<std::size_t> framesForTerms(const std::vector<std::size_t>& reported) {
  std::vector<std::size_t> frames(reported.front());
  std::iota(frames.begin(), frames.end(), std::size_t{0});
  frames.insert(frames.end(), reported.begin(), reported.end());
  return frames;
}

std::vector<std::size_t> looksForTerms(const std::vector<std::size_t>& reported,
                                       const std::vector<double>& times,
                                       const std::optional<FirstExceedance>& first) {
  constexpr double rounding = 1e-9;  // of a time
  const std::vector<std::size_t> frames = framesForTerms(reported);
  std::size_t when = 0;
  while (when + 1 < frames.size() &&
         !(first && times[frames[when]] >= (1.0 - rounding) * first->until))
    ++when;
  std::vector<std::size_t> looks = {when};
  while (looks.back() < reported.front()) looks.push_back(looks.back() + 1);
  return looks;
}

std::vector<LockstepFrame> chosen(const std::vector<LockstepFrame>& window,
                                  const std::vector<std::size_t>& frames) {
  std::vector<LockstepFrame> some;
  for (const std::size_t frame : frames) {
    some.push_back(window[frame]);
    some.back().contacts.reset();
  }
  return some;
}

}  // namespace crossgrain::inline studies
