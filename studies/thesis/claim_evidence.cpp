#include "studies/thesis/claim_evidence.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "averaging/statistics.hpp"
#include "support/numbers.hpp"

namespace crossgrain::inline studies {
namespace {

std::string bandText(const ClaimBand& band) {
  const auto edge = [](double value) { return readableSetting(value); };
  if (band.low && band.high)
    return fmt::format("within {} to {}", edge(*band.low), edge(*band.high));
  return band.low ? "above " + edge(*band.low) : "below " + edge(*band.high);
}

/// "0.41 ± 0.03 d (12 runs)"
std::string valueText(const ClaimBand& band, const Estimate& of, std::size_t asked) {
  constexpr double rounding = 1e-12;  // where runs differ by it they do not differ
  const bool differ = of.standardError && *of.standardError > rounding * std::abs(of.value);
  std::string text = differ ? readable(of.value, of.standardError) : readable(of.value);
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

Verdict placeIn(const ClaimBand& band, const Estimate& estimate, double confidence, int figures) {
  const auto half = estimate.half(confidence);
  if (!half) return Verdict::undecided;
  const double x = estimate.value;
  if ((!band.low || x - *half >= *band.low) && (!band.high || x + *half <= *band.high))
    return Verdict::pass;
  const double wide = *estimate.half(1.0 - (1.0 - confidence) / std::max(figures, 1));
  const bool below = band.low && x + wide < *band.low;
  const bool above = band.high && x - wide > *band.high;
  return below || above ? Verdict::fail : Verdict::undecided;
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

namespace {

/// @param of  null: nothing is known
std::string describe(const ClaimBand& band, const Evidence* of, Verdict verdict,
                     double confidence) {
  if (!of || !of->estimate)
    return fmt::format("{}: {}", band.label,
                       verdict == Verdict::notApplicable ? band.why
                       : of                              ? of->missing
                                                         : "");
  const std::string text =
      fmt::format("{} is {}", band.label, valueText(band, *of->estimate, of->of));
  if (verdict == Verdict::notApplicable) return fmt::format("{}, and {}", text, band.why);
  if (verdict == Verdict::pass) return text + ", " + bandText(band);
  if (verdict == Verdict::fail) return text + ", not " + bandText(band);
  const auto n = runsToDecide(band, *of->estimate, confidence);
  return text + ", which does not show whether it is " + bandText(band) +
         (n ? fmt::format("; about {} runs would", *n) : "");
}

}  // namespace

ClaimRow claimRow(const ClaimScope& scope, const std::map<std::string, Evidence>& found) {
  const ClaimRule& rule = scope.rule;
  const double confidence = scope.common("confidence");
  ClaimRow row;
  row.id = rule.id;
  row.claim = rule.claim;
  row.engine = scope.engine;
  row.mirror = scope.mirror;
  row.interpretation = scope.interpretation.label;
  row.plot = rule.figure;
  std::vector<CaseRun> runs;
  std::map<Verdict, std::vector<std::string>, std::greater<>> sentences;  // most severe first
  for (const ClaimBand& band : rule.figures) {
    const auto entry = found.find(band.name);
    const Evidence* const own = entry == found.end() ? nullptr : &entry->second;
    if (own) runs.insert(runs.end(), own->runs.begin(), own->runs.end());
    ClaimFigure& figure = row.figures.emplace_back(
        ClaimFigure{band.label, band.unit, {}, {}, band.low, band.high, band.name});
    if (own && own->estimate) {
      figure.value = own->estimate->value;
      figure.standardError = own->estimate->standardError;
    }
    if (!band.judged() && band.testable) continue;
    figure.verdict = !band.testable ? Verdict::notApplicable
                     : own && own->estimate
                         ? placeIn(band, *own->estimate, confidence, rule.judgedFigures())
                         : Verdict::undecided;
    sentences[*figure.verdict].push_back(describe(band, own, *figure.verdict, confidence));
  }
  row.verdict = sentences.begin()->first;  // a rule has a figure with a verdict
  // What holds as far as it goes is not reproduced while a part of it cannot be tested.
  if (row.verdict != Verdict::fail && sentences.contains(Verdict::notApplicable))
    row.verdict = Verdict::notApplicable;
  std::vector<std::string> parts;
  for (const auto& [verdict, own] : sentences) {
    std::string word(nameOf(verdict, claimVerdictNames));
    std::ranges::replace(word, '_', ' ');
    parts.push_back(fmt::format("{}: {}.", word, fmt::join(own, "; ")));
  }
  row.why = fmt::format("{}", fmt::join(parts, " "));
  if (runs.empty()) return row;
  row.why +=
      fmt::format(" Averaged over rotations {} since the ring had closed.", rotationsOf(runs));
  std::set<std::string> cases;
  for (const CaseRun& at : runs) cases.insert(at.setup->name);
  row.cases.assign(cases.begin(), cases.end());
  return row;
}

}  // namespace crossgrain::inline studies
