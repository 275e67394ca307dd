#include "runs/average.hpp"

#include <fmt/format.h>

#include "cases/bad_input.hpp"
#include "runs/couette_averages.hpp"
#include "runs/couette_head.hpp"
#include "runs/interrupt.hpp"
#include "runs/records.hpp"
#include "runs/snapshot_file.hpp"

namespace crossgrain {

using nlohmann::json;

json averageSnapshots(const Case& setup, const std::filesystem::path& file,
                      const std::string& commandLine) {
  const SnapshotReader reader(file, setup);
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

  json results = couetteHead("compare", setup, commandLine, scene.disks);
  results["averaging"].erase("settle_rotations");
  results["averaging"].erase("rotations");
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
  results["notes"] = {fmt::format("Averaged from the {} snapshots of {}; nothing was run.",
                                  reader.count(), file.string())};
  return results;
}

}  // namespace crossgrain
