#include "studies/flow/average.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "cases/endpoints.hpp"
#include "results/schema.hpp"
#include "studies/core/executor.hpp"
#include "studies/core/study.hpp"
#include "studies/flow/averages.hpp"
#include "studies/flow/endpoint_values.hpp"
#include "studies/flow/ensemble.hpp"
#include "studies/flow/file_runs.hpp"
#include "studies/flow/frame.hpp"
#include "studies/flow/notes.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::inline studies {
namespace {

/// Endpoints beside the other numbers of the run.
void addEndpoints(const Case& setup, FlowRun& run) {
  if (cellOf(setup)) return;
  for (const Endpoint& endpoint : setup.endpoints) {
    EndpointValue found = endpointValue(endpoint, setup, run);
    if (!notShown(endpoint, setup, run).empty()) found.value.reset();
    std::erase_if(run.head, [&](const HeadNumber& number) { return number.name == endpoint.name; });
    run.head.push_back({endpoint.name, endpoint.unit, found.value, {}, {}});
  }
}

struct NamedRun {
  FlowRun run;
  std::string name;  ///< of its file
  std::int64_t snapshots = 0;
  std::vector<double> radius;  ///< of its disks [m]
};

NamedRun averageRun(const Case& setup, const SnapshotRun& files, const std::string& name, int index,
                    std::size_t count, Progress& progress) {
  const OpenRun opened = openRun(files, setup, name);
  // Begun once the first is open: a file that cannot be read is refused in one line.
  if (index == 0) progress.begin("averaging", std::vector<double>(count, 1.0));
  AveragedRun averaged = opened.average([&](double fraction) {
    progress.update(static_cast<std::size_t>(index), files.name(), fraction);
  });
  averaged.run.packing = index;
  addEndpoints(setup, averaged.run);
  return {std::move(averaged.run), files.name(), averaged.snapshots, opened.radius};
}

/// Runs of one engine are replicates; those of two are to be compared.
void requireOneEngine(const std::vector<NamedRun>& all) {
  for (const NamedRun& other : all)
    if (other.run.engine != all.front().run.engine)
      throw BadInput(fmt::format(
          "{} is of {}, {} is of {}: average takes runs of one engine, which differ by their start",
          all.front().name, all.front().run.engine, other.name, other.run.engine));
}

std::string describeSources(const std::vector<NamedRun>& all) {
  if (all.size() == 1)
    return fmt::format("Averaged from the {} snapshots of {}; nothing was run.",
                       all.front().snapshots, all.front().name);
  std::vector<std::string> each;
  for (const NamedRun& one : all) each.push_back(fmt::format("{} of {}", one.snapshots, one.name));
  return fmt::format(
      "Averaged from the snapshots of {} runs, which count as replicates ({}); nothing was run.",
      all.size(), fmt::join(each, ", "));
}

}  // namespace

CompareResults averageSnapshots(const Case& setup, const std::vector<std::filesystem::path>& files,
                                const std::string& commandLine, const AverageOptions& options,
                                bool quiet) {
  const std::vector<SnapshotRun> runs = snapshotRuns(files);
  const auto nameOf = [&](const SnapshotRun& run) {
    return options.name.value_or(defaultName(run.format));
  };
  const DistinctRuns distinct = distinctRuns(runs, setup, nameOf);
  Progress progress(quiet);
  std::vector<NamedRun> all;
  for (const std::size_t k : distinct.kept) {
    const SnapshotRun& run = runs[k];
    const auto index = all.size();
    all.push_back(averageRun(setup, run, nameOf(run), static_cast<int>(index), distinct.kept.size(),
                             progress));
    progress.finish(index, fmt::format("{}: {} snapshots", run.name(), all.back().snapshots));
  }
  requireOneEngine(all);

  CompareResults results;
  static_cast<FlowFrame&>(results) = flowFrame(kindAverage, setup, commandLine, all.front().radius);
  // Snapshots of a file do not say from when to when they are.
  FlowAveraging& averaging = results.averaging;
  averaging.settleRotations = averaging.rotations = averaging.fromRotation = averaging.toRotation =
      averaging.preparedRotations = std::nullopt;
  averaging.snapshots = std::ranges::max(all, {}, &NamedRun::snapshots).snapshots;
  const std::string engine = all.front().run.engine;
  results.engines = {{engine,
                      all.size() == 1
                          ? fmt::format("snapshots of {}", files.front().filename().string())
                          : fmt::format("snapshots of {} runs", all.size()),
                      "", "", Status::finished, ""}};
  results.notes = {describeSources(all)};
  results.notes.insert(results.notes.end(), distinct.remarks.begin(), distinct.remarks.end());
  for (NamedRun& one : all) results.runs.push_back(std::move(one.run));
  std::ranges::move(remarkNotes(results.runs, false), std::back_inserter(results.notes));
  results.steadiness = steadinessOf(results.runs, {engine}, setup.averaging.confidence);
  if (results.runs.size() > 1) results.ensemble = ensembleOf(results.runs, {engine});
  return results;
}

namespace {

const SharedOptions averageTakes = {
    .input = SharedOptions::Input::files,
    .inputIs = "snapshots: HDF5 files, or result files of other programs (docs/import.md)",
    .engines = false};

std::vector<StudyOption> optionsOf(AverageOptions& own, CommandLine& line) {
  return {{"--name",
           "settings of the files: units and columns in [engines.NAME] of the case (default: their "
           "format)",
           &own.name},
          {"--rev", "compute every field of one run for bins of many widths, under every weight",
           &own.rev},
          {"--quiet", "no progress", &line.run.quiet}};
}

std::vector<Case> casesOf(const CommandLine& line, AverageOptions&) {
  return {onlyFlow(line, {"average", Starts::notMade})};
}

template <typename Results>
Outcome unjudged(const Results&, const CommandLine&, const AverageOptions&) {
  return {};
}

}  // namespace

const Study<AverageOptions, CompareResults> averageStudy = {
    "average",
    averageTakes,
    Keeps::nothing,
    optionsOf,
    casesOf,
    nullptr,
    [](const StudyWork& work, const AverageOptions& own) {
      return averageSnapshots(work.setup(), filesOf(work.line), work.line.run.commandLine, own,
                              work.line.run.quiet);
    },
    unjudged};

const Study<AverageOptions, RevResults> revStudy = {"average --rev", averageTakes, Keeps::nothing,
                                                    optionsOf,       casesOf,      nullptr,
                                                    averagePerWidth, unjudged};

}  // namespace crossgrain::inline studies
