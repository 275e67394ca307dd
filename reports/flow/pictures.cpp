#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>

#include "reports/common/numbers.hpp"
#include "reports/common/sentences.hpp"
#include "reports/flow/engine_runs.hpp"
#include "reports/flow/report.hpp"

namespace crossgrain::reports {

namespace {

const ScenePicture* firstPicture(const EngineRuns& engine) {
  for (const FlowRun* run : engine.runs)
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

/// "Mean 0.0123 N; 4 of 412 contacts carry 0.05 N or more, the widest line."
std::string forceWords(const ForceCount& count, double widest) {
  return fmt::format("Mean {} N; {} of {} {} {} N or more, the widest line.", readable(count.mean),
                     count.above, counted(count.contacts, "contact"),
                     verb(count.above, "carries", "carry"), readable(widest));
}

}  // namespace

std::vector<Picture> comparePictures(const CompareResults& results) {
  std::vector<Picture> origins, forces;
  std::optional<double> widest;  // of the first that has forces, for all
  double halfWidth = 0.0;
  for (const EngineRuns& engine : engineRuns(results)) {
    const ScenePicture* picture = firstPicture(engine);
    if (!picture || picture->x.empty()) continue;
    const std::string word = fmt::format("{}_{}", origins.size() + 1, fileWord(engine.name));
    const bool inSpace = results.region && !results.region->z.empty();
    origins.push_back(
        {"origins_" + word, engine.name,
         engine.name + (inSpace ? ": spheres cut along x and z, coloured by where they started"
                                : ": disks coloured by where they started"),
         "", Picture::Shows::origins,
         originsDrawing(*picture, results.cell.innerRadius,
                        results.region ? results.region->diameter : results.cell.diameter)});
    halfWidth = std::max(halfWidth, origins.back().drawing.halfWidth);
    const auto own = widestForce(*picture);
    if (!own) continue;
    if (!widest) widest = own;
    forces.push_back({"forces_" + word, engine.name, engine.name + ": forces between disks",
                      forceWords(countForces(*picture, *widest), *widest), Picture::Shows::forces,
                      forcesDrawing(*picture, *widest, 0.75)});
  }
  std::ranges::move(forces, std::back_inserter(origins));
  for (Picture& picture : origins) picture.drawing.halfWidth = halfWidth;
  return origins;
}

}  // namespace crossgrain::reports
