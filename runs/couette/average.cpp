#include "runs/couette/average.hpp"

#include <fmt/format.h>

#include "runs/common/records.hpp"
#include "runs/couette/averages.hpp"
#include "runs/couette/head.hpp"
#include "runs/couette/snapshot_file.hpp"
#include "runs/couette/snapshot_fit.hpp"
#include "runs/couette/state_table.hpp"
#include "support/bad_input.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

json averageSnapshots(const Case& setup, const std::filesystem::path& file,
                      const std::string& commandLine) {
  const SnapshotReader reader(file, setup);
  requireFit(reader, setup);
  const Scene& scene = reader.scene();
  CouetteAverages averages(setup, scene);
  for (std::size_t k = 0; k < reader.count(); ++k) {
    throwIfInterrupted();
    const Snapshot snapshot = reader.read(k);
    try {
      averages.add(snapshot);
    } catch (const std::invalid_argument& misfit) {
      throw BadInput(fmt::format("{}, snapshot {}: {}", file.string(), k, misfit.what()));
    }
  }

  json results = couetteHead("average", setup, commandLine, scene.disks);
  // Of a file's snapshots nobody says from when to when they are.
  for (const char* unknown :
       {"settle_rotations", "rotations", "from_rotation", "to_rotation", "prepared_rotations"})
    results["averaging"].erase(unknown);
  results["averaging"]["snapshots"] = reader.count();
  results["engines"] = {{{"name", reader.engine()},
                         {"summary", fmt::format("snapshots of {}", file.filename().string())},
                         {"version", ""},
                         {"mirrors", ""},
                         {"status", "ran"},
                         {"reason", ""}}};
  json run = {{"engine", reader.engine()}, {"packing", 0}, {"status", "finished"}, {"reason", ""}};
  averages.describe(Realised{}, run);
  results["runs"] = {run};
  results["steadiness"] =
      steadinessOf(results["runs"], {reader.engine()}, setup.averaging.confidence);
  results["notes"] = {fmt::format("Averaged from the {} snapshots of {}; nothing was run.",
                                  reader.count(), file.string())};
  return results;
}

}  // namespace crossgrain::inline runs
