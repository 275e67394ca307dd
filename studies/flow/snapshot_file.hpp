#pragma once

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "adapters/audit.hpp"
#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"
#include "adapters/snapshot_source.hpp"
#include "cases/case.hpp"
#include "support/hdf5_file.hpp"

namespace crossgrain::inline studies {

/// "/snapshot-NNN", counted from 0: the group of a snapshot in a file of snapshots, whose datasets
/// docs/files.md has.
inline std::string snapshotGroup(std::size_t k) {
  return fmt::format("/snapshot-{:03d}", k);
}

/// Writes a few evenly spaced snapshots of a run as HDF5, with an XDMF file beside it that ParaView
/// opens. They go to NAME.part one by one, which gets its name when the run is over. docs/files.md
/// has the layout; in space vectors and spins have three columns.
template <int D>
class SnapshotFileOf {
 public:
  /// @param engine  whose snapshots they are  @param samples  snapshots that will be offered
  /// @param keep  how many of them to keep
  SnapshotFileOf(std::filesystem::path file, std::string engine, const SceneOf<D>& scene,
                 int samples, int keep);

  /// The k-th of all samples, k = 1 … samples. @throws OutputError
  void offer(const SnapshotOf<D>& snapshot, int k);

  /// The file is whole, if anything was to be kept. @throws OutputError
  void close();

 private:
  /// Description for the XDMF text of a snapshot in the file.
  struct KeptSnapshot {
    double time;  ///< of positions [s]
    bool spins;
  };
  void begin();
  std::string xdmf() const;

  std::filesystem::path file_, part_;
  std::string engine_;
  const SceneOf<D>& scene_;
  int samples_, keep_;
  std::vector<KeptSnapshot> kept_;
};
using SnapshotFile = SnapshotFileOf<2>;

/// Reads such a file, of a run or of any other source, one snapshot at a time. Between two of them
/// the file is closed, so that other HDF5 files can be read and written meanwhile.
template <int D>
class SnapshotReaderOf : public SnapshotSourceOf<D> {
 public:
  /// @param setup  what the file does not hold: the law, the walls of an assembly and how they move
  /// @throws BadInput naming the file and what it lacks
  SnapshotReaderOf(const std::filesystem::path& file, const Case& setup);
  SnapshotReaderOf(const SnapshotReaderOf&) = delete;  // basis_ points into it
  SnapshotReaderOf& operator=(const SnapshotReaderOf&) = delete;

  const SceneOf<D>& scene() const override { return scene_; }
  const std::string& engine() const override { return engine_; }
  /// Of an assembly, those of the averaged time alone, but for takeAll().
  std::optional<SnapshotOf<D>> next() override;
  /// next() leaves out none, whatever is averaged.
  void takeAll();
  double progress() const override {
    return static_cast<double>(next_) / static_cast<double>(count_);
  }
  std::vector<std::string> remarks() const override;

  std::size_t count() const { return count_; }

  /// The k-th, not yet found sound.
  /// @throws BadInput naming the dataset that is missing or does not fit
  SnapshotOf<D> read(std::size_t k) const;

 private:
  std::filesystem::path name_;
  SceneOf<D> scene_;
  std::string engine_;
  std::size_t count_ = 0, next_ = 0, leftOut_ = 0;
  double from_ = -INFINITY, to_ = INFINITY;  ///< (from_, to_] is averaged [s]
  AuditBasisOf<D> basis_;
};
using SnapshotReader = SnapshotReaderOf<2>;

/// Opens a file of anybody's, of which all is read first for trial (support/hdf5_file.hpp).
/// @throws BadInput as SnapshotReader, that it is damaged or does not fit the case
template <int D>
std::unique_ptr<SnapshotReaderOf<D>> openSnapshotFile(const std::filesystem::path& file,
                                                      const Case& setup);

}  // namespace crossgrain::inline studies
