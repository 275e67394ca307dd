#include "studies/lockstep/account.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include "studies/lockstep/rules.hpp"
#include "studies/lockstep/separation.hpp"
#include "studies/lockstep/terms.hpp"

namespace crossgrain::inline studies {
namespace {

double medianOf(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

/// Ranks, from 0, of the order statistics of n values between which their median lies at 95 %: each
/// end is wrong with 2.5 % at most.
std::pair<std::size_t, std::size_t> ranksOfMedian(std::size_t n) {
  unsigned low = 0;
  while (gsl_cdf_binomial_P(low + 1, 0.5, static_cast<unsigned>(n)) <= 0.025) ++low;
  return {low, n - 1 - low};
}

void readMedian(LockstepRow& row) {
  std::vector<double> values;
  for (const StartReading& reading : row.readings)
    if (reading.equivalent) values.push_back(*reading.equivalent);
  if (values.empty()) return;
  std::ranges::sort(values);
  const auto [low, high] = ranksOfMedian(values.size());
  row.equivalent = medianOf(values);
  row.equivalentLow = values[low];
  row.equivalentHigh = values[high];
}

/// Whether frames have what touched when the two first parted: none has the contacts of the start,
/// nor those of steps that no frame is of. @param step  the first frame's time [s]
bool isSeen(const FirstExceedance& first, double step) {
  return first.after > 0.0 && first.until - first.after < 1.5 * step;
}

}  // namespace

bool exceedsStrayShare(std::size_t count, std::size_t read) {
  return count > 1 && gsl_cdf_binomial_Q(static_cast<unsigned>(count - 1), strayShare,
                                         static_cast<unsigned>(read)) < 1.0 - shareConfidence;
}

void judge(LockstepRow& row, bool moved, std::size_t alone) {
  readMedian(row);
  for (const StartReading& reading : row.readings) {
    row.read += reading.until > 0.0;
    row.beyond += reading.beyond;
  }
  const auto read = static_cast<unsigned>(row.read), beyond = static_cast<unsigned>(row.beyond);
  if (read > 0)
    row.shareHigh = beyond == read ? 1.0
                                   : gsl_cdf_beta_Pinv(shareConfidence, beyond + 1.0,
                                                       static_cast<double>(read - beyond));
  const ContactKinds& kinds = row.kinds;
  const bool touched = kinds.sticking + kinds.sliding + kinds.made + kinds.opened > 0;
  row.verdict = Equivalence::undecided;
  if (exceedsStrayShare(beyond, read)) {
    row.verdict = Equivalence::differs;
    row.severalAtOnce = !exceedsStrayShare(alone, read);
  } else if (!moved && !touched)
    row.reason = "nothing touches in these windows: no law was compared";
  else if (std::ranges::max(row.track) < lockstepRounding)
    row.verdict = Equivalence::sameToRounding;
  else if (row.precise == row.starts)
    row.verdict = Equivalence::sameToPrecision;
  else if (!moved)
    row.reason = "a change of the law's constant moves nothing here";
  else if (row.read < std::min(leastRead, row.starts))
    row.reason = fmt::format(
        "from {} of {} starts only is there a time at which a change of the law's constant acts in "
        "proportion",
        row.read, row.starts);
  else if (beyond == 0)
    row.verdict = row.precise > 0 ? Equivalence::sameToPrecision : Equivalence::sameLaw;
  else if (*row.shareHigh < strayShare)
    row.verdict = Equivalence::sameLaw;
  else
    row.reason = fmt::format(
        "from {} of {} starts the difference is beyond the limit, which chance may do from {:g} % "
        "of starts: more starts decide",
        row.beyond, row.read, 100.0 * strayShare);
}

SeparationAccount::SeparationAccount(double diameter, std::vector<double> times,
                                     std::vector<std::size_t> reported)
    : diameter_(diameter), times_(std::move(times)), reported_(std::move(reported)) {
  row_.track.assign(times_.size(), 0.0);
}

template <int D>
void SeparationAccount::add(std::size_t start, const LockstepWindowOf<D>& window,
                            const Responses& responses, std::size_t wallFrom,
                            const std::vector<double>& limits) {
  std::vector<double>& track = tracks_.emplace_back();
  for (std::size_t k = 0; k < times_.size(); ++k) {
    track.push_back(farthest(window.engine[k], window.mirror[k], diameter_).distance);
    row_.track[k] = std::max(row_.track[k], track.back());
  }
  auto& apart = apart_.emplace_back();
  for (const std::size_t frame : reported_)
    apart.push_back(distances(window.engine[frame], window.mirror[frame], diameter_));
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
  alone_.push_back(false);
  if (auto first =
          firstExceedance(window, diameter_, limits.empty() ? rounding : limits, wallFrom)) {
    first->start = start;
    alone_.back() = first->touching < 2 && isSeen(*first, times_.front());
    if (!row_.first || first->until < row_.first->until) row_.first = std::move(first);
  }
  if (const auto forces = forcesOfFirstStep(window))
    row_.forces = row_.forces ? together(*row_.forces, *forces) : *forces;
  ++row_.starts;
}

bool SeparationAccount::explained(std::size_t start, std::size_t which) const {
  const std::size_t frame = reported_[which];
  return !limits_.empty() && tracks_[start][frame] <= limits_[start][frame];
}

std::optional<double> SeparationAccount::equivalentAt(std::size_t start, std::size_t which) const {
  return explained(start, which) ? std::nullopt
                                 : equivalentChange(apart_[start][which], responses_[start][which]);
}

StartReading SeparationAccount::readingOf(std::size_t start) const {
  StartReading reading;
  for (std::size_t which = 0; which < reported_.size(); ++which) {
    const double separation = tracks_[start][reported_[which]];
    const std::vector<double>& moved = responses_[start][which];
    const bool nothingTouches = std::ranges::max(moved) <= lockstepRounding;
    const bool parts = nothingTouches && separation > visibleMotion && !explained(start, which);
    if (!parts && proportionalRates(moved).empty()) continue;
    reading.until = times_[reported_[which]];
    reading.beyond |= parts;
    if (const auto equivalent = equivalentAt(start, which))
      reading.equivalent = std::max(reading.equivalent.value_or(0.0), *equivalent);
  }
  reading.beyond |= reading.equivalent.value_or(0.0) > lockstepSameLaw;
  return reading;
}

LockstepSeparation SeparationAccount::separationAt(std::size_t which) const {
  const std::size_t frame = reported_[which];
  LockstepSeparation separation;
  separation.time = times_[frame];
  std::vector<double> own, moved, rounding, equivalents;
  for (std::size_t s = 0; s < tracks_.size(); ++s) {
    own.push_back(tracks_[s][frame]);
    moved.push_back(std::ranges::max(responses_[s][which]));
    if (!limits_.empty()) rounding.push_back(limits_[s][frame]);
    if (const auto equivalent = equivalentAt(s, which)) equivalents.push_back(*equivalent);
  }
  separation.median = medianOf(own);
  separation.largest = std::ranges::max(own);
  separation.referencePerturbation = medianOf(moved);
  if (!rounding.empty()) separation.rounding = medianOf(rounding);
  if (!equivalents.empty()) separation.equivalent = medianOf(equivalents);
  return separation;
}

/// A separation that exceeds the limit from any start at any time that can be read is seen.
std::optional<double> SeparationAccount::resolution() const {
  std::optional<double> smallest;
  for (std::size_t s = 0; s < limits_.size(); ++s)
    for (std::size_t which = 0; which < reported_.size(); ++which)
      if (const auto rates = proportionalRates(responses_[s][which]); !rates.empty()) {
        const double seen = limits_[s][reported_[which]] / std::ranges::max(rates);
        smallest = std::min(smallest.value_or(seen), seen);
      }
  return smallest;
}

LockstepRow SeparationAccount::row() const {
  LockstepRow row = row_;
  if (row.starts == 0) {
    row.track.clear();
    return row;
  }
  row.trackTime = times_;
  for (std::size_t k = 0; k < reported_.size(); ++k) row.separations.push_back(separationAt(k));
  std::size_t alone = 0;
  for (std::size_t s = 0; s < tracks_.size(); ++s) {
    row.readings.push_back(readingOf(s));
    alone += row.readings[s].beyond && alone_[s];
  }
  bool moved = false;
  for (const Responses& responses : responses_)
    for (const std::vector<double>& then : responses)
      moved |= std::ranges::max(then) > lockstepRounding;
  judge(row, moved, alone);
  if (row.verdict == Equivalence::sameToPrecision) row.resolution = resolution();
  return row;
}

template void SeparationAccount::add(std::size_t, const LockstepWindowOf<2>&, const Responses&,
                                     std::size_t, const std::vector<double>&);
template void SeparationAccount::add(std::size_t, const LockstepWindowOf<3>&, const Responses&,
                                     std::size_t, const std::vector<double>&);

}  // namespace crossgrain::inline studies
