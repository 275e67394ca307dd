#include <fmt/format.h>

#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"
#include "reports/couette/compare_views.hpp"
#include "reports/couette/state_view.hpp"

namespace crossgrain::reports {

std::string averagesInWords(const CouetteFrame& frame) {
  const std::string when = averagedRotations(frame.averaging);
  return fmt::format("{} rings of width {} m, weights by {}, {} snapshots a run{}.",
                     frame.rings.r.size(), readable(frame.rings.width), frame.averaging.method,
                     readableCount(static_cast<double>(frame.averaging.snapshots)),
                     when.empty() ? std::string() : ", " + when);
}

std::vector<RealisedScene> realisedOf(const CouetteFrame& frame,
                                      const std::vector<EngineRuns>& engines) {
  std::vector<RealisedScene> realised;
  for (const EngineRuns& engine : engines)
    if (engine.realised()) realised.push_back({engine.name, engine.realised(), &frame.effects});
  return realised;
}

Json studyView(const CouetteStudy& study, const Illustrations& shown) {
  return commonView(study.head, study.elapsed, study.notes, shown);
}

}  // namespace crossgrain::reports
