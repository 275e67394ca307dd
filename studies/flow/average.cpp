#include "studies/flow/average.hpp"

#include <fmt/format.h>

#include "results/schema.hpp"
#include "studies/core/study_cases.hpp"
#include "studies/flow/averages.hpp"
#include "studies/flow/ensemble.hpp"
#include "studies/flow/frame.hpp"
#include "studies/flow/snapshot_file.hpp"
#include "support/bad_input.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline studies {

CompareResults averageSnapshots(const Case& setup, const std::filesystem::path& file,
                                const std::string& commandLine) {
  requireReadable(file, setup);
  const SnapshotReader reader(file, setup);
  requireFit(reader, setup);
  requireSound(reader, setup);
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

  CompareResults results;
  static_cast<FlowFrame&>(results) = couetteFrame(kindAverage, setup, commandLine, scene.disks);
  // Of a file's snapshots nobody says from when to when they are.
  FlowAveraging& averaging = results.averaging;
  averaging.settleRotations = averaging.rotations = averaging.fromRotation = averaging.toRotation =
      averaging.preparedRotations = std::nullopt;
  averaging.snapshots = static_cast<std::int64_t>(reader.count());
  results.engines = {{reader.engine(), fmt::format("snapshots of {}", file.filename().string()), "",
                      "", Status::finished, ""}};
  FlowRun& run = results.runs.emplace_back();
  run.engine = reader.engine();
  averages.describe(EffectiveParameters{}, run);
  results.steadiness = steadinessOf(results.runs, {reader.engine()}, setup.averaging.confidence);
  results.notes = {fmt::format("Averaged from the {} snapshots of {}; nothing was run.",
                               reader.count(), file.string())};
  return results;
}

const Study<AverageOptions, CompareResults> averageStudy = {
    "average",
    {.input = SharedOptions::Input::snapshots, .engines = false},
    Keeps::nothing,
    [](AverageOptions&, CommandLine&) { return std::vector<StudyOption>{}; },
    [](const CommandLine& line, AverageOptions&) { return std::vector{onlyCase(line, "average")}; },
    nullptr,
    [](const StudyWork& work, const AverageOptions&) {
      return averageSnapshots(work.setup(), work.line.snapshots, work.line.run.commandLine);
    },
    [](const CompareResults&, const CommandLine&, const AverageOptions&) { return Outcome(); }};

}  // namespace crossgrain::inline studies
