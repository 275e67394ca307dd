#include <fmt/format.h>

#include <numbers>

#include "cases/loader_sections.hpp"
#include "cases/start_file.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::inline cases {
namespace {

/// Disks of the file that stand still, as one more body.
WallGroup fixedWall(const Start& start) {
  WallGroup wall;
  wall.position = start.fixedPosition;
  wall.radii = start.fixedRadius;
  return wall;
}

bool sameWall(const Start& a, const Start& b) {
  return a.fixedPosition == b.fixedPosition && a.fixedRadius == b.fixedRadius;
}

}  // namespace

void readStart(Reader& in, Assembly& assembly) {
  StartFiles& starts = assembly.starts;
  const bool there = !in.keys().empty();
  if (there) in.require("file", starts.files, ".csv");
  double density = 0.0;
  in.read("density", density, positive("kg/m^2"));
  in.read("velocity_rms", starts.velocityRms, atLeast(0.0, "m/s"));
  in.finish();
  if (!there) return;
  std::vector<Start> read;
  for (const auto& file : starts.files) {
    const auto mass = [&](double radius) {
      if (density == 0.0)
        throw BadInput(
            fmt::format("{}: tells no masses, and [assembly.start] no density", file.string()));
      return density * std::numbers::pi * radius * radius;
    };
    read.push_back(readStart(file, {mass, assembly.inertiaFactor}));
    if (!sameWall(read.back(), read.front()))
      throw BadInput(fmt::format("{}: its fixed disks are not those of {}", file.string(),
                                 starts.files.front().string()));
    starts.disks.push_back(read.back().disks);
  }
  if (!read.front().fixedRadius.empty()) assembly.walls.push_back(fixedWall(read.front()));
}

}  // namespace crossgrain::inline cases
