#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "reports/common/numbers.hpp"
#include "reports/couette/engine_runs.hpp"
#include "reports/couette/report.hpp"

namespace crossgrain::reports {

namespace {

const ScenePicture* firstPicture(const EngineRuns& engine) {
  for (const CouetteRun* run : engine.runs)
    if (run->picture) return &*run->picture;
  return nullptr;
}

/// Letters, digits and dashes only: names of engines become names of files.
std::string fileWord(const std::string& name) {
  std::string word = name;
  for (char& c : word)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
  return word;
}

}  // namespace

std::vector<Picture> comparePictures(const CompareResults& results) {
  std::vector<Picture> origins, forces;
  for (const EngineRuns& engine : engineRuns(results)) {
    const ScenePicture* picture = firstPicture(engine);
    if (!picture || picture->x.empty()) continue;
    const std::string word = fmt::format("{}_{}", origins.size() + 1, fileWord(engine.name));
    origins.push_back(
        {"origins_" + word, engine.name, engine.name + ": disks coloured by where they started", "",
         Picture::Shows::origins,
         originsDrawing(*picture, results.cell.innerRadius,
                        results.region ? results.region->diameter : results.cell.diameter)});
    if (const auto widest = widestForce(*picture))
      forces.push_back({"forces_" + word, engine.name, engine.name + ": forces between disks",
                        fmt::format("Widest line: {} N and more.", readable(widest)),
                        Picture::Shows::forces, forcesDrawing(*picture, *widest, 0.75)});
  }
  std::ranges::move(forces, std::back_inserter(origins));
  return origins;
}

}  // namespace crossgrain::reports
