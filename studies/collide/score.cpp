#include "studies/collide/score.hpp"

#include <fmt/format.h>
#include <gsl/gsl_fit.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace crossgrain::inline studies {

ErrorUnit errorUnit(const std::vector<double>& oracle, double zero) {
  if (oracle.empty()) return {ErrorUnitKind::absolute, 1.0};
  const auto [low, high] = std::ranges::minmax(oracle);
  const double range = high - low, magnitude = std::max(std::abs(low), std::abs(high));
  if (magnitude <= zero) return {ErrorUnitKind::absolute, 1.0};
  return range < 0.1 * magnitude ? ErrorUnit{ErrorUnitKind::magnitude, magnitude}
                                 : ErrorUnit{ErrorUnitKind::range, range};
}

bool mostAreKnown(const Outcomes& outcomes) {
  const auto known = std::ranges::count_if(outcomes, [](const auto& one) { return bool(one); });
  return 2 * static_cast<std::size_t>(known) >= outcomes.size();
}

namespace {

ErrorUnit errorUnitOf(const CollisionQuantity& quantity, const std::vector<double>& oracle) {
  using enum CollisionQuantity::Scored;
  if (quantity.scored == energyFraction) return {ErrorUnitKind::energyBefore, 1.0};
  if (quantity.scored == byLargest) return {ErrorUnitKind::magnitude, std::ranges::max(oracle)};
  return errorUnit(oracle, oracleIsGoodTo);
}

/// Absent where engine and oracle have no collision in common that has this quantity.
std::optional<QuantityScore> scoreQuantity(const Case& setup, const CollisionQuantity& quantity,
                                           const std::vector<CollisionStart>& starts,
                                           const Outcomes& found, const Outcomes& oracle,
                                           const CurveScore* units, double rounding) {
  const CollidingPair pair = collidingPair(setup);
  std::vector<double> expected;
  double largest = 0.0, squares = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const auto valueOf = [&](const Outcomes& outcomes) {
      return outcomes[k] ? quantity.scoredValue(*outcomes[k], pair, starts[k].vn) : std::nullopt;
    };
    const auto reference = quantity.always ? quantity.always : valueOf(oracle),
               value = valueOf(found);
    if (!reference) continue;
    expected.push_back(*reference);
    if (!value) continue;
    const double error = std::abs(*value - *reference);
    largest = std::max(largest, error);
    squares += error * error;
    ++count;
  }
  if (count == 0) return std::nullopt;
  const QuantityScore* given = units && units->of[quantity.id] ? &*units->of[quantity.id] : nullptr;
  const ErrorUnit unit =
      given ? ErrorUnit{given->unitIs, given->unit} : errorUnitOf(quantity, expected);
  QuantityScore score;
  score.max = largest / unit.value;
  score.rms = std::sqrt(squares / count) / unit.value;
  score.unit = unit.value;
  score.unitIs = unit.kind;
  const auto margin = collisionIn(setup).margins.find(std::string(quantity.name));
  if (!(quantity.always || mostAreKnown(oracle)) || margin == collisionIn(setup).margins.end())
    return score;
  score.limit = margin->second.relative ? margin->second.value : margin->second.value / unit.value;
  // Times, lengths and energies are scored as shares; others are of the approach's speed.
  const bool share = quantity.scored == CollisionQuantity::Scored::byLargest ||
                     quantity.scored == CollisionQuantity::Scored::energyFraction;
  const double rounded = share ? rounding : rounding / unit.value;
  if (score.max <= *score.limit || score.max > *score.limit + rounded)
    score.held = score.max <= *score.limit;
  score.why = margin->second.why;
  return score;
}

}  // namespace

CurveScore scoreSweep(const Case& setup, const std::vector<CollisionStart>& starts,
                      const Outcomes& found, const Outcomes& oracle, const CurveScore* units,
                      std::optional<double> rounding) {
  CurveScore score;
  score.rounding = rounding;
  const bool parts = rounding.value_or(0.0) < 1.0;  // what rounding holds fast does not part
  bool judged = false, held = true, open = false;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const bool sticks = oracle[k] && !oracle[k]->end.parted;
    const bool asItShould = found[k].has_value() != sticks;
    held = held && (asItShould || !parts);
    open = open || (!asItShould && !parts);
    judged = judged || (sticks && !collisionIn(setup).margins.empty());
  }
  for (const CollisionQuantity& quantity : scoredQuantities()) {
    auto& one = score.of[quantity.id] =
        scoreQuantity(setup, quantity, starts, found, oracle, units, rounding.value_or(0.0));
    open = open || (one && one->limit && !one->held);
    if (!one || !one->held) continue;
    judged = true;
    held = held && *one->held;
  }
  if (judged && !(held && open)) score.verdict = held ? Verdict::pass : Verdict::fail;
  return score;
}

namespace {

/// Of error ∝ dt^order: the slope in log–log, its error from three steps on.
std::optional<FittedOrder> fittedOrder(const std::map<double, double>& errorAt) {
  if (errorAt.size() < 2) return std::nullopt;
  std::vector<double> logStep, logError;
  for (const auto& [dt, error] : errorAt) {
    logStep.push_back(std::log(dt));
    logError.push_back(std::log(error));
  }
  double intercept = 0.0, slope = 0.0, var00 = 0.0, var01 = 0.0, var11 = 0.0, squares = 0.0;
  gsl_fit_linear(logStep.data(), 1, logError.data(), 1, logStep.size(), &intercept, &slope, &var00,
                 &var01, &var11, &squares);
  return FittedOrder{slope, logStep.size() > 2 ? std::optional(std::sqrt(var11)) : std::nullopt};
}

}  // namespace

std::optional<ConvergenceOrder> convergenceOrder(const std::vector<CollisionCurve>& curves) {
  ConvergenceOrder order;
  bool any = false;
  for (const CollisionQuantity& quantity : scoredQuantities()) {
    std::map<double, double> errorAt;
    for (const CollisionCurve& curve : curves)
      if (const auto& score = curve.score.of[quantity.id]; score && score->rms > 0.0)
        errorAt.emplace(curve.dt, score->rms);
    order.of[quantity.id] = fittedOrder(errorAt);
    any = any || order.of[quantity.id];
    if (quantity.id == QuantityId::psiF)
      for (const auto& [dt, error] : errorAt) order.errorAt[fmt::format("{:.4g}", dt)] = error;
  }
  if (!any) return std::nullopt;
  order.engine = curves.front().engine;
  return order;
}

}  // namespace crossgrain::inline studies
