#include "runs/thesis/claims_evidence.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "averaging/statistics.hpp"
#include "reports/common/numbers.hpp"

namespace crossgrain::inline runs {
namespace {

std::string bandWords(const ClaimBand& band) {
  const auto edge = [](double value) { return reports::readableSetting(value); };
  if (band.low && band.high)
    return fmt::format("within {} to {}", edge(*band.low), edge(*band.high));
  return band.low ? "above " + edge(*band.low) : "below " + edge(*band.high);
}

/// "0.41 ± 0.03 d (12 runs)"
std::string numberWords(const ClaimBand& band, const Estimate& of, std::size_t asked) {
  constexpr double rounding = 1e-12;  // where runs differ by it they do not differ
  const bool differ = of.standardError && *of.standardError > rounding * std::abs(of.value);
  std::string words =
      differ ? reports::readable(of.value, of.standardError) : reports::readable(of.value);
  if (!band.unit.empty()) words += " " + band.unit;
  switch (of.basis) {
    case Estimate::Basis::exact:
      return words;
    case Estimate::Basis::within:
      return words + (of.standardError ? " (one run, the error is within it)"
                                       : " (one run, which has no error)");
    case Estimate::Basis::runs:
      break;
  }
  const auto runs = static_cast<std::size_t>(of.runs);
  return words + (asked > runs ? fmt::format(" ({} of {} runs)", runs, asked)
                               : fmt::format(" ({} runs)", runs));
}

}  // namespace

ClaimVerdict placeIn(const ClaimBand& band, const Estimate& estimate, double confidence,
                     int figures) {
  const auto half = estimate.half(confidence);
  if (!half) return ClaimVerdict::undecided;
  const double x = estimate.value;
  if ((!band.low || x - *half >= *band.low) && (!band.high || x + *half <= *band.high))
    return ClaimVerdict::reproduced;
  const double wide = *estimate.half(1.0 - (1.0 - confidence) / std::max(figures, 1));
  const bool below = band.low && x + wide < *band.low;
  const bool above = band.high && x - wide > *band.high;
  return below || above ? ClaimVerdict::refuted : ClaimVerdict::undecided;
}

std::optional<int> runsToDecide(const ClaimBand& band, const Estimate& estimate,
                                double confidence) {
  if (estimate.basis != Estimate::Basis::runs || !estimate.standardError || estimate.runs < 2)
    return std::nullopt;
  double room = std::numeric_limits<double>::infinity();
  for (const auto& edge : {band.low, band.high})
    if (edge) room = std::min(room, std::abs(estimate.value - *edge));
  const double scatter = *estimate.standardError * std::sqrt(estimate.runs);
  constexpr int most = 1000;
  for (int n = estimate.runs + 1; n <= most; ++n) {
    const double dof = std::isinf(estimate.dof) ? 1e6 : estimate.dof + n - estimate.runs;
    if (studentQuantile(confidence, dof) * scatter / std::sqrt(n) < room) return n;
  }
  return std::nullopt;
}

void Evidence::put(const std::string& figure, const std::optional<Estimate>& estimate,
                   std::string missing, std::size_t of) {
  const bool finite = estimate && std::isfinite(estimate->value);
  entries_[scope_.rule.band(figure).name] = {finite ? estimate : std::nullopt, std::move(missing),
                                             of};
}

std::string Evidence::missing(const RunSet& set) {
  if (!set.runs.empty()) {
    std::set<std::string> legs;
    for (const LegRun& at : set.runs) legs.insert(at.leg->name);
    return fmt::format("none of {} has the data ({})", set.words, fmt::join(legs, ", "));
  }
  if (set.without.empty()) return fmt::format("there are no {}: no leg of theirs", set.words);
  return fmt::format("there are no {}: none of {}", set.words, fmt::join(set.without, ", "));
}

void Evidence::restsOn(const RunSet& set) {
  for (const LegRun& at : set.runs) {
    legs_.insert(at.leg->name);
    runs_.push_back(at);
  }
}

void Evidence::mean(const std::string& figure, const RunSet& set, const RunFigure& of) {
  std::vector<Measured> values;
  RunSet used;
  for (const LegRun& at : set.runs) {
    const auto value = of(at);
    if (!value || !std::isfinite(value->value)) continue;
    values.push_back(*value);
    used.runs.push_back(at);
  }
  restsOn(used);
  put(figure, meanOver(values), missing(set), set.runs.size());
}

void Evidence::trend(const std::string& figure, const RunSet& set, const RunFigure& of) {
  std::vector<TrendPoint> points;
  RunSet used;
  for (const LegRun& at : set.runs) {
    const auto value = of(at);
    if (!value || !std::isfinite(value->value)) continue;
    points.push_back({at.leg->label, value->value});
    used.runs.push_back(at);
  }
  restsOn(used);
  const int fewest = static_cast<int>(scope_.common("fewest_for_trend"));
  put(figure, rankTrend(points, fewest),
      points.empty() ? missing(set)
                     : fmt::format("{}: {} with the data, of different ν̄, are too few for a trend",
                                   set.words, points.size()),
      set.runs.size());
}

const Evidence::Entry* Evidence::entryOf(const ClaimBand& band) const {
  const auto found = entries_.find(band.name);
  return found == entries_.end() ? nullptr : &found->second;
}

ClaimVerdict Evidence::verdictOf(const ClaimBand& band) const {
  const Entry* const entry = entryOf(band);
  if (!entry || !entry->estimate) return ClaimVerdict::undecided;
  return placeIn(band, *entry->estimate, scope_.common("confidence"), scope_.rule.judgedFigures());
}

std::string Evidence::sentenceOf(const ClaimBand& band, ClaimVerdict verdict) const {
  const Entry* const entry = entryOf(band);
  if (!entry) return fmt::format("{}: not looked at", band.label);
  if (!entry->estimate) return fmt::format("{}: {}", band.label, entry->missing);
  std::string words =
      fmt::format("{} is {}", band.label, numberWords(band, *entry->estimate, entry->of));
  switch (verdict) {
    case ClaimVerdict::reproduced:
      return words + ", " + bandWords(band);
    case ClaimVerdict::refuted:
      return words + ", not " + bandWords(band);
    case ClaimVerdict::undecided:
      break;
  }
  words += ", which does not tell whether it is " + bandWords(band);
  if (const auto n = runsToDecide(band, *entry->estimate, scope_.common("confidence")))
    words += fmt::format("; about {} runs would", *n);
  return words;
}

ClaimRow Evidence::row() const {
  const ClaimRule& rule = scope_.rule;
  ClaimRow row;
  row.id = rule.id;
  row.claim = rule.claim;
  row.engine = scope_.engine;
  row.carrier = scope_.carrier;
  row.reading = scope_.reading.words;
  row.plot = rule.figure;
  row.legs.assign(legs_.begin(), legs_.end());
  std::map<ClaimVerdict, std::vector<std::string>> sentences;
  for (const ClaimBand& band : rule.figures) {
    ClaimFigure& figure = row.figures.emplace_back();
    figure.name = band.label;
    figure.key = band.name;
    figure.unit = band.unit;
    figure.low = band.low;
    figure.high = band.high;
    if (const Entry* const entry = entryOf(band); entry && entry->estimate) {
      figure.value = entry->estimate->value;
      figure.standardError = entry->estimate->standardError;
    }
    if (!band.judged()) continue;
    const ClaimVerdict verdict = verdictOf(band);
    figure.verdict = verdict;
    sentences[verdict].push_back(sentenceOf(band, verdict));
  }
  using enum ClaimVerdict;
  row.verdict = !sentences[refuted].empty()     ? refuted
                : !sentences[undecided].empty() ? undecided
                                                : reproduced;
  std::vector<std::string> parts;
  for (const ClaimVerdict verdict : {refuted, undecided, reproduced})
    if (!sentences[verdict].empty())
      parts.push_back(fmt::format("{}: {}.", nameOf(verdict), fmt::join(sentences[verdict], "; ")));
  row.why = fmt::format("{}", fmt::join(parts, " "));
  if (!runs_.empty())
    row.why +=
        fmt::format(" Averaged over rotations {} since the ring had closed.", rotationsOf(runs_));
  return row;
}

}  // namespace crossgrain::inline runs
