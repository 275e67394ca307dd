#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "adapters/engine_entry.hpp"
#include "cases/case.hpp"
#include "results/run.hpp"
#include "studies/flow/averages.hpp"
#include "studies/flow/snapshot_sources.hpp"

/// Runs made elsewhere, read from files.
namespace crossgrain::inline studies {

/// Whether a name of --engines is that of files: "NAME=PATTERN".
bool namesFiles(const std::string& text);

/// The engine that such a text names: NAME, and its runs from all files that match the PATTERN of a
/// shell (*, ?, [a-z]), sorted into runs as snapshotRuns() does. [engines.NAME] of a case has the
/// settings of their format. @throws BadInput for a name that an engine has, a pattern that no file
/// matches, or files of several formats
EngineEntry engineOfFiles(const std::string& text);

/// One of its runs.
SnapshotRun runOf(const EngineEntry& entry, std::size_t run);

/// Leaves out runs that are copies of others (distinctRuns()). @returns a sentence for each
std::vector<std::string> dropCopies(EngineEntry& entry, const Case& setup);

/// Keys of a run of files: names, sizes and times of change of its files.
std::string fingerprintOf(const EngineEntry& entry, std::size_t run);

/// Averages files as a run of an engine.
struct AveragedRun {
  FlowRun run;  ///< of the source's engine, packing 0; without errors of endpoints
  std::int64_t snapshots = 0;
  std::unique_ptr<RunAverages> averages;
};

/// A run of files that is open, of either dimension.
struct OpenRun {
  std::vector<double> radius;  ///< of its disks, or spheres [m]
  /// Reads on to the end, once. @param progress  called with the fraction done, 0 … 1
  /// @throws BadInput naming the snapshot that does not fit those before it; Interrupted
  std::function<AveragedRun(const std::function<void(double)>& progress)> average;
};
/// Opens one whose files fit the case, which outlives it.
/// @param name  as openSnapshots()  @throws BadInput
OpenRun openRun(const SnapshotRun& files, const Case& setup, const std::string& name);

}  // namespace crossgrain::inline studies
