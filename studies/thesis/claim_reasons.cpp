// Why a claim is refuted, as far as that is found from the runs.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <list>
#include <map>
#include <set>

#include "averaging/regime.hpp"
#include "results/thesis_runs.hpp"
#include "studies/thesis/claims.hpp"
#include "support/numbers.hpp"

namespace crossgrain::inline studies {
namespace {

constexpr double aboutTheSame = 2.0;  ///< pressures within it are not said to have changed
constexpr std::size_t mostPlaces = 5;

/// Other runs that a claim can be judged by than those of its rule's interpretation.
struct Elsewhere {
  const ThesisResults* results = nullptr;
  Interpretation interpretation;  ///< label: "at ν̄ = 0.807 alone", "at Ω = 1 /s, rotations 2 to 3"
};

/// All there are of the default interpretation: runs of one regime, of one ν̄, and of cases of the
/// families "rate" and "time" by their rate and rotations.
/// @param ofRegimes  results made of the runs of one regime, which must outlive what is returned
std::vector<Elsewhere> elsewhereOf(const ThesisResults& results,
                                   std::list<ThesisResults>& ofRegimes) {
  std::vector<Elsewhere> all;
  for (const Regime regime : {Regime::flowing, Regime::blocked, Regime::collisional}) {
    ThesisResults own;
    own.cases = results.cases;
    own.surrogates = results.surrogates;
    for (const ThesisRun& run : results.runs)
      if (run.run.regime && run.run.regime->regime == regime) own.runs.push_back(run);
    if (own.runs.empty() || own.runs.size() == results.runs.size()) continue;
    const ThesisResults& kept = ofRegimes.emplace_back(std::move(own));
    all.push_back({&kept, interpretationsOf(kept).front()});
    all.back().interpretation.label = fmt::format("of runs that are {} alone", toString(regime));
  }
  const Interpretation standard = interpretationsOf(results).front();
  std::map<double, Interpretation> byLabel;
  for (const ThesisCase* setup : standard.judged) byLabel[setup->label].judged.push_back(setup);
  for (const ThesisCase* setup : standard.timed) byLabel[setup->label].timed.push_back(setup);
  if (byLabel.size() > 1)
    for (auto& [label, own] : byLabel) {
      own.label = fmt::format("at ν̄ = {:.3f} alone", label);
      all.push_back({&results, own});
    }
  if (standard.judged.empty()) return all;
  const ThesisCase& first = *standard.judged.front();
  const CaseSettings reference = settingsOf(first);
  std::map<std::string, Interpretation> byRateAndTime;
  for (const ThesisCase& setup : results.cases) {
    const CaseSettings own = settingsOf(setup);
    if ((!isOf(setup, "rate") && !isOf(setup, "time")) || !sameBut(nullptr, true, own, reference))
      continue;
    if (sameSetting(own.omega, reference.omega) && setup.settleRotations == first.settleRotations &&
        setup.averagedRotations == first.averagedRotations)
      continue;
    Interpretation& group =
        byRateAndTime[fmt::format("at {}, rotations {:g} to {:g}", describeRate(own),
                                  setup.settleRotations, setup.endRotation())];
    group.judged.push_back(&setup);
    group.timed.push_back(&setup);
  }
  for (auto& [label, own] : byRateAndTime) {
    own.label = label;
    all.push_back({&results, own});
  }
  return all;
}

const ClaimFigure* figureOf(const ClaimRow& row, std::string_view key) {
  const auto found = std::ranges::find(row.figures, key, &ClaimFigure::key);
  return found == row.figures.end() ? nullptr : &*found;
}

std::vector<const ThesisRun*> runsOfRow(const ThesisResults& results, const ClaimRow& row) {
  std::vector<const ThesisRun*> runs;
  for (const ThesisRun& run : results.runs)
    if (run.run.finished() && (run.engine == row.engine || run.engine == row.mirror) &&
        std::ranges::find(row.cases, run.setup) != row.cases.end())
      runs.push_back(&run);
  return runs;
}

std::string countText(std::size_t count, const char* noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

/// "Of its 9 runs 6 were collisional, 3 flowing while averaged."
std::string regimeReason(const std::vector<const ThesisRun*>& runs) {
  std::array<std::size_t, 3> of{};
  std::size_t known = 0;
  for (const ThesisRun* run : runs)
    if (run->run.regime && run->run.regime->regime) {
      ++of[static_cast<std::size_t>(*run->run.regime->regime)];
      ++known;
    }
  if (known == 0) return "";
  std::vector<std::string> parts;
  for (const Regime regime : {Regime::collisional, Regime::flowing, Regime::blocked})
    if (const std::size_t count = of[static_cast<std::size_t>(regime)])
      parts.push_back(fmt::format("{} {}{}", count,
                                  !parts.empty() ? ""
                                  : count == 1   ? "was "
                                                 : "were ",
                                  toString(regime)));
  std::string sentence = fmt::format("Of its {} {} while averaged", countText(runs.size(), "run"),
                                     fmt::join(parts, ", "));
  if (2 * of[static_cast<std::size_t>(Regime::collisional)] > known)
    sentence += ", most in the regime in which stress comes from impacts and goes with Ω²";
  return sentence + ".";
}

/// How the outer pressure's last rotation compares with the first, in the median over runs.
std::string pressureReason(const std::vector<const ThesisRun*>& runs) {
  std::vector<RingValue> ratios;
  double to = 0.0;
  for (const ThesisRun* run : runs) {
    if (run->history.size() < 2) continue;
    const ThesisSpan &first = run->history.front(), &last = run->history.back();
    if (!first.outerPressure || !last.outerPressure || !(*first.outerPressure > 0.0)) continue;
    ratios.push_back({0, 0.0, 0.0, *last.outerPressure / *first.outerPressure});
    to = std::max(to, last.to);
  }
  const auto median = medianOf(ratios);
  if (!median || (*median <= aboutTheSame && *median >= 1.0 / aboutTheSame)) return "";
  return fmt::format(
      "The state was not the same all the time: the outer pressure of the last rotation (up to "
      "{:g}) is {} times that of the first, in the median of {}.",
      to, readable(median), countText(ratios.size(), "run"));
}

/// A row of the same claim by other runs, and what those are.
struct OtherRow {
  std::string label;
  ClaimRow row;
};

/// Up to so many of them, and how many more.
std::string placesText(std::vector<std::string> places) {
  const std::size_t all = places.size();
  if (all > mostPlaces) places.resize(mostPlaces);
  std::string text = fmt::format("{}", fmt::join(places, "; "));
  if (all > mostPlaces) text += fmt::format("; and {} more", all - mostPlaces);
  return text;
}

/// Of one refuted figure: where the same rule has it in its band.
std::string elsewhereReason(const ClaimFigure& figure, const std::vector<OtherRow>& others) {
  std::vector<std::string> places;
  std::size_t judged = 0;
  for (const OtherRow& other : others) {
    const ClaimFigure* const there = figureOf(other.row, figure.key);
    if (!there || !there->value || !there->verdict) continue;
    if (there->value == figure.value && there->value != 0.0) continue;  // of the same runs
    ++judged;
    if (*there->verdict != Verdict::pass) continue;
    const std::string unit = there->unit.empty() ? "" : " " + there->unit;
    places.push_back(
        fmt::format("{} ({}{})", other.label, readable(there->value, there->standardError), unit));
  }
  if (judged == 0) return "";
  if (places.empty())
    return fmt::format("{} is shown in its band by none of {} that it was judged by.", figure.name,
                       countText(judged, "other set") + " of runs");
  return fmt::format("{} lies in its band {}.", figure.name, placesText(places));
}

std::vector<std::string> elsewhereReasons(const ClaimRow& row,
                                          const std::vector<OtherRow>& others) {
  std::vector<std::string> sentences, whole;
  for (const OtherRow& other : others)
    if (other.row.verdict == Verdict::pass) whole.push_back(other.label);
  if (!whole.empty())
    sentences.push_back(fmt::format("The whole claim is reproduced {}.", placesText(whole)));
  for (const ClaimFigure& figure : row.figures)
    if (figure.verdict == Verdict::fail) sentences.push_back(elsewhereReason(figure, others));
  return sentences;
}

/// A claim of collisions by the law itself, and at the engine's other time steps.
void addOtherSteps(const ThesisResults& results, const ClaimRules& rules,
                   const std::vector<ClaimRow>& rows, const ClaimRow& row,
                   std::vector<OtherRow>& others) {
  if (!results.collisions || row.engine == "-") return;
  const auto same = [&](const ClaimRow& each) {
    return each.id == row.id && each.interpretation == row.interpretation;
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
    // The default interpretation's row comes first.
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

bool holds(const ClaimReason& reason, const ClaimRow& row, const std::vector<ClaimRow>& rows) {
  return reason.claim == row.id && (reason.engine.empty() || reason.engine == row.engine) &&
         std::ranges::all_of(reason.when, [&](const ReasonCondition& condition) {
           return holds(condition, row, rows);
         });
}

}  // namespace

void addReasons(const ThesisResults& results, const ClaimRules& rules, const ClaimReasons& found,
                std::vector<ClaimRow>& rows) {
  std::list<ThesisResults> ofRegimes;
  const std::vector<Elsewhere> elsewhere = elsewhereOf(results, ofRegimes);
  for (ClaimRow& row : rows) {
    row.reasons.clear();
    if (row.verdict != Verdict::fail) continue;
    const auto sameClaim = [&](const ClaimRow& each) {
      return each.id == row.id && each.engine == row.engine;
    };
    std::vector<OtherRow> others;
    for (const ClaimRow& each : rows)
      if (&each != &row && sameClaim(each))
        others.push_back({"under " + each.interpretation, each});
    if (row.id == "C1") addOtherSteps(results, rules, rows, row, others);
    const bool standard = &*std::ranges::find_if(rows, sameClaim) == &row;
    if (standard)
      for (const Elsewhere& where : elsewhere)
        if (auto other = judgeClaim(*where.results, rules, row.id, row.engine, row.mirror,
                                    where.interpretation);
            other && !other->cases.empty())
          others.push_back({where.interpretation.label, std::move(*other)});
    const std::vector<const ThesisRun*> runs = runsOfRow(results, row);
    std::vector<std::string> reasons = elsewhereReasons(row, others);
    reasons.insert(reasons.begin(), {regimeReason(runs), pressureReason(runs)});
    std::erase(reasons, "");
    for (const ClaimReason& reason : found.reasons)
      if (holds(reason, row, rows))
        reasons.push_back(fmt::format("{} (Rests on {}.)", reason.text, reason.evidence));
    row.reasons = std::move(reasons);
  }
}

}  // namespace crossgrain::inline studies
