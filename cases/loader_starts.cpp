#include <fmt/format.h>

#include <map>

#include "cases/loader_sections.hpp"
#include "cases/packing.hpp"
#include "cases/start_file.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::inline cases {
namespace {

/// Disks of the file that stand still, as one more body.
WallGroup fixedWall(const StartFiles& starts) {
  WallGroup wall;
  wall.position = starts.fixedPosition;
  wall.radii = starts.fixedRadius;
  return wall;
}

/// One start that counts as two packings would make a scatter too small.
void requireDifferent(const StartFiles& starts) {
  std::map<std::string, std::size_t> seen;
  for (std::size_t k = 0; k < starts.disks.size(); ++k) {
    Packing packing;
    packing.disks = starts.disks[k];
    const auto [same, isNew] = seen.emplace(contentHash(packing), k);
    if (!isNew)
      throw BadInput(fmt::format("{}: its disks are those of {}: each file must be another start",
                                 starts.files[k].string(), starts.files[same->second].string()));
  }
}

}  // namespace

void readStart(Reader& in, Assembly& assembly) {
  StartFiles& starts = assembly.starts;
  in.require("file", starts.files, ".csv");
  double density = 0.0;
  in.read("density", density, positive("kg/m^2"));
  in.read("velocity_rms", starts.velocityRms, atLeast(0.0, "m/s"));
  in.finish();
  if (starts.files.empty()) in.fail("file", "must name one file or more");
  for (const auto& file : starts.files) {
    const auto mass = [&](double radius) {
      if (density == 0.0)
        throw BadInput(
            fmt::format("{}: tells no masses, and [assembly.start] no density", file.string()));
      return massOf(in, density, radius, 1.0);
    };
    Start start = readStart(file, {mass, assembly.inertiaFactor});
    if (starts.disks.empty()) {
      starts.fixedPosition = start.fixedPosition;
      starts.fixedRadius = start.fixedRadius;
    }
    if (start.fixedPosition != starts.fixedPosition || start.fixedRadius != starts.fixedRadius)
      throw BadInput(fmt::format("{}: its fixed disks are not those of {}", file.string(),
                                 starts.files.front().string()));
    starts.disks.push_back(std::move(start.disks));
    starts.lines.push_back(std::move(start.lines));
    starts.lines.back().insert(starts.lines.back().end(), start.fixedLines.begin(),
                               start.fixedLines.end());
  }
  requireDifferent(starts);
  if (!starts.fixedRadius.empty()) assembly.walls.push_back(fixedWall(starts));
}

}  // namespace crossgrain::inline cases
