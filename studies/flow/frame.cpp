#include "studies/flow/frame.hpp"

#include <algorithm>
#include <cmath>

#include "averaging/grid.hpp"
#include "averaging/space_rings.hpp"
#include "cases/effect_switch.hpp"
#include "cases/flow.hpp"
#include "studies/core/study.hpp"
#include "studies/flow/averages.hpp"
#include "studies/flow/run.hpp"

namespace crossgrain::inline studies {

namespace {

CouetteCell cellRow(const Couette& source, std::span<const double> radii) {
  const auto& [cell, particles, filling, times] = source;
  const auto small = static_cast<std::size_t>(std::ranges::count(radii, particles.smallRadius));
  double diskArea = 0.0;
  for (const double a : radii) diskArea += a * a;
  const double cellArea = cell.outerRadius * cell.outerRadius - cell.innerRadius * cell.innerRadius;
  return {cell.innerRadius,
          cell.outerRadius,
          cell.wallRadius,
          cell.wallSpacing,
          cell.height,
          cell.omega,
          small,
          radii.size() - small,
          particles.smallRadius,
          particles.largeRadius,
          diskArea / cellArea,
          2.0 * particles.smallRadius};
}

RegionRow regionRow(const Case& setup, std::size_t disks) {
  const Region& region = *setup.region;
  RegionRow row;
  row.bins = binKindNames[static_cast<std::size_t>(region.bins)];
  if (region.bins == BinKind::slabs)
    row.along = std::string_view("xyz").substr(static_cast<std::size_t>(region.axis), 1);
  row.height = region.height;
  row.diameter = flowDiameter(setup);
  row.disks = disks;
  const auto bins = binsOf(setup);
  if (const auto* grid = dynamic_cast<const Grid*>(bins.get()))
    for (int cell = 0; cell < grid->cells(); ++cell) {
      row.x.push_back(grid->centre(cell).x());
      row.y.push_back(grid->centre(cell).y());
    }
  if (const auto* cells = dynamic_cast<const Cells*>(bins.get()))
    for (int cell = 0; cell < cells->cells(); ++cell) {
      const Vec3 centre = cells->centre(cell);
      row.x.push_back(centre.x());
      row.y.push_back(centre.y());
      row.z.push_back(centre.z());
    }
  if (const auto* rings = dynamic_cast<const SpaceRings*>(bins.get()))
    for (int bin = 0; bin < rings->rings().count() * rings->layers().count(); ++bin)
      row.z.push_back(rings->layers().centre(bin / rings->rings().count()));
  const FlowTimes times = flowTimes(setup);
  row.from = times.settled;
  row.to = times.end();
  return row;
}

FlowAveraging averagingOf(const Case& setup) {
  FlowAveraging result;
  result.method = setup.averaging.methods.front();
  result.confidence = setup.averaging.confidence;
  result.snapshots = flowTimes(setup).samples;
  const Couette* const cell = cellOf(setup);
  if (!cell) return result;  // timed in seconds: see RegionRow
  result.settleRotations = result.fromRotation = cell->times.settleRotations;
  result.rotations = cell->times.rotations;
  result.toRotation = cell->times.settleRotations + cell->times.rotations;
  // It is not known how long a packing of the user's own has been sheared.
  if (!packingFile(setup)) result.preparedRotations = cell->filling.rotations;
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

namespace {

/// Where bins lie one after the other: in space rings count layer by layer. NaN: in no line [m].
std::vector<double> alongOf(const BinSet& bins, const Region& region) {
  std::vector<double> along;
  if (const auto* rings = dynamic_cast<const SpaceRings*>(&bins))
    for (int bin = 0; bin < rings->rings().count() * rings->layers().count(); ++bin)
      along.push_back(rings->rings().centre(bin % rings->rings().count()));
  const bool inLine = region.bins == BinKind::slabs;
  const auto add = [&](const auto& cells) {
    for (int cell = 0; cell < cells.cells(); ++cell)
      along.push_back(inLine ? cells.centre(cell)[region.axis] : NAN);
  };
  if (const auto* cells = dynamic_cast<const Cells*>(&bins)) add(*cells);
  if (const auto* grid = dynamic_cast<const Grid*>(&bins)) add(*grid);
  return along;
}

}  // namespace

RingPlaces placesOf(const Case& setup) {
  const Region& region = *setup.region;
  const auto bins = binsOf(setup);
  if (const auto* rings = dynamic_cast<const Rings*>(bins.get())) return placesOf(*rings);
  const bool rings = region.hasRings(), inLine = region.bins == BinKind::slabs;
  const double low = rings ? region.innerRadius : region.low[region.axis];
  const double high = rings ? region.outerRadius : region.high[region.axis];
  RingPlaces places;
  places.r = alongOf(*bins, region);
  for (const double place : places.r) places.rTilde.push_back((place - low) / flowDiameter(setup));
  if (rings || inLine) places.width = (high - low) / region.count;
  return places;
}

FlowFrame flowFrame(std::string_view kind, const Case& setup, const std::string& command,
                    std::span<const double> radii) {
  FlowFrame frame;
  frame.head = headOf(kind, setup, command);
  if (const Couette* const cell = cellOf(setup))
    frame.cell = cellRow(*cell, radii);
  else
    frame.region = regionRow(setup, radii.size());
  frame.averaging = averagingOf(setup);
  for (const Effect effect : effectsOf(setup)) frame.effects.emplace_back(toString(effect));
  frame.rings = placesOf(setup);
  return frame;
}

}  // namespace crossgrain::inline studies
