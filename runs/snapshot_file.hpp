#pragma once

#include <filesystem>
#include <vector>

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"

namespace crossgrain {

/// Keeps a few evenly spaced snapshots of a run and writes them as HDF5 when the run is over:
/// /disks/{radius,mass,inertia}, /walls/radius, and per snapshot /snapshot-NNN/{time (position,
/// velocity, contact, interval), position, velocity, spin, wall_position, contacts/{i, j, normal,
/// overlap, normal_force, tangential_force}} in SI units.
class SnapshotFile {
 public:
  /// @param samples  snapshots that will be offered  @param keep  how many of them to keep
  SnapshotFile(std::filesystem::path file, const Scene& scene, int samples, int keep);

  /// The k-th of all samples, k = 1 … samples.
  void offer(const Snapshot& snapshot, int k);

  /// Writes the file, if anything was to be kept.
  void close();

 private:
  std::filesystem::path file_;
  const Scene& scene_;
  int samples_, keep_;
  std::vector<Snapshot> kept_;
};

}  // namespace crossgrain
