#include "reports/collide/tally.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reports/common/numbers.hpp"

namespace crossgrain::reports {

void Worst::look(const CurveScore& score) {
  for (const CollisionQuantity& quantity : scoredQuantities()) {
    const auto& one = score.of[quantity.id];
    if (!one || !one->limit || one->max <= *one->limit * std::max(times, 1.0)) continue;
    times = one->max / *one->limit;
    symbol = quantity.label;
  }
}

std::string Worst::words() const {
  return fmt::format("{} {} × its limit", symbol, shortly(times));
}

namespace {

/// The clause that names what is missing, of "X cannot run FILE: CLAUSE; HINT".
std::string clauseOf(const std::string& refusal) {
  const auto colon = refusal.find(": ");
  const std::string rest = colon == std::string::npos ? refusal : refusal.substr(colon + 2);
  return rest.substr(0, rest.find("; "));
}

void addTo(Tally& tally, const CollisionCurve& curve) {
  tally.add(curve);
  const bool refused = curve.status == Status::refused;
  std::string& reason = refused ? tally.refusal : tally.reason;
  if (reason.empty()) reason = refused ? clauseOf(curve.reason) : curve.reason;
  const Verdict verdict = verdictOf(curve);
  if (verdict == Verdict::fail) tally.worst.look(declaredScore(curve));
  if (verdict == Verdict::modelDifference) tally.worstOfModel.look(curve.score);
  if (const auto own = ownDeviation(curve)) {
    tally.ownDeviation = std::max(tally.ownDeviation.value_or(0.0), *own);
    tally.ownPassed = tally.ownPassed && curve.ownScheme->held.value_or(true);
  }
}

}  // namespace

Tally tallyOf(const std::vector<const CollisionVariant*>& variants, const std::string& engine) {
  Tally tally;
  for (const CollisionVariant* variant : variants)
    for (const CollisionCurve* curve : curvesOf(*variant, engine)) addTo(tally, *curve);
  return tally;
}

std::vector<std::string> shortfalls(const Tally& tally) {
  std::vector<std::string> lines;
  if (tally.worst.times > 1.0) lines.push_back(tally.worst.words());
  if (tally.worstOfModel.times > 1.0) lines.push_back("model: " + tally.worstOfModel.words());
  if (!tally.ownPassed) lines.push_back(fmt::format("own scheme {}", shortly(tally.ownDeviation)));
  return lines;
}

}  // namespace crossgrain::reports
