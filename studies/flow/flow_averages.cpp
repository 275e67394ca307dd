#include "studies/flow/flow_averages.hpp"

#include "averaging/grid.hpp"
#include "averaging/rings.hpp"
#include "cases/flow.hpp"
#include "studies/flow/averages.hpp"
#include "studies/flow/region_averages.hpp"
#include "studies/flow/run.hpp"

namespace crossgrain::inline studies {

std::shared_ptr<const Coordinates> binsOf(const Case& setup) {
  if (!setup.average) return std::make_shared<Rings>(ringsOf(setup));
  const Region& region = setup.average->region;
  if (region.hasRings())
    return std::make_shared<Rings>(region.innerRadius, region.outerRadius, region.count,
                                   region.height, flowDiameter(setup));
  return std::make_shared<Grid>(region.low, region.high, region.columnCount(), region.rowCount(),
                                region.height);
}

std::unique_ptr<FlowAverages> flowAverages(const Case& setup, const Scene& scene) {
  if (setup.average) return std::make_unique<RegionAverages>(setup, scene);
  return std::make_unique<CouetteAverages>(setup, scene);
}

}  // namespace crossgrain::inline studies
