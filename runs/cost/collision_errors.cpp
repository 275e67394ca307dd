#include "runs/cost/collision_errors.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases/loader.hpp"
#include "runs/cost/kept.hpp"

namespace crossgrain::inline runs {

std::vector<std::string> CollisionErrors::measures() const {
  std::vector<std::string> names;
  for (const QuantityId measure : collisionMeasures) {
    names.emplace_back(collisionQuantity(measure).name);
    names.push_back(ownOf(names.back()));
  }
  return names;
}

double CollisionErrors::predicted(std::size_t engine, const CostSetting& setting) const {
  const TimedEngine& timed = study_.engines[engine];
  const Cost& cost = study_.setup.cost;
  const double dt = study_.stepOf(engine, setting.setup);
  // 2.5 t_c and some steps, of fewer disks than the packing has: an upper bound.
  const double once = (2.5 * costContactTime(setting.setup) / dt + 21.0) * timed.step;
  return collisionPhases * once + cost.repeats * std::max(1.3 * cost.timed, once) +
         (collisionPhases + cost.repeats) * timed.load;
}

ReferenceCost CollisionErrors::referenceCost(const std::vector<bool>& anew, double) const {
  ReferenceCost cost{.own = std::vector<double>(anew.size(), 0.0)};
  // 2.5 t_c at the reference's step and at twice that: what it takes where there is no oracle.
  for (std::size_t e = 0; e < anew.size(); ++e)
    if (anew[e])
      cost.own[e] = 1.5 * 2.5 * study_.setup.cost.collisionReference * study_.engines[e].step;
  return cost;
}

void CollisionErrors::makeReferences() {
  reference_ = collisionReference(study_.setup);
}

std::vector<CostPoint> CollisionErrors::measure(const PlannedPoint& point) {
  limitOf(point.engine);
  return keptOr(study_.campaign.store(), study_.nameOf(point, 0), study_.keyOf(point, 0), [&] {
    return measureCollision(study_.workers.of(point.engine), study_.entryOf(point.engine),
                            study_.settingOf(point), reference_, limitOf(point.engine));
  });
}

const CollisionLimit& CollisionErrors::limitOf(std::size_t engine) {
  if (const auto found = limits_.find(engine); found != limits_.end()) return found->second;
  const EngineEntry& entry = study_.entryOf(engine);
  const Capabilities& can = *study_.campaign.capabilities(engine);
  return limits_[engine] = keptOr(
             study_.campaign.store(), "limit-collision-" + entry.name,
             study_.campaign.keyOf(engine, 0, "cost: collision limit"), [&] {
               const auto at = [&](double steps) {
                 return caseWith(study_.setup, stepFragment(study_.setup, entry.name, can, steps));
               };
               const double steps = study_.setup.cost.collisionReference;
               return collisionLimit(study_.workers.of(engine), entry, at(steps), at(steps / 2.0),
                                     reference_);
             });
}

void CollisionErrors::addTo(CostResults& results) const {
  results.references.push_back({.kind = kind(),
                                .engine = "oracle",
                                .setting = "the case's law",
                                .note = reference_.oracle.reason.empty()
                                            ? "planar two-body problem in continuous time, to 1e-9"
                                            : reference_.oracle.reason});
  for (const auto& [engine, limit] : limits_) {
    const std::string& name = study_.entryOf(engine).name;
    for (const auto& [measure, error] : limit.error)
      results.references.push_back({kind(), name, limit.setting, error,
                                    fmt::format("its own limit of small steps: {}", measure)});
    for (const auto& [measure, model] : limit.model) {
      const double unsure = limit.error.contains(measure) ? limit.error.at(measure) : 0.0;
      results.models.push_back(
          {name, kind(), measure, model, std::max(0.0, model - unsure), model + unsure});
    }
  }
}

}  // namespace crossgrain::inline runs
