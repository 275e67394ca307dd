#include "runs/couette/frame.hpp"

#include <algorithm>
#include <cmath>

#include "cases/effect_switch.hpp"
#include "runs/common/head.hpp"
#include "runs/couette/run.hpp"

namespace crossgrain::inline runs {

namespace {

CouetteCell cellOf(const Case& setup, const Disks& disks) {
  const Cell& cell = setup.cell;
  const auto small =
      static_cast<std::size_t>(std::ranges::count(disks.radius, setup.particles.smallRadius));
  double diskArea = 0.0;
  for (const double a : disks.radius) diskArea += a * a;
  const double cellArea = cell.outerRadius * cell.outerRadius - cell.innerRadius * cell.innerRadius;
  return {cell.innerRadius,
          cell.outerRadius,
          cell.wallRadius,
          cell.wallSpacing,
          cell.height,
          cell.omega,
          small,
          disks.size() - small,
          setup.particles.smallRadius,
          setup.particles.largeRadius,
          diskArea / cellArea,
          2.0 * setup.particles.smallRadius};
}

CouetteAveraging averagingOf(const Case& setup) {
  const Averaging& averaging = setup.averaging;
  CouetteAveraging result;
  result.method = averaging.methods.front();
  result.settleRotations = result.fromRotation = averaging.settleRotations;
  result.rotations = averaging.rotations;
  result.toRotation = averaging.settleRotations + averaging.rotations;
  // Nobody knows how long a packing of the user's own has been sheared.
  if (!setup.particles.file) result.preparedRotations = setup.preparation.rotations;
  result.snapshots = std::lround(averaging.snapshotsPerRotation * averaging.rotations);
  result.confidence = averaging.confidence;
  return result;
}

}  // namespace

RingPlaces placesOf(const Rings& rings) {
  RingPlaces places;
  for (int ring = 0; ring < rings.count(); ++ring) {
    places.r.push_back(rings.centre(ring));
    places.rTilde.push_back(rings.rTilde(ring));
  }
  places.width = rings.edge(1) - rings.edge(0);
  return places;
}

CouetteFrame couetteFrame(std::string_view kind, const Case& setup, const std::string& command,
                          const Disks& disks) {
  CouetteFrame frame;
  frame.head = headOf(kind, setup, command);
  frame.cell = cellOf(setup, disks);
  frame.averaging = averagingOf(setup);
  for (const Effect effect : effectsOf(setup)) frame.effects.emplace_back(toString(effect));
  frame.rings = placesOf(ringsOf(setup));
  return frame;
}

}  // namespace crossgrain::inline runs
