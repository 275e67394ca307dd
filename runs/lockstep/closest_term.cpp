#include "runs/lockstep/closest_term.hpp"

#include <numeric>

#include "runs/lockstep/rules.hpp"
#include "runs/lockstep/separation.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline runs {
namespace {

void append(std::vector<double>& all, const std::vector<double>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// What a change of the mirror does, from all starts, by look. Absent where it cannot run like
/// that.
std::optional<std::vector<std::vector<double>>> responsesTo(const MirrorChange& change,
                                                            Engine& mirror,
                                                            const TermSearch& search) {
  std::vector<std::vector<double>> responses(search.looks.size());
  for (std::size_t s = 0; s < search.scenes.size(); ++s) {
    throwIfInterrupted();
    Scene changed = search.scenes[s];
    change.apply(changed, termChange);
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

}  // namespace

std::optional<NamedTerm> closestTerm(Engine& mirror, const TermSearch& search) {
  std::vector<MirrorChange> changes = changesOf(search.scenes.front(), mirror.capabilities());
  changes.insert(changes.end(), search.more.begin(), search.more.end());
  std::vector<NamedTerm> terms;
  for (const MirrorChange& change : changes) {
    const auto responses = responsesTo(change, mirror, search);
    for (std::size_t k = 0; responses && k < responses->size(); ++k)
      if ((*responses)[k].size() == search.looks[k].separation.size())
        terms.push_back(asTerm(change, search.looks[k].separation, (*responses)[k]));
  }
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

std::vector<std::size_t> framesForTerms(const std::vector<std::size_t>& told) {
  std::vector<std::size_t> frames(told.front());
  std::iota(frames.begin(), frames.end(), std::size_t{0});
  frames.insert(frames.end(), told.begin(), told.end());
  return frames;
}

std::vector<std::size_t> looksForTerms(const std::vector<std::size_t>& told,
                                       const std::vector<double>& times,
                                       const std::optional<FirstExceedance>& first) {
  constexpr double rounding = 1e-9;  // of a time
  const std::vector<std::size_t> frames = framesForTerms(told);
  std::size_t when = 0;
  while (when + 1 < frames.size() &&
         !(first && times[frames[when]] >= (1.0 - rounding) * first->until))
    ++when;
  std::vector<std::size_t> looks = {when};
  while (looks.back() < told.front()) looks.push_back(looks.back() + 1);
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

}  // namespace crossgrain::inline runs
