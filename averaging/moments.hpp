#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <tuple>
#include <type_traits>
#include <vector>

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"
#include "averaging/coordinates.hpp"
#include "averaging/weights.hpp"

namespace crossgrain::inline averaging {

/// The sums that every field is made of, in the plane and in space. Each is Σ_p w_p Q_p over the
/// moving bodies p, with w the body's fraction in the bin, V its volume (π a² h of a disk, 4π a³/3
/// of a sphere), m its mass and J its moment of inertia; those of branches are Σ_c w_c Q_c over
/// contacts, with w_c the fraction of the branch. Components are along the bin's directions, (x, y,
/// z) or (r, φ, z), for disks the first two, at each body's own place (Lätzel 2003, section 5.1).
enum class Moment : std::size_t {
  volume,          ///< V [m³]
  wallVolume,      ///< V of wall disks, only if asked for [m³]
  mass,            ///< m [kg]
  momentum,        ///< m v_α [kg m/s]
  volumeVelocity,  ///< V v_α [m⁴/s]
  spin,            ///< V ω_α [m³/s]
  spinEnergy,      ///< ½ J ω² of disks [N m]
  stress,  ///< of disks −Σ_c f_α l_β, in space per branch f_α l_β [N m]; first index force,
           ///< second branch (= face normal)
  wallStress,    ///< −Σ_c f_α l_β of wall disks [N m]
  couple,        ///< −Σ_c (l × f)_z l_α of disks [N m²]
  wallCouple,    ///< −Σ_c (l × f)_z l_α of wall disks [N m²]
  dynamic,       ///< m v_α v_β [N m]
  fabric,        ///< V Σ_c n_α n_β over the body's contacts [m³]
  contacts,      ///< V C, C the body's number of contacts, those with walls included [m³]
  heldVolume,    ///< V of bodies with C > D: one with fewer contacts is a rattler [m³]
  heldContacts,  ///< V C of those [m³]
  overlap,       ///< V Σ_c (δ/a) n_α n_β [m³]
  harmonics,  ///< V Σ_c (cos 4α, sin 4α, cos 6α, sin 6α), α the angle of n in the plane [m³]
  heat,  ///< Σ_c P/2, P what the contact turns into heat; with a wall P, so that none is lost [W]
  branches,   ///< in space per contact 1 [-]
  wallForce,  ///< in space per contact with a wall the force on the sphere, where it acts [N]
  end
};

/// Indices of a tensor's components in the order of moments and fields: the diagonal, then pairs.
/// Of a symmetric tensor one of each pair, row < column.
template <int D>
inline constexpr auto tensorIn = [] {
  constexpr std::array<std::array<int, 2>, 9> all = {
      {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 0}, {0, 2}, {2, 0}, {1, 2}, {2, 1}}};
  std::array<std::array<int, 2>, D * D> result{};
  std::ranges::copy_if(all, result.begin(), [](const auto& q) { return q[0] < D && q[1] < D; });
  return result;
}();
template <int D>
inline constexpr auto symmetricIn = [] {
  std::array<std::array<int, 2>, D*(D + 1) / 2> result{};
  std::ranges::copy_if(tensorIn<D>, result.begin(), [](const auto& q) { return q[0] <= q[1]; });
  return result;
}();

/// How many numbers a moment has; none in the dimension that does without it.
constexpr std::size_t numbersOf(Moment which, int dimension) {
  const bool plane = dimension == 2;
  const auto d = static_cast<std::size_t>(dimension);
  using enum Moment;
  switch (which) {
    case momentum:
    case volumeVelocity:
      return d;
    case spin:
      return plane ? 1 : 3;
    case stress:
      return d * d;
    case dynamic:
    case fabric:
    case overlap:
      return d * (d + 1) / 2;
    case wallVolume:
    case spinEnergy:
      return plane ? 1 : 0;
    case couple:
    case wallCouple:
      return plane ? 2 : 0;
    case wallStress:
    case harmonics:
      return plane ? 4 : 0;
    case branches:
      return plane ? 0 : 1;
    case wallForce:
      return plane ? 0 : 3;
    default:
      return 1;
  }
}

