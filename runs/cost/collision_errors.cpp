#include "runs/cost/collision_errors.hpp"

#include <algorithm>

#include "runs/cost/kept.hpp"

namespace crossgrain::inline runs {

std::vector<std::string> CollisionErrors::measures() const {
  return {std::begin(collisionMeasures), std::end(collisionMeasures)};
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

void CollisionErrors::makeReferences() {
  reference_ = collisionReference(study_.setup);
}

std::vector<CostPoint> CollisionErrors::measure(const PlannedPoint& point) {
  return keptOr(study_.campaign.store(), study_.nameOf(point, 0), study_.keyOf(point, 0), [&] {
    return measureCollision(study_.workers.of(point.engine), study_.entryOf(point.engine),
                            study_.settingOf(point), reference_);
  });
}

void CollisionErrors::addTo(CostResults& results) const {
  results.references.push_back({.kind = kind(),
                                .engine = "oracle",
                                .setting = "the case's law",
                                .note = reference_.oracle.reason.empty()
                                            ? "planar two-body problem in continuous time, to 1e-9"
                                            : reference_.oracle.reason});
}

}  // namespace crossgrain::inline runs
