#include "results/collision.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "support/numbers.hpp"

namespace crossgrain::inline results {

bool CollisionCurve::allParted() const {
  for (std::size_t k = 0; k < points.size(); ++k)
    if (!points.parted(k) && points.shouldPart(k)) return false;
  return true;
}

std::string CollisionCurve::statusName() const {
  return std::string(nameOf(std::pair(status, allParted()), sweepStatusNames));
}

const CurveScore& declaredScore(const CollisionCurve& curve) {
  if (!curve.declared) return curve.score;
  const CurveScore& own = curve.declared->score;
  return own.verdict != Verdict::notMeasured || own.isRounded() ? own : curve.score;
}

std::optional<double> ownDeviation(const CollisionCurve& curve) {
  if (!curve.ownScheme || !curve.ownScheme->position || !curve.ownScheme->velocity)
    return std::nullopt;
  return std::max(*curve.ownScheme->position, *curve.ownScheme->velocity);
}

Verdict verdictOf(const CollisionCurve& curve) {
  using enum Verdict;
  if (curve.status == Status::refused) return notApplicable;
  if (curve.status == Status::failed) return fail;
  if (curve.ownScheme && curve.ownScheme->held == false) return fail;
  const Verdict scene = curve.score.verdict, own = declaredScore(curve).verdict;
  const bool isTheLaw = curve.declared && curve.declared->reference == DeclaredReference::itself;
  if (own == notMeasured) return notMeasured;
  if (own == fail && !isTheLaw) return fail;
  return scene == fail ? modelDifference : pass;
}

std::string outcomeName(const CollisionCurve& curve) {
  constexpr support::EnumNames<Verdict, 5> names{{{Verdict::pass, "held"},
                                                  {Verdict::modelDifference, "model difference"},
                                                  {Verdict::fail, "fell short"},
                                                  {Verdict::notMeasured, "not judged"},
                                                  {Verdict::notApplicable, "refused"}}};
  return curve.status == Status::failed ? "failed" : std::string(nameOf(verdictOf(curve), names));
}

void WorstQuantity::take(const CurveScore& score) {
  for (const CollisionQuantity& quantity : scoredQuantities()) {
    const auto& one = score.of[quantity.id];
    if (!one || !one->limit || one->max <= *one->limit * std::max(times, 1.0)) continue;
    times = one->max / *one->limit;
    symbol = quantity.label;
  }
}

std::string WorstQuantity::words() const {
  if (times == 0.0) return {};
  return fmt::format("{} {} × its limit", symbol, shortly(times));
}

bool runsBesideItsPeer(const CollideResults& results, const std::string& engine) {
  const auto row = std::ranges::find(results.engines, engine, &EngineRow::name);
  return row != results.engines.end() && !row->mirrors.empty() &&
         std::ranges::find(results.engines, row->mirrors, &EngineRow::name) !=
             results.engines.end();
}

void SweepCount::add(const CollisionCurve& curve) {
  const bool ran = curve.status != Status::failed;
  const Verdict verdict = verdictOf(curve);
  failed += !ran;
  held += verdict == Verdict::pass;
  modelDifference += verdict == Verdict::modelDifference;
  beyondLimits += ran && verdict == Verdict::fail;
  notJudged += verdict == Verdict::notMeasured;
  refused += verdict == Verdict::notApplicable;
  if (!ran || verdict == Verdict::notMeasured) return;
  const CollisionPoints& table = curve.points;
  points += table.size();
  const bool most = table.mostAreKnown(), byScene = curve.score.verdict != Verdict::notMeasured;
  for (std::size_t row = 0; row < table.size(); ++row)
    judgedPoints += !byScene || (table.isKnown(row) && (most || !table.shouldPart(row)));
}

SweepCount countOf(const CollideResults& results) {
  SweepCount count;
  for (const CollisionVariant& variant : results.variants)
    for (const CollisionCurve& curve : variant.curves)
      if (curve.status == Status::failed || !runsBesideItsPeer(results, curve.engine))
        count.add(curve);
  return count;
}

std::string nothingJudged(const CollideResults& results) {
  if (countOf(results).judged() > 0) return {};
  bool measured = false, outcome = false, noLimit = false, rounded = false;
  bool convex = false, mostKnown = false;
  std::string noOracle;
  for (const CollisionVariant& variant : results.variants) {
    if (noOracle.empty()) noOracle = variant.oracleReason;
    noLimit = noLimit || !variant.noLimit.empty();
    convex = convex || variant.convex;
    for (const CollisionCurve& curve : variant.curves) {
      rounded = rounded || curve.score.isRounded();
      for (std::size_t k = 0; k < curve.points.size(); ++k)
        outcome = outcome || curve.points.parted(k);
      mostKnown = mostKnown || curve.points.mostAreKnown();
      for (const CollisionQuantity& quantity : scoredQuantities())
        measured = measured || curve.score.of[quantity.id];
    }
  }
  if (rounded)
    return "what is beyond a limit single precision can do by rounding places; a faster approach "
           "or a larger time step is needed to tell";
  if (measured && mostKnown) return "the case has no [collision.margins] for what was measured";
  if (!noOracle.empty()) return "there is no oracle to judge by: " + noOracle;
  if (noLimit && outcome && convex)
    return "at most points of the sweep Newton's, Poisson's and Stronge's restitution differ, and "
           "the case has no margin of energy_gained";
  if (noLimit && outcome)
    return "at most points of the sweep there is no reference: the law has no limit of small time "
           "steps there, or jumps beside it";
  return "no engine has an outcome to judge";
}

}  // namespace crossgrain::inline results
