#include <cmath>

#include "results/snapshot_layout.hpp"
#include "support/hdf5_file.hpp"
#include "tests/reports/sample_results.hpp"

namespace crossgrain::sample {

void keepSnapshots(const CompareResults& results, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / "snapshots");
  const double innerRadius = results.cell.innerRadius, omega = results.cell.omega;
  for (const CouetteRun& run : results.runs) {
    if (!run.picture) continue;
    const ScenePicture& scene = *run.picture;
    Hdf5File out = Hdf5File::create(folder / "snapshots" / (run.engine + "-p0.h5"));
    out.write("/disks/radius", scene.radius);
    out.write("/walls/radius", scene.wallRadius);
    constexpr std::size_t count = 8;
    for (std::size_t k = 0; k < count; ++k) {
      const double t = 0.5 * static_cast<double>(k);
      std::vector<double> place, velocity, wall;
      for (std::size_t i = 0; i < scene.x.size(); ++i) {
        const double r = std::hypot(scene.x[i], scene.y[i]);
        const double turn = omega * std::exp(-(r - innerRadius) / results.cell.diameter);
        const double angle = std::atan2(scene.y[i], scene.x[i]) + turn * t;
        place.insert(place.end(), {r * std::cos(angle), r * std::sin(angle)});
        velocity.insert(velocity.end(), {-turn * r * std::sin(angle), turn * r * std::cos(angle)});
      }
      for (std::size_t w = 0; w < scene.wallX.size(); ++w)
        wall.insert(wall.end(), {scene.wallX[w], scene.wallY[w]});
      const std::string group = snapshotGroup(k);
      out.write(group + "/time", std::vector{t, t, t, 0.0});
      out.write(group + "/position", place);
      out.write(group + "/velocity", velocity);
      out.write(group + "/wall_position", wall);
    }
    out.save();
  }
}

}  // namespace crossgrain::sample
