#include <fmt/format.h>

#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"
#include "reports/couette/compare_views.hpp"
#include "reports/couette/state_view.hpp"

namespace crossgrain::reports {

namespace {

/// "10 slabs of width 0.01 m along y", "1 bin"
std::string binsInWords(const CouetteFrame& frame) {
  const RegionRow& region = *frame.region;
  const std::size_t bins = frame.rings.r.size();
  if (region.bins == "whole") return "The whole box as one bin";
  if (region.bins == "grid") return fmt::format("A grid of {} bins", bins);
  return fmt::format("{} {} of width {} m{}", bins, region.bins, readable(frame.rings.width),
                     region.along.empty() ? "" : " along " + region.along);
}

}  // namespace

std::string averagesInWords(const CouetteFrame& frame) {
  if (frame.region)
    return fmt::format("{}, weights by {}, {} snapshots a run, {} to {} s after the start.",
                       binsInWords(frame), frame.averaging.method,
                       readableCount(static_cast<double>(frame.averaging.snapshots)),
                       readableSetting(frame.region->from), readableSetting(frame.region->to));
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
