#pragma once

#include <array>
#include <memory>
#include <vector>

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"
#include "averaging/coordinates.hpp"
#include "averaging/weights.hpp"

namespace crossgrain::inline averaging {

/// The sums over disks that every field is made of. Each is Σ_p w_p Q_p over the moving disks, with
/// w the disk's fraction in the bin, V = π a² h its volume, m its mass and J its moment of inertia.
/// Vectors and tensors are turned into the coordinate's directions, (r, φ) for rings, at each
/// disk's own place (Lätzel 2003, section 5.1).
enum class Moment : std::size_t {
  volume,        ///< V [m³]
  wallVolume,    ///< V of wall disks, only if asked for [m³]
  mass,          ///< m [kg]
  momentumR,     ///< m v_r [kg m/s]
  momentumP,     ///< m v_φ [kg m/s]
  velocityR,     ///< V v_r [m⁴/s]
  velocityP,     ///< V v_φ [m⁴/s]
  spin,          ///< V ω [m³/s]
  spinEnergy,    ///< ½ J ω² [N m]
  stressRR,      ///< −Σ_c f_r l_r [N m]; first index force, second branch (= face normal)
  stressPP,      ///< −Σ_c f_φ l_φ [N m]
  stressRP,      ///< −Σ_c f_r l_φ [N m]
  stressPR,      ///< −Σ_c f_φ l_r [N m]
  wallStressRR,  ///< −Σ_c f_r l_r of wall disks [N m]
  wallStressPP,
  wallStressRP,
  wallStressPR,
  coupleR,      ///< −Σ_c (l × f)_z l_r [N m²]
  coupleP,      ///< −Σ_c (l × f)_z l_φ [N m²]
  wallCoupleR,  ///< −Σ_c (l × f)_z l_r of wall disks [N m²]
  wallCoupleP,
  dynamicRR,  ///< m v_r v_r [N m]
  dynamicPP,  ///< m v_φ v_φ [N m]
  dynamicRP,  ///< m v_r v_φ [N m]
  fabricRR,   ///< V Σ_c n_r n_r [m³]
  fabricPP,   ///< V Σ_c n_φ n_φ [m³]
  fabricRP,   ///< V Σ_c n_r n_φ [m³]
  contacts,   ///< V C, C the disk's number of contacts, those with walls included [m³]
  overlapRR,  ///< Σ_c Δ_r l_r, Δ = δ n with n along l: the overlap as a displacement [m²]
  overlapPP,  ///< Σ_c Δ_φ l_φ [m²]
  overlapRP,  ///< Σ_c Δ_r l_φ [m²]
  cos4,       ///< V Σ_c cos 4α, α the angle of l from the first direction [m³]
  sin4,       ///< V Σ_c sin 4α [m³]
  cos6,       ///< V Σ_c cos 6α [m³]
  sin6,       ///< V Σ_c sin 6α [m³]
  heat  ///< Σ_c P/2, P what the contact turns into heat; with a wall P, so that none is lost [W]
};

inline constexpr std::size_t momentCount = static_cast<std::size_t>(Moment::heat) + 1;

/// One number for each Moment.
using Moments = std::array<double, momentCount>;

inline double& at(Moments& moments, Moment which) {
  return moments[static_cast<std::size_t>(which)];
}
inline double at(const Moments& moments, Moment which) {
  return moments[static_cast<std::size_t>(which)];
}

/// How many of what a scene has, for snapshots to be compared with.
struct SceneCounts {
  std::size_t disks, wallDisks, ids;

  template <int D>
  explicit SceneCounts(const SceneOf<D>& scene)
      : disks(scene.disks.size()), wallDisks(scene.wallDiskCount()), ids(scene.idCount()) {}

  /// @param walls  whether their places are needed
  /// @throws std::invalid_argument if the snapshot does not fit
  template <int D>
  void require(const SnapshotOf<D>& snapshot, bool walls) const;
};

/// Computes the moments of snapshots of one scene. In a contact of disk p, f is the force **on** p
/// and l = a_p times the unit vector from p's centre to the contact, the whole radius as in the
/// thesis (the overlap, 10⁻⁵ a, is not taken off). Both disks of a contact take part, each with its
/// own l. Contacts count as the engine reports them, whatever their overlap.
///
/// Wall disks carry stress and couples too: the half of a wall disk that lies in the cell (Lätzel
/// 2003, section 3.2, builds the walls of half disks) holds all of its contacts, so its −Σ f⊗l and
/// −Σ (l × f) l go to the rings that it reaches into, and nothing of them to the overflow bins.
/// Without it the rings at the walls miss the force on its way from the contact to the wall, a
/// sixth of the torque for wall disks of a sixth of the ring's width. All other sums are those of
/// the moving disks; planes have no part in them.
///
/// Cartesian bins have sides that cut walls, and what lies beyond such a side is another bin's:
/// there the wall disk's part of a contact goes where the touching disk's goes, overflow included,
/// and of line methods where the kernel lies. So a box cut in two holds what the whole one holds.
///
/// Line methods put all sums where the kernel about the disk's centre lies, but for stress: that
/// lies along l, turned into the directions of each point of it.
class MomentSums {
 public:
  /// @param coordinates  kept as long as this lives
  /// @param countWallDisks also sums wallVolume; use with an area method, since wall disks are
  ///        centred on R_i and R_o, where all-or-nothing is decided by rounding
  /// @throws std::invalid_argument for a line method without a width
  MomentSums(std::shared_ptr<const Coordinates> coordinates, const std::vector<Weight>& weights,
             const Scene& scene, bool countWallDisks = false);

  /// From now on snapshots are of that scene: other disks, the same walls.
  void changeDisks(const Scene& scene);

  /// Per weight, per slot the moments. Moments that the snapshot has no data for stay zero: ask
  /// Snapshot whether they mean anything.
  /// @throws std::invalid_argument if the snapshot does not fit the scene
  void compute(const Snapshot& snapshot, std::vector<std::vector<Moments>>& sums);

 private:
  /// Sums over one disk's contacts, in the laboratory frame. A vector of cos and sin of 2α turns
  /// like a tensor.
  struct ContactSums {
    Eigen::Matrix2d stress = Eigen::Matrix2d::Zero();  ///< −Σ f⊗l [N m]
    Vec2 couple = Vec2::Zero();                        ///< −Σ (l × f)_z l [N m²]
    Vec2 harmonic2 = Vec2::Zero(), harmonic4 = Vec2::Zero(), harmonic6 = Vec2::Zero();
    Vec2 overlapHarmonic = Vec2::Zero();  ///< Σ δ a (cos 2α, sin 2α) [m²]
    double overlap = 0.0;                 ///< Σ δ a [m²]
    double count = 0.0;
    double heat = 0.0;  ///< [W]
  };

  void fetch(std::int32_t disk) const;
  void sumContacts(const Contacts& contacts);
  void addHeat(const Contacts& contacts, std::size_t c);
  Moments momentsOf(const Snapshot& snapshot, std::size_t disk, const Vec2& er) const;
  void addWalls(const Snapshot& snapshot, Partition& partition, std::vector<Moments>& sums) const;
  void addBranches(const Snapshot& snapshot, Partition& partition,
                   std::vector<Moments>& sums) const;

  std::shared_ptr<const Coordinates> coordinates_;
  std::vector<Partition> sharings_;
  std::vector<double> radius_;  ///< of moving disks, then of wall disks [m]
  std::vector<double> mass_, inertia_;
  SceneCounts counts_;
  bool countWallDisks_;
  std::vector<ContactSums> contactSums_;
};

}  // namespace crossgrain::inline averaging
