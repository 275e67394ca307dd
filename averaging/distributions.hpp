#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"
#include "averaging/block_series.hpp"
#include "averaging/rings.hpp"

namespace crossgrain::inline averaging {

/// Equal bins of one axis. A value below or beyond them is counted as such, not dropped.
struct Bins {
  double low = 0.0, width = 1.0;
  int count = 1;

  double high() const { return low + count * width; }
  /// 0: below; 1 … count: bin low + (k − 1) width ≤ value < low + k width; count + 1: beyond.
  std::size_t slot(double value) const;

  void fields(auto& io) {
    io("low", low);
    io("width", width);
    io("count", count);
  }
};

/// Counts of equal events in slots over time, in at most 32 blocks of equally many snapshots: there
/// are far more slots than other series have columns, hence fewer blocks.
class BlockedCounts {
 public:
  explicit BlockedCounts(std::size_t slots) : series_(slots, 32) {}

  void count(std::size_t slot) { series_.now(slot) += 1.0; }
  void endSnapshot() { series_.endSample(); }

  struct Fractions {
    std::vector<double> mean;           ///< of all counts, per slot
    std::vector<double> standardError;  ///< within the run, from 8 blocks or more; else empty
    double total = 0.0;                 ///< counts
  };
  Fractions fractions() const;

 private:
  BlockSeries series_;
};

/// One distribution of a run. With two axes cells go first along the first.
struct Distribution {
  std::string quantity;
  std::optional<int> ring;      ///< absent: the whole cell
  std::vector<Bins> axes;       ///< one or two
  std::vector<double> density;  ///< per cell, integrates to the fraction that lies inside [1/units]
  std::vector<double> standardError;  ///< within the run, blocks taken as independent; may be empty
  double outside = 0.0;               ///< fraction of the samples beyond the bins
  double samples = 0.0;
};

/// Units of velocities and spins: ΩR_i [m/s] and ΩD/d [rad/s], D = 2R_i (Lätzel 2003,
/// section 6.4), both < 0 where the wheel turns clockwise. Radial velocities know no sense of
/// rotation: they are divided by |ΩR_i|.
struct DistributionScales {
  double velocity;
  double spin;
};

/// Collects distributions over a run, snapshot by snapshot; nothing of a snapshot is kept.
///
/// Per ring that holds a disk's centre, every disk counting once: `radial_velocity` in
/// units of |ΩR_i|, `azimuthal_velocity` in units of ΩR_i, `spin` in units of ΩD/d; and
/// `contact_direction`, the angle of the outward normals of its contacts, those with walls
/// included, from e_r towards e_φ in [−π, π) (Lätzel 2003, section 6.3). For disks whose centre is
/// within one d of R_i: `azimuthal_velocity_and_spin`, joint (Lätzel 2003, Figs. 6.10 and 6.11).
/// For the whole cell `coordination`, contacts of a disk, and of contacts `normal_force` and
/// `tangential_force`, f_n and |f_t| over their means in the same snapshot. Absent where the
/// snapshots have no spins or contacts.
class DistributionAccumulator {
 public:
  DistributionAccumulator(Rings rings, const Scene& scene, DistributionScales scales);

  void add(const Snapshot& snapshot);
  std::vector<Distribution> distributions() const;

 private:
  struct Collected {
    std::string quantity;
    std::optional<int> ring;
    std::vector<Bins> axes;
    BlockedCounts counts;
  };

  /// Together: the partners of contacts are all over the memory.
  struct Place {
    Vec2 radial = Vec2::Zero();  ///< e_r
    std::int32_t ring = -1;      ///< −1: none
    std::int32_t contacts = 0;
  };

  std::size_t collect(const char* quantity, std::optional<int> ring, std::vector<Bins> axes);
  void addDisk(std::size_t disk, const Snapshot& snapshot);
  void addContacts(const Contacts& pairs);
  void addContactOf(std::int32_t disk, const Vec2& outward);
  Distribution distribution(const Collected& collected) const;

  Rings rings_;
  DistributionScales scales_;
  std::size_t disks_;
  std::vector<Place> places_;  ///< of each disk in the last snapshot
  std::vector<Collected> all_;
  std::size_t joint_, coordination_, normal_, tangential_;  ///< places in all_; rings come first
};

}  // namespace crossgrain::inline averaging
