#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

#include "reports/common/motion.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"
#include "reports/common/sentences.hpp"
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

/// "Mean 0.0123 N; 4 of 412 contacts carry 0.05 N or more, the widest line."
std::string forceWords(const ForceCount& count, double widest) {
  return fmt::format("Mean {} N; {} of {} {} {} N or more, the widest line.", readable(count.mean),
                     count.above, counted(count.contacts, "contact"),
                     verb(count.above, "carries", "carry"), readable(widest));
}

/// "after 0.83 rotations of the wheel", "after 0.3 s"
std::string timeWords(const CompareResults& results, double time) {
  const double turn = std::abs(results.cell.omega) * time / (2.0 * std::numbers::pi);
  return turn > 0.0 && !results.region ? fmt::format("after {:.2f} rotations of the wheel", turn)
                                       : fmt::format("after {:.3g} s", time);
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
    origins.push_back(
        {"origins_" + word, engine.name, engine.name + ": disks coloured by where they started", "",
         Picture::Shows::origins,
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

double fastestShown(const CompareResults& results, const std::vector<Motion>& motions) {
  const double rim = std::abs(results.cell.omega) * results.cell.innerRadius;
  if (rim > 0.0) return rim;
  double fastest = 0.0;
  for (const Motion& motion : motions) fastest = std::max(fastest, largestSpeed(motion));
  return fastest;
}

std::vector<Picture> compareFilms(const CompareResults& results,
                                  const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::vector<Motion> motions;
  for (const EngineRuns& engine : engineRuns(results)) {
    if (engine.finished.empty()) continue;
    const auto file = fmt::format("{}-p{}.h5", engine.name, engine.finished.front()->packing);
    if (auto motion = readMotion(folder / "snapshots" / file)) {
      names.push_back(engine.name);
      motions.push_back(std::move(*motion));
    }
  }
  const double fastest = fastestShown(results, motions);
  double reach = 0.0;
  for (const Motion& motion : motions) reach = std::max(reach, reachOf(motion));
  if (fastest <= 0.0 || reach <= 0.0) return {};
  std::vector<Picture> films;
  for (std::size_t k = 0; k < motions.size(); ++k) {
    std::vector<std::string> told;
    for (const MotionFrame& frame : motions[k].frames)
      told.push_back(timeWords(results, frame.time));
    films.push_back({fmt::format("motion_{}_{}", k + 1, fileWord(names[k])), names[k],
                     fmt::format("{}: disks coloured by their speed, {}", names[k], told.back()),
                     "", Picture::Shows::motion, motionStill(motions[k], fastest, 1.01 * reach),
                     motionData(motions[k], fastest, 1.01 * reach, told)});
  }
  return films;
}

}  // namespace crossgrain::reports
