#include "runs/cost/collision_limit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapters/declared_law.hpp"
#include "cases/time_step.hpp"
#include "runs/cost/collision.hpp"

namespace crossgrain::inline runs {

namespace {

/// The law that the engine declares for the collision; absent where nobody can tell its constants.
std::optional<ContactLaw> lawDeclared(Engine& engine, const EngineEntry& entry, const Case& pair,
                                      double dt, const std::vector<CollisionStart>& starts) {
  const Scene scene = collisionScene(pair, starts, dt);
  const Realised realised = loadScene(engine, entry, pair, scene);
  const Capabilities can = engine.capabilities();
  return declaredLaw(can, sceneFor(can, entry, pair, scene).scene, realised,
                     collidingPair(pair).reducedMass());
}

CollisionNumbers endsOf(const CollisionTable& table) {
  CollisionNumbers numbers;
  for (const QuantityId quantity : collisionMeasures)
    numbers[std::string(collisionQuantity(quantity).name)] = numbersOf(table, quantity);
  return numbers;
}

std::string stepsInWords(const Case& setup, double dt) {
  return fmt::format("t_c/{:g}", std::round(costContactTime(setup) / dt));
}

}  // namespace

std::vector<std::optional<double>> numbersOf(const CollisionTable& table, QuantityId quantity) {
  std::vector<std::optional<double>> numbers;
  for (std::size_t k = 0; k < table.size(); ++k) numbers.push_back(table.at(quantity, k));
  return numbers;
}

std::optional<double> rmsDifference(const std::vector<std::optional<double>>& numbers,
                                    const std::vector<std::optional<double>>& from, double unit) {
  double squares = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < std::min(numbers.size(), from.size()); ++k) {
    if (!from[k]) continue;
    if (!numbers[k]) return std::nullopt;
    squares += (*numbers[k] - *from[k]) * (*numbers[k] - *from[k]);
    ++count;
  }
  return count > 0 ? std::optional(std::sqrt(squares / count) / unit) : std::nullopt;
}

double unitOf(const CollisionReference& reference, QuantityId quantity) {
  std::vector<double> known;
  for (const auto& number :
       numbersOf(tableOf(reference.starts, referenceOf(reference.oracle)), quantity))
    if (number) known.push_back(*number);
  return errorUnit(known).value;
}

CollisionLimit collisionLimit(Engine& engine, const EngineEntry& entry, const Case& fine,
                              const Case& coarse, const CollisionReference& reference) {
  const Case pair = collisionOf(fine);
  CollisionLimit limit;
  CollisionNumbers half;
  OracleCurve declared;
  if (const auto law = lawDeclared(engine, entry, pair, timeStep(fine), reference.starts)) {
    Case own = pair;
    own.law = *law;
    declared = oracleCurve(own, reference.starts);
  }
  const bool known = std::ranges::any_of(declared.ends, [](const auto& end) { return bool(end); });
  if (known) {
    limit.setting = "oracle of the law that it declares";
    limit.ends = half = endsOf(tableOf(reference.starts, referenceOf(declared)));
  } else {
    for (const auto& [setup, numbers] :
         {std::pair(&coarse, &half), std::pair(&fine, &limit.ends)}) {
      const CollisionCurve sweep = runSweep(engine, entry, collisionOf(*setup), timeStep(*setup),
                                            reference.starts, reference.oracle, /*watch=*/false);
      limit.setting = stepsInWords(*setup, sweep.dt);
      if (sweep.status != SweepStatus::finished)
        return {limit.setting, {}, {}, {}, fmt::format("at {} {}", limit.setting, sweep.reason)};
      *numbers = endsOf(sweep.points);
    }
  }
  const CollisionNumbers scene = endsOf(tableOf(reference.starts, referenceOf(reference.oracle)));
  for (const QuantityId quantity : collisionMeasures) {
    const std::string name(collisionQuantity(quantity).name);
    const double unit = unitOf(reference, quantity);
    if (const auto error = rmsDifference(limit.ends[name], half[name], unit))
      limit.error[name] = *error;
    if (const auto model = rmsDifference(limit.ends[name], scene.at(name), unit))
      limit.model[name] = *model;
  }
  return limit;
}

}  // namespace crossgrain::inline runs
