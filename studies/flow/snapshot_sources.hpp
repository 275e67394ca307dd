#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "adapters/snapshot_source.hpp"
#include "cases/case.hpp"
#include "cases/flow.hpp"

/// Snapshots from files, whoever wrote them: HDF5 files of our own layout (docs/files.md), or
/// result files of other programs (docs/import.md).
namespace crossgrain::inline studies {

/// The files of one run.
struct SnapshotRun {
  std::string format;  ///< of adapters/files/frame.hpp; empty: HDF5 of our own
  std::vector<std::filesystem::path> files;
  std::vector<std::filesystem::path> besides = {};  ///< that are not read: files::isBesideResults()

  std::string name() const;  ///< "out/run.data", "dumps/a.0 … (12 files)"
};

/// Which part of the averaged time the snapshots of a run are of.
class CoveredTime {
 public:
  explicit CoveredTime(const FlowTimes& wanted) : wanted_(wanted) {}
  /// Times must rise [s].
  void add(double t) { times_.push_back(t); }

  /// "9 snapshots cover 0.6 to 0.68 s; the case averages 0.6 to 0.8 s"; empty where none is
  /// missing: by the files' own spacing, or the case's where that is wider, another one was due
  /// before the first, after the last, or between two of them.
  std::string gap() const;

 private:
  FlowTimes wanted_;
  std::vector<double> times_;
};

/// Sorts files into runs: each HDF5 file of our own is one.
/// @param format  that all are of; empty: each is recognised by what it begins with
/// @throws BadInput
std::vector<SnapshotRun> snapshotRuns(const std::vector<std::filesystem::path>& files,
                                      const std::string& format = {});

/// Name of a run of files that is given none: their format, which is also the
/// [engines.NAME] that has their settings.
std::string defaultName(const std::string& format);

/// Runs without those that are copies of one before them, byte by byte or to rounding: a run that
/// is there twice is no replicate of itself.
struct DistinctRuns {
  std::vector<std::size_t> kept;     ///< indices, rising
  std::vector<std::string> remarks;  ///< a sentence for each that is left out
};
/// @param nameOf  as openSnapshots() takes it  @throws BadInput
DistinctRuns distinctRuns(const std::vector<SnapshotRun>& runs, const Case& setup,
                          const std::function<std::string(const SnapshotRun&)>& nameOf);

/// Opens a run of which the files fit the case.
/// @param name  of its settings, [engines.NAME], and of who made it where the files do not say
/// @throws BadInput
template <int D>
std::unique_ptr<SnapshotSourceOf<D>> openSnapshots(const SnapshotRun& run, const Case& setup,
                                                   const std::string& name);

}  // namespace crossgrain::inline studies
