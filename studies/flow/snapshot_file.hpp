#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <vector>

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"
#include "cases/case.hpp"
#include "support/hdf5_file.hpp"

namespace crossgrain::inline studies {

/// "/snapshot-NNN", counted from 0: the group of a snapshot in a file of snapshots, whose datasets
/// docs/files.md has.
inline std::string snapshotGroup(std::size_t k) {
  return fmt::format("/snapshot-{:03d}", k);
}

/// Writes a few evenly spaced snapshots of a run as HDF5, with an XDMF file beside it that ParaView
/// opens. They go to NAME.part one by one, which gets its name when the run is over. README.md has
/// the layout.
class SnapshotFile {
 public:
  /// @param engine  whose snapshots they are  @param samples  snapshots that will be offered
  /// @param keep  how many of them to keep
  SnapshotFile(std::filesystem::path file, std::string engine, const Scene& scene, int samples,
               int keep);

  /// The k-th of all samples, k = 1 … samples. @throws OutputError
  void offer(const Snapshot& snapshot, int k);

  /// The file is whole, if anything was to be kept. @throws OutputError
  void close();

 private:
  /// What the XDMF text has to know of a snapshot in the file.
  struct KeptSnapshot {
    double time;  ///< of positions [s]
    bool spins;
  };
  void begin();
  std::string xdmf() const;

  std::filesystem::path file_, part_;
  std::string engine_;
  const Scene& scene_;
  int samples_, keep_;
  std::vector<KeptSnapshot> kept_;
};

/// All of such a file can be read: HDF5 itself does not get over every damaged one
/// (support/hdf5_file.hpp). To be asked before a file of anybody's is opened.
/// @throws BadInput as SnapshotReader, or that the file is damaged
void requireReadable(const std::filesystem::path& file, const Case& setup);

/// Reads such a file, of a run or of any other source, one snapshot at a time.
class SnapshotReader {
 public:
  /// @param setup  what the file does not hold: the law, the walls' names
  /// @throws BadInput naming the file and what it lacks
  SnapshotReader(const std::filesystem::path& file, const Case& setup);

  /// Disks and walls of the file under the law of the case.
  const Scene& scene() const { return scene_; }
  /// As the file says, else the file's name.
  const std::string& engine() const { return engine_; }
  std::size_t count() const { return count_; }
  const std::filesystem::path& file() const { return name_; }
  /// Whether a snapshot holds how the wheel and the ring move.
  bool tellsMotion(std::size_t k) const;

  /// @throws BadInput naming the dataset that is missing or does not fit
  Snapshot read(std::size_t k) const;

 private:
  std::vector<double> numbers(const std::string& path, std::size_t length) const;
  std::vector<Vec2> vectors(const std::string& path, std::size_t length) const;
  void readScene(const Case& setup);
  std::vector<BodySnapshot> readBodies(const std::string& group) const;
  Contacts readContacts(const std::string& path) const;
  [[noreturn]] void fail(const std::string& what) const;

  std::filesystem::path name_;
  Hdf5File file_;
  Scene scene_;
  std::string engine_;
  std::size_t count_ = 0;
};

/// Snapshots of one cell averaged with the rings of another give numbers without meaning. Held
/// against the case are what the file says of disks (how many of each radius, their masses; not
/// where the case takes them from a packing file), wall disks (how many, radius, distance from the
/// axis), the wheel's rate and where the disks' centres are. What the file does not hold is not
/// asked for.
/// @throws BadInput naming the file and all that does not fit, in one line
void requireFit(const SnapshotReader& reader, const Case& setup);

/// Every snapshot of the file can be true of its disks (adapters/audit.hpp), as far as a file says:
/// not its time step, nor how walls were to move, and its numbers may be of single precision.
/// @throws BadInput naming the file, the snapshot and what cannot be
void requireSound(const SnapshotReader& reader, const Case& setup);

}  // namespace crossgrain::inline studies
