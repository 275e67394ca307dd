#include "runs/lockstep/account.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include "runs/lockstep/rules.hpp"
#include "runs/lockstep/separation.hpp"
#include "runs/lockstep/terms.hpp"

namespace crossgrain::inline runs {
namespace {

double medianOf(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

void judge(LockstepRow& row) {
  for (const LockstepSeparation& separation : row.separations)
    if (separation.equivalent)
      row.equivalent = std::max(row.equivalent.value_or(0.0), *separation.equivalent);
  if (std::ranges::max(row.track) < lockstepRounding)
    row.verdict = LockstepVerdict::sameToRounding;
  else if (row.precise == row.starts)
    row.verdict = LockstepVerdict::sameToPrecision;
  else if (row.equivalent)
    row.verdict =
        *row.equivalent < lockstepSameLaw ? LockstepVerdict::sameLaw : LockstepVerdict::differs;
  else
    row.reason = "the yardstick moves nothing here";
}

}  // namespace

SeparationAccount::SeparationAccount(double diameter, std::vector<double> times,
                                     std::vector<std::size_t> told)
    : diameter_(diameter), times_(std::move(times)), told_(std::move(told)) {
  row_.track.assign(times_.size(), 0.0);
}

void SeparationAccount::add(std::size_t start, const LockstepWindow& window,
                            const Responses& responses, std::size_t wallFrom,
                            const std::vector<double>& limits) {
  std::vector<double>& track = tracks_.emplace_back();
  for (std::size_t k = 0; k < times_.size(); ++k) {
    track.push_back(farthest(window.engine[k], window.mirror[k], diameter_).distance);
    row_.track[k] = std::max(row_.track[k], track.back());
  }
  responses_.push_back(responses);
  if (!limits.empty()) {
    limits_.push_back(limits);
    row_.precise += std::ranges::equal(track, limits, std::ranges::less_equal());
  }

  const ContactKinds kinds = kindsVisited(window.mirror, wallFrom);
  row_.kinds.sticking += kinds.sticking;
  row_.kinds.sliding += kinds.sliding;
  row_.kinds.made += kinds.made;
  row_.kinds.opened += kinds.opened;
  row_.kinds.wall += kinds.wall;

  const std::vector<double> rounding(times_.size(), lockstepRounding);
  if (auto first =
          firstExceedance(window, diameter_, limits.empty() ? rounding : limits, wallFrom)) {
    first->start = start;
    if (!row_.first || first->until < row_.first->until) row_.first = std::move(first);
  }
  if (const auto forces = forcesOfFirstStep(window))
    row_.forces = row_.forces ? together(*row_.forces, *forces) : *forces;
  ++row_.starts;
}

/// Each start speaks for itself; one where the yardstick moves nothing says nothing.
LockstepSeparation SeparationAccount::separationAt(std::size_t which) const {
  const std::size_t frame = told_[which];
  LockstepSeparation separation;
  separation.time = times_[frame];
  std::vector<double> own, moved, explained;
  for (std::size_t s = 0; s < tracks_.size(); ++s) {
    own.push_back(tracks_[s][frame]);
    moved.push_back(responses_[s][which].back());
    if (!limits_.empty()) explained.push_back(limits_[s][frame]);
    if (!explained.empty() && own.back() <= explained.back()) continue;
    if (const auto equivalent = equivalentChange(own.back(), responses_[s][which]))
      separation.equivalent = std::max(separation.equivalent.value_or(0.0), *equivalent);
  }
  separation.median = medianOf(own);
  separation.largest = std::ranges::max(own);
  separation.yardstick = medianOf(moved);
  if (!explained.empty()) separation.rounding = medianOf(explained);
  return separation;
}

/// What exceeds the limit from any start at any time told is seen.
std::optional<double> SeparationAccount::resolution() const {
  std::optional<double> smallest;
  for (std::size_t s = 0; s < limits_.size(); ++s)
    for (std::size_t which = 0; which < told_.size(); ++which)
      if (const auto seen = equivalentChange(limits_[s][told_[which]], responses_[s][which]))
        smallest = std::min(smallest.value_or(*seen), *seen);
  return smallest;
}

LockstepRow SeparationAccount::row() const {
  LockstepRow row = row_;
  if (row.starts == 0) {
    row.track.clear();
    return row;
  }
  row.trackTime = times_;
  for (std::size_t k = 0; k < told_.size(); ++k) row.separations.push_back(separationAt(k));
  judge(row);
  if (row.verdict == LockstepVerdict::sameToPrecision) row.resolution = resolution();
  return row;
}

}  // namespace crossgrain::inline runs
