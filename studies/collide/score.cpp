#include "studies/collide/score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include <fmt/format.h>
#include <gsl/gsl_fit.h>

#include "adapters/declared_law.hpp"
#include "cases/collision_scene.hpp"
#include "law/law_options.hpp"
#include "oracle/impact.hpp"

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

namespace {

/// Why there is no discrete oracle, in a clause; empty where there is.
std::string whyNone(const Case& setup) {
  if (!setup.law.soft()) return "a rigid law has no discrete oracle";
  if (setup.bottom) return "the plate under the disks has no discrete oracle";
  return {};
}

/// The case with a single collision, head on.
Case headOn(const Case& setup) {
  Case one = setup;
  Collision& collision = collisionIn(one);
  const CollidingPair pair = collidingPair(setup);
  const double overlap = 0.01 * (pair.radius[0] + pair.radius[1]);
  collision.psi = {0.0};
  if (setup.law.stiffens()) {
    const double energy = elasticEnergy(setup.law, pair.reducedRadius(), overlap);
    collision.vn = {std::sqrt(2.0 * energy / pair.reducedMass())};
  } else {
    collision.vn = {overlap * std::numbers::pi / contactTime(setup.law, pair.reducedMass())};
  }
  collision.counterSpin = {0.0};
  collision.wallVelocity = Vec2::Zero();
  collision.startPhase = 0.25;
  // Nothing slips head on, and what Coulomb's force is where nothing slips rounding decides: all of
  // µ f_n to one side or the other. The other laws' forces vanish with the velocity.
  if (one.law.tangential == TangentialLaw::coulomb) one.law.tangential = TangentialLaw::none;
  return one;
}

/// The scheme by its name among the integrators of laws; absent if it is none of them.
std::optional<Integrator> integratorNamed(const std::string& name) {
  ContactLaw law;
  try {
    setLawOption(law, "integrator", name);
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
  return law.conventions.integrator;
}

/// Follows the disks along the line of centres.
class Follower {
 public:
  Follower(const Scene& scene, const CollidingPair& pair, double speed, double lag)
      : scene_(scene),
        pair_(pair),
        speed_(speed),
        lag_(lag),
        diameter_(2.0 * (pair.plane ? pair.radius[0] : std::min(pair.radius[0], pair.radius[1]))) {}

  double gap() const {
    const auto& x = scene_.disks.position;
    return (pair_.plane ? x[0].x() : x[0].x() - x[1].x()) - reach();
  }
  /// Every disk by itself, so that action and reaction are compared too.
  void compare(const DiscreteMotion& oracle, const Snapshot& now, SchemeScore& score) const {
    const bool halfStep = timeOfVelocities(now, lag_) < now.positionTime;
    const double velocity = halfStep ? oracle.halfStep : oracle.velocity;
    for (std::size_t side = 0; side < now.position.size(); ++side) {
      const double share = shareOf(side);
      raise(score.position,
            (now.position[side] - Vec2(centre() + share * (reach() + oracle.gap), 0.0)).norm() /
                diameter_);
      raise(score.velocity, (now.velocity[side] - Vec2(share * velocity, 0.0)).norm() / speed_);
    }
  }

 private:
  static void raise(std::optional<double>& largest, double value) {
    if (!std::isfinite(value)) value = std::numeric_limits<double>::infinity();
    largest = std::max(largest.value_or(0.0), value);
  }
  double reach() const { return pair_.radius[0] + pair_.radius[1]; }
  /// Of the distance of centres, and of the relative velocity.
  double shareOf(std::size_t side) const {
    if (pair_.plane) return 1.0;
    return (side == 0 ? 1.0 : -1.0) * pair_.reducedMass() / pair_.mass[side];
  }
  /// Of mass, where it is from start to end.
  double centre() const {
    if (pair_.plane) return 0.0;
    const auto& x = scene_.disks.position;
    return x[0].x() - shareOf(0) * (x[0].x() - x[1].x());
  }

  const Scene& scene_;
  const CollidingPair& pair_;
  double speed_, lag_, diameter_;
};

}  // namespace

SchemeScore schemeScore(Engine& engine, const EngineEntry& entry, const Case& setup, double dt) {
  SchemeScore score;
  if (score.reason = whyNone(setup); !score.reason.empty()) return score;
  const Case one = headOn(setup);
  const std::vector<CollisionStart> starts = collisionStarts(one);
  const CollidingPair pair = collidingPair(one);
  const Scene scene = collisionScene(one, starts, dt);
  const EffectiveParameters effective = loadScene(engine, entry, one, scene);
  score.scheme = effective.integrator;
  const Capabilities can = engine.capabilities();
  auto law =
      declaredLaw(can, sceneFor(can, entry, one, scene).scene, effective, pair.reducedMass());
  const auto integrator = integratorNamed(effective.integrator);
  if (!law || law->normal != setup.law.normal)
    score.reason = "its law is another one";
  else if (!integrator)
    score.reason = fmt::format("there is no discrete oracle of its scheme, {}", score.scheme);
  if (!score.reason.empty()) return score;
  law->conventions.integrator = *integrator;

  const double speed = starts.front().vn, step = effective.dt;
  const Follower follower(scene, pair, speed, effective.velocityLag);
  const double end = dt + 2.5 * impactTime(*law, {pair.reducedMass(), pair.reducedRadius(), speed});
  const auto steps = static_cast<std::size_t>(std::ceil(end / step));
  const auto motion =
      discreteImpact(*law, {follower.gap(), -speed, pair.reducedMass(), step, pair}, steps);
  for (std::size_t k = 1; k <= steps; ++k) {
    engine.advance(static_cast<double>(k) * step);
    follower.compare(motion[k], engine.snapshot(ContactReport::none), score);
  }
  if (effective.precision != "double") {
    score.reason = fmt::format("not judged: it runs in {} precision", effective.precision);
    return score;
  }
  score.limit = ownSchemeLimit;
  score.held = *score.position <= ownSchemeLimit && *score.velocity <= ownSchemeLimit;
  return score;
}

}  // namespace crossgrain::inline studies
