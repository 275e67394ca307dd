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

void readStarts(Reader& in, Assembly& assembly) {
  StartFiles& starts = assembly.starts;
  starts.files = in.readFiles("file", ".csv");
  double density = 0.0;
  in.read("density", density, positive("kg/m^2"));
  in.read("velocity_rms", starts.velocityRms, atLeast(0.0, "m/s"));
  in.finish();
  if (starts.files.empty()) {
    for (const char* const key : {"density", "velocity_rms"})
      if (in.has(key)) in.fail(key, "is of no use without a file");
    return;
  }
  std::vector<Start> read;
  for (const auto& file : starts.files) {
    const auto mass = [&](double radius) {
      if (density == 0.0)
        throw BadInput(
            fmt::format("{}: has no column mass, and [particles] no density", file.string()));
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