/// Where the numbers of each moment begin, and at `end` how many there are.
using MomentPlaces = std::array<std::size_t, static_cast<std::size_t>(Moment::end) + 1>;
constexpr MomentPlaces momentPlacesIn(int dimension) {
  MomentPlaces places{};
  for (std::size_t m = 0; m + 1 < places.size(); ++m)
    places[m + 1] = places[m] + numbersOf(static_cast<Moment>(m), dimension);
  return places;
}
template <int D>
inline constexpr MomentPlaces momentPlaces = momentPlacesIn(D);

/// All numbers of one bin.
template <int D>
using MomentsOf = std::array<double, momentPlaces<D>.back()>;
using Moments = MomentsOf<2>;
using SpaceMoments = MomentsOf<3>;

/// One number of a bin's: of a moment, the k-th.
template <typename SomeMoments>
auto& at(SomeMoments& moments, Moment which, int k = 0) {
  constexpr int D =
      std::tuple_size_v<std::remove_const_t<SomeMoments>> == std::tuple_size_v<Moments> ? 2 : 3;
  return moments[momentPlaces<D>[static_cast<std::size_t>(which)] + static_cast<std::size_t>(k)];
}

/// Adds a body's motion: all that needs neither spin nor contact. @param v  along the bin's
/// directions [m/s]
template <int D>
void addMotion(MomentsOf<D>& moments, double volume, double mass, const VecOf<D>& v) {
  at(moments, Moment::volume) = volume;
  at(moments, Moment::mass) = mass;
  for (int k = 0; k < D; ++k) {
    at(moments, Moment::momentum, k) = mass * v[k];
    at(moments, Moment::volumeVelocity, k) = volume * v[k];
  }
  for (int q = 0; q < D * (D + 1) / 2; ++q) {
    const auto [row, column] = symmetricIn<D>[static_cast<std::size_t>(q)];
    at(moments, Moment::dynamic, q) = mass * v[row] * v[column];
  }
}

/// Adds a body's number of contacts. One with fewer than D + 1 is a rattler, or on its way to
/// be one: C* counts only the others (Göncü, Durán and Luding 2010, C. R. Mécanique 338:570:
/// M₄/N₄).
template <int D>
void addContactCounts(MomentsOf<D>& moments, double volume, double count) {
  at(moments, Moment::contacts) = volume * count;
  if (count < D + 1.0) return;
  at(moments, Moment::heldVolume) = volume;
  at(moments, Moment::heldContacts) = volume * count;
}

/// Adds what one body has to the bins that it lies in.
template <typename SomeMoments>
void distribute(const SomeMoments& moments, const BinFractions& fractions,
                std::vector<SomeMoments>& sums) {
  // Side by side, which a loop is not.
  using All = Eigen::Array<double, std::tuple_size_v<SomeMoments>, 1>;
  for (const auto& [slot, w] : fractions)
    All::Map(sums[slot].data()) += w * All::Map(moments.data());
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
/// own l. Of convex bodies l goes to the point where the force acts, and areas are those of their
/// outlines. Contacts count as the engine reports them, whatever their overlap.
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

  void setBodies(const Scene& scene);
  void fetch(std::int32_t disk) const;
  void sumContacts(const Snapshot& snapshot);
  /// Of disk p in contact c, from its centre to where the force acts [m].
  Vec2 arm(const Snapshot& snapshot, std::size_t c, std::size_t p) const;
  void addHeat(const Contacts& contacts, std::size_t c);
  Moments momentsOf(const Snapshot& snapshot, std::size_t disk, const Vec2& er) const;
  void addWalls(const Snapshot& snapshot, Partition& partition, std::vector<Moments>& sums) const;
  void addBranches(const Snapshot& snapshot, Partition& partition,
                   std::vector<Moments>& sums) const;

  std::shared_ptr<const Coordinates> coordinates_;
  std::vector<Partition> sharings_;
  std::vector<double> radius_;  ///< of moving disks, then of wall disks [m]
  std::vector<double> mass_, inertia_, area_;
  std::vector<std::int32_t> shape_;  ///< −1: a disk; empty: all are
  std::vector<std::vector<Vec2>> outlines_;
  std::optional<BoxOf<2>> box_;
  SceneCounts counts_;
  bool countWallDisks_;
  std::vector<ContactSums> contactSums_;
};

}  // namespace crossgrain::inline averaging
