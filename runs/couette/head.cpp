#include "runs/couette/head.hpp"

#include <algorithm>
#include <cmath>

#include "cases/effect_switch.hpp"
#include "runs/common/records.hpp"
#include "runs/couette/run.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

namespace {

json cellJson(const Case& setup, const Disks& disks) {
  const Cell& cell = setup.cell;
  const auto small = std::ranges::count(disks.radius, setup.particles.smallRadius);
  double diskArea = 0.0;
  for (const double a : disks.radius) diskArea += a * a;
  const double cellArea = cell.outerRadius * cell.outerRadius - cell.innerRadius * cell.innerRadius;
  return {{"inner_radius", cell.innerRadius},
          {"outer_radius", cell.outerRadius},
          {"wall_radius", cell.wallRadius},
          {"wall_spacing", cell.wallSpacing},
          {"height", cell.height},
          {"omega", cell.omega},
          {"small", small},
          {"large", static_cast<std::ptrdiff_t>(disks.size()) - small},
          {"small_radius", setup.particles.smallRadius},
          {"large_radius", setup.particles.largeRadius},
          {"volume_fraction", diskArea / cellArea},
          {"diameter", 2.0 * setup.particles.smallRadius}};
}

}  // namespace

json couetteHead(const std::string& kind, const Case& setup, const std::string& command,
                 const Disks& disks) {
  json results = resultsHead(kind, setup, command);
  results["cell"] = cellJson(setup, disks);
  const Averaging& averaging = setup.averaging;
  results["averaging"] = {
      {"method", averaging.methods.front()},
      {"settle_rotations", averaging.settleRotations},
      {"rotations", averaging.rotations},
      {"from_rotation", averaging.settleRotations},
      {"to_rotation", averaging.settleRotations + averaging.rotations},
      // Nobody knows how long a packing of the user's own has been sheared.
      {"prepared_rotations",
       setup.particles.file ? json(nullptr) : json(setup.preparation.rotations)},
      {"snapshots", std::lround(averaging.snapshotsPerRotation * averaging.rotations)},
      {"confidence", averaging.confidence}};
  for (const Effect effect : effectsOf(setup)) results["effects"].push_back(toString(effect));
  for (const std::string& warning : setup.warnings) results["notes"].push_back(warning);
  const Rings rings = ringsOf(setup);
  for (int ring = 0; ring < rings.count(); ++ring) {
    results["rings"]["r"].push_back(rings.centre(ring));
    results["rings"]["r_tilde"].push_back(rings.rTilde(ring));
  }
  results["rings"]["width"] = rings.edge(1) - rings.edge(0);
  return results;
}

}  // namespace crossgrain::inline runs
