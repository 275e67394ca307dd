#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"
#include "cases/case.hpp"
#include "cases/hdf5_file.hpp"

namespace crossgrain {

/// Keeps a few evenly spaced snapshots of a run and writes them as HDF5 when the run is over, with
/// an XDMF file beside it that ParaView opens. README.md has the layout.
class SnapshotFile {
 public:
  /// @param engine  whose snapshots they are  @param samples  snapshots that will be offered
  /// @param keep  how many of them to keep
  SnapshotFile(std::filesystem::path file, std::string engine, const Scene& scene, int samples,
               int keep);

  /// The k-th of all samples, k = 1 … samples.
  void offer(const Snapshot& snapshot, int k);

  /// Writes the file, if anything was to be kept.
  void close();

 private:
  std::filesystem::path file_;
  std::string engine_;
  const Scene& scene_;
  int samples_, keep_;
  std::vector<Snapshot> kept_;
};

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

}  // namespace crossgrain
