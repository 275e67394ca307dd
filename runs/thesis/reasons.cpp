#include "runs/thesis/reasons.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "averaging/regime.hpp"
#include "reports/common/numbers.hpp"
#include "runs/thesis/claims.hpp"
#include "runs/thesis/elsewhere.hpp"

namespace crossgrain::inline runs {
namespace {

constexpr double aboutTheSame = 2.0;  ///< pressures within it are not said to have changed
constexpr std::size_t mostPlaces = 5;

const ClaimFigure* figureOf(const ClaimRow& row, std::string_view key) {
  const auto found = std::ranges::find(row.figures, key, &ClaimFigure::key);
  return found == row.figures.end() ? nullptr : &*found;
}

std::vector<const ThesisRun*> runsOfRow(const ThesisResults& results, const ClaimRow& row) {
  std::vector<const ThesisRun*> runs;
  for (const ThesisRun& run : results.runs)
    if (run.run.finished() && (run.engine == row.engine || run.engine == row.carrier) &&
        std::ranges::find(row.legs, run.leg) != row.legs.end())
      runs.push_back(&run);
  return runs;
}

std::string counted(std::size_t count, const char* noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

/// "Of the 9 runs of its legs 6 were collisional, 3 flowing while they were averaged."
std::string regimeSentence(const std::vector<const ThesisRun*>& runs) {
  std::array<std::size_t, 3> of{};
  std::size_t told = 0;
  for (const ThesisRun* run : runs)
    if (run->run.regime && run->run.regime->regime) {
      ++of[static_cast<std::size_t>(*run->run.regime->regime)];
      ++told;
    }
  if (told == 0) return "";
  std::vector<std::string> parts;
  for (const Regime regime : {Regime::collisional, Regime::flowing, Regime::blocked})
    if (const std::size_t count = of[static_cast<std::size_t>(regime)])
      parts.push_back(parts.empty() ? fmt::format("{} {} {}", count, count == 1 ? "was" : "were",
                                                  toString(regime))
                                    : fmt::format("{} {}", count, toString(regime)));
  std::string sentence = fmt::format("Of the {} of its legs {} while averaged",
                                     counted(runs.size(), "run"), fmt::join(parts, ", "));
  if (2 * of[static_cast<std::size_t>(Regime::collisional)] > told)
    sentence += ", most in the regime in which stress comes from impacts and goes with Ω²";
  return sentence + ".";
}

/// How the outer pressure's last rotation compares to the first, in the median over runs.
std::string pressureSentence(const std::vector<const ThesisRun*>& runs) {
  std::vector<double> ratios;
  double from = 0.0, to = 0.0;
  for (const ThesisRun* run : runs) {
    if (run->history.size() < 2) continue;
    const ThesisSpan &first = run->history.front(), &last = run->history.back();
    if (!first.outerPressure || !last.outerPressure || !(*first.outerPressure > 0.0)) continue;
    ratios.push_back(*last.outerPressure / *first.outerPressure);
    from = std::max(from, first.to);
    to = std::max(to, last.to);
  }
  if (ratios.empty()) return "";
  std::ranges::sort(ratios);
  const std::size_t half = ratios.size() / 2;
  const double median =
      ratios.size() % 2 == 1 ? ratios[half] : 0.5 * (ratios[half - 1] + ratios[half]);
  if (median <= aboutTheSame && median >= 1.0 / aboutTheSame) return "";
  return fmt::format(
      "The state was not the same all the time: the outer pressure of the last rotation (up to "
      "{:g}) "
      "is {} times that of the first, in the median of {}.",
      to, reports::readable(median), counted(ratios.size(), "run"));
}

/// A row of the same claim by other runs, and what those are.
struct OtherRow {
  std::string words;
  ClaimRow row;
};

std::string valueWords(const ClaimFigure& figure) {
  std::string words = reports::readable(figure.value, figure.standardError);
  if (!figure.unit.empty()) words += " " + figure.unit;
  return words;
}

/// Up to so many of them, and how many more.
std::string placesOf(std::vector<std::string> places) {
  const std::size_t all = places.size();
  if (all > mostPlaces) places.resize(mostPlaces);
  std::string words = fmt::format("{}", fmt::join(places, "; "));
  if (all > mostPlaces) words += fmt::format("; and {} more", all - mostPlaces);
  return words;
}

/// Of one refuted figure: where the same rule has it in its band.
std::string elsewhereSentence(const ClaimFigure& figure, const std::vector<OtherRow>& others) {
  std::vector<std::string> places;
  std::size_t judged = 0;
  for (const OtherRow& other : others) {
    const ClaimFigure* const there = figureOf(other.row, figure.key);
    if (!there || !there->value || !there->verdict) continue;
    if (there->value == figure.value && there->value != 0.0) continue;  // of the same runs
    ++judged;
    if (*there->verdict == ClaimVerdict::reproduced)
      places.push_back(fmt::format("{} ({})", other.words, valueWords(*there)));
  }
  if (judged == 0) return "";
  if (places.empty())
    return fmt::format("{} is shown in its band by none of {} that it was judged by.", figure.name,
                       counted(judged, "other set") + " of runs");
  return fmt::format("{} lies in its band {}.", figure.name, placesOf(places));
}

std::vector<std::string> elsewhereSentences(const ClaimRow& row,
                                            const std::vector<OtherRow>& others) {
  std::vector<std::string> sentences, whole;
  for (const OtherRow& other : others)
    if (other.row.verdict == ClaimVerdict::reproduced) whole.push_back(other.words);
  if (!whole.empty())
    sentences.push_back(fmt::format("The whole claim is reproduced {}.", placesOf(whole)));
  for (const ClaimFigure& figure : row.figures)
    if (figure.verdict == ClaimVerdict::refuted)
      if (const std::string sentence = elsewhereSentence(figure, others); !sentence.empty())
        sentences.push_back(sentence);
  return sentences;
}

/// A claim of collisions by the law itself, and at the engine's other time steps.
void addOtherSteps(const ThesisResults& results, const ClaimRules& rules,
                   const std::vector<ClaimRow>& rows, const ClaimRow& row,
                   std::vector<OtherRow>& others) {
  if (!results.collisions || row.engine == "-") return;
  const auto same = [&](const ClaimRow& each) {
    return each.id == row.id && each.reading == row.reading;
  };
  for (const ClaimRow& each : rows)
    if (each.engine == "-" && same(each)) others.push_back({"of the law in continuous time", each});
  std::set<double> steps;
  for (const CollisionVariant& variant : results.collisions->variants)
    for (const CollisionCurve& curve : variant.curves)
      if (curve.engine == row.engine && curve.stepsPerContact) steps.insert(*curve.stepsPerContact);
  for (const double each : steps)
    for (ClaimRow& other : judgeCollisions(*results.collisions, rules, each))
      if (other.engine == row.engine && same(other))
        others.push_back({fmt::format("at {:.0f} steps per contact", each), std::move(other)});
}

bool holds(const ReasonCondition& condition, const ClaimRow& row,
           const std::vector<ClaimRow>& rows) {
  const ClaimRow* of = &row;
  if (condition.claim != row.id) {
    // The default reading's row comes first.
    const auto found = std::ranges::find_if(rows, [&](const ClaimRow& each) {
      return each.id == condition.claim && (each.engine == row.engine || each.engine == "-");
    });
    if (found == rows.end()) return false;
    of = &*found;
  }
  const ClaimFigure* const figure = figureOf(*of, condition.figure);
  if (!figure || !figure->value) return false;
  return (!condition.above || *figure->value > *condition.above) &&
         (!condition.below || *figure->value < *condition.below);
}

std::vector<std::string> foundSentences(const ClaimReasons& found, const ClaimRow& row,
                                        const std::vector<ClaimRow>& rows) {
  std::vector<std::string> sentences;
  for (const ClaimReason& reason : found.reasons) {
    if (reason.claim != row.id || (!reason.engine.empty() && reason.engine != row.engine)) continue;
    if (!std::ranges::all_of(reason.when, [&](const ReasonCondition& condition) {
          return holds(condition, row, rows);
        }))
      continue;
    sentences.push_back(fmt::format("{} (Rests on {}.)", reason.text, reason.evidence));
  }
  return sentences;
}

}  // namespace

void addReasons(const ThesisResults& results, const ClaimRules& rules, const ClaimReasons& found,
                std::vector<ClaimRow>& rows) {
  const OtherRuns otherRuns(results);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    ClaimRow& row = rows[k];
    row.reasons.clear();
    if (row.verdict != ClaimVerdict::refuted) continue;
    const auto sameClaim = [&](const ClaimRow& each) {
      return each.id == row.id && each.engine == row.engine;
    };
    std::vector<OtherRow> others;
    for (std::size_t j = 0; j < rows.size(); ++j)
      if (j != k && sameClaim(rows[j])) others.push_back({"under " + rows[j].reading, rows[j]});
    if (row.id == "C1") addOtherSteps(results, rules, rows, row, others);
    const bool standard =
        std::ranges::find_if(rows, sameClaim) == rows.begin() + static_cast<std::ptrdiff_t>(k);
    if (standard)
      for (const Elsewhere& where : otherRuns.all())
        if (auto other =
                judgeClaim(*where.results, rules, row.id, row.engine, row.carrier, where.reading);
            other && !other->legs.empty())
          others.push_back({where.words, std::move(*other)});
    const std::vector<const ThesisRun*> runs = runsOfRow(results, row);
    for (const std::string& sentence : {regimeSentence(runs), pressureSentence(runs)})
      if (!sentence.empty()) row.reasons.push_back(sentence);
    for (const auto& sentences :
         {elsewhereSentences(row, others), foundSentences(found, row, rows)})
      row.reasons.insert(row.reasons.end(), sentences.begin(), sentences.end());
  }
}

}  // namespace crossgrain::inline runs
