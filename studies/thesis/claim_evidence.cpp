#include "studies/thesis/claim_evidence.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "averaging/statistics.hpp"
#include "support/numbers.hpp"

namespace crossgrain::inline studies {
namespace {

Interpretation defaultOf(const ThesisResults& results, const CaseSettings& reference) {
  Interpretation own;
  own.label = "default: ";
  for (const OpenChoice& open : openChoices) {
    if (open.value == &CaseSettings::largeMass && reference.largeMass == 0.0) continue;  // not said
    own.label += describe(open, reference) + ", ";
  }
  own.label += describeRate(reference);
  for (const ThesisCase& setup : results.cases) {
    if (!sameBut(nullptr, false, settingsOf(setup), reference)) continue;
    if (isOf(setup, "packings")) own.judged.push_back(&setup);
    if (isOf(setup, "packings") || isOf(setup, "time")) own.timed.push_back(&setup);
  }
  return own;
}

void addOthers(const ThesisResults& results, const OpenChoice& open, const CaseSettings& reference,
               std::vector<Interpretation>& all) {
  std::map<std::pair<double, double>, Interpretation> byValue;
  for (const ThesisCase& setup : results.cases) {
    const CaseSettings settings = settingsOf(setup);
    if (!isOf(setup, open.key) || sameSetting(settings.*open.value, reference.*open.value) ||
        !sameBut(&open, true, settings, reference))
      continue;
    Interpretation& own = byValue[{settings.*open.value, settings.omega}];
    own.key = open.key;
    own.label = describe(open, settings);
    if (!sameSetting(settings.omega, reference.omega)) own.label += ", " + describeRate(settings);
    own.judged.push_back(&setup);
    own.timed.push_back(&setup);
  }
  for (auto& [value, own] : byValue) all.push_back(std::move(own));
}

std::string bandText(const ClaimBand& band) {
  const auto edge = [](double value) { return support::readableSetting(value); };
  if (band.low && band.high)
    return fmt::format("within {} to {}", edge(*band.low), edge(*band.high));
  return band.low ? "above " + edge(*band.low) : "below " + edge(*band.high);
}

/// "0.41 ± 0.03 d (12 runs)"
std::string valueText(const ClaimBand& band, const Estimate& of, std::size_t asked) {
  constexpr double rounding = 1e-12;  // where runs differ by it they do not differ
  const bool differ = of.standardError && *of.standardError > rounding * std::abs(of.value);
  std::string text =
      differ ? support::readable(of.value, of.standardError) : support::readable(of.value);
  if (!band.unit.empty()) text += " " + band.unit;
  if (of.basis == Estimate::Basis::exact) return text;
  if (of.basis == Estimate::Basis::within)
    return text + (of.standardError ? " (one run, the error is within it)"
                                    : " (one run, which has no error)");
  const auto runs = static_cast<std::size_t>(of.runs);
  return text + (asked > runs ? fmt::format(" ({} of {} runs)", runs, asked)
                              : fmt::format(" ({} runs)", runs));
}

/// "5 to 8", or several; when the runs were averaged, in rotations since the ring had closed.
std::string rotationsOf(const std::vector<CaseRun>& runs) {
  std::set<std::pair<double, double>> windows;
  for (const CaseRun& at : runs)
    windows.insert({at.setup->settleRotations, at.setup->endRotation()});
  std::vector<std::string> texts;
  for (const auto& [from, to] : windows) texts.push_back(fmt::format("{:g} to {:g}", from, to));
  return fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace

std::vector<Interpretation> interpretationsOf(const ThesisResults& results) {
  const ThesisCase* const first = referenceCase(results);
  if (!first) return {Interpretation{"", "default", {}, {}}};
  const CaseSettings reference = settingsOf(*first);
  std::vector<Interpretation> all{defaultOf(results, reference)};
  for (const OpenChoice& open : openChoices) addOthers(results, open, reference, all);
  return all;
}

RunSet ClaimScope::runsOf(const std::vector<const ThesisCase*>& cases, std::string label) const {
  RunSet set{{}, std::move(label), {}};
  for (const ThesisCase* setup : cases) {
    std::set<int> own;
    for (const std::string& name : {engine, mirror})
      for (const CaseRun& at : finishedRuns(results, *setup, name))
        if (own.insert(at.run->packing).second) set.runs.push_back(at);
    if (own.empty()) set.without.push_back(setup->name);
  }
  return set;
}

RunSet ClaimScope::densities(double from, double to, const std::string& label) const {
  std::vector<const ThesisCase*> cases;
  for (const ThesisCase* setup : interpretation.judged)
    if (setup->label >= from && setup->label < to) cases.push_back(setup);
  return runsOf(cases, std::isinf(to)
                           ? fmt::format("runs {} (ν̄ from {:g})", label, from)
                           : fmt::format("runs {} (ν̄ from {:g} to {:g})", label, from, to));
}

RunSet ClaimScope::family(std::string_view name) const {
  std::vector<const ThesisCase*> cases;
  for (const ThesisCase& setup : results.cases)
    if (isOf(setup, name)) cases.push_back(&setup);
  return runsOf(cases, fmt::format("runs of the family \"{}\"", name));
}

RunSet ClaimScope::timed() const {
  RunSet all = runsOf(interpretation.timed, "runs of the families \"packings\" and \"time\"");
  all.runs = longestOfEachPacking(all.runs);
  return all;
}

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
    std::set<std::string> cases;
    for (const CaseRun& at : set.runs) cases.insert(at.setup->name);
    return fmt::format("none of {} has the data ({})", set.label, fmt::join(cases, ", "));
  }
  if (set.without.empty()) return fmt::format("there are no {}: no case of theirs", set.label);
  return fmt::format("there are no {}: none of {}", set.label, fmt::join(set.without, ", "));
}

void Evidence::restsOn(const std::vector<CaseRun>& runs) {
  runs_.insert(runs_.end(), runs.begin(), runs.end());
}

ClaimVerdict Evidence::verdictOf(const ClaimBand& band) const {
  const auto entry = entries_.find(band.name);
  if (entry == entries_.end() || !entry->second.estimate) return ClaimVerdict::undecided;
  return placeIn(band, *entry->second.estimate, scope_.common("confidence"),
                 scope_.rule.judgedFigures());
}

std::string Evidence::describe(const ClaimBand& band, ClaimVerdict verdict) const {
  const Entry& entry = entries_.at(band.name);
  if (!entry.estimate) return fmt::format("{}: {}", band.label, entry.missing);
  const std::string text =
      fmt::format("{} is {}", band.label, valueText(band, *entry.estimate, entry.of));
  if (verdict == ClaimVerdict::reproduced) return text + ", " + bandText(band);
  if (verdict == ClaimVerdict::refuted) return text + ", not " + bandText(band);
  const auto n = runsToDecide(band, *entry.estimate, scope_.common("confidence"));
  return text + ", which does not show whether it is " + bandText(band) +
         (n ? fmt::format("; about {} runs would", *n) : "");
}

ClaimRow Evidence::row() const {
  const ClaimRule& rule = scope_.rule;
  ClaimRow row;
  row.id = rule.id;
  row.claim = rule.claim;
  row.engine = scope_.engine;
  row.mirror = scope_.mirror;
  row.interpretation = scope_.interpretation.label;
  row.plot = rule.figure;
  std::set<std::string> cases;
  for (const CaseRun& at : runs_) cases.insert(at.setup->name);
  row.cases.assign(cases.begin(), cases.end());
  std::map<ClaimVerdict, std::vector<std::string>> sentences;
  for (const ClaimBand& band : rule.figures) {
    ClaimFigure& figure = row.figures.emplace_back();
    figure.name = band.label;
    figure.key = band.name;
    figure.unit = band.unit;
    figure.low = band.low;
    figure.high = band.high;
    if (const auto entry = entries_.find(band.name);
        entry != entries_.end() && entry->second.estimate) {
      figure.value = entry->second.estimate->value;
      figure.standardError = entry->second.estimate->standardError;
    }
    if (!band.judged()) continue;
    const ClaimVerdict verdict = verdictOf(band);
    figure.verdict = verdict;
    sentences[verdict].push_back(describe(band, verdict));
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

}  // namespace crossgrain::inline studies
