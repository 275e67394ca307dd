#pragma once

#include <array>
#include <memory>
#include <vector>

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"
#include "averaging/moments.hpp"
#include "averaging/space_bins.hpp"

namespace crossgrain::inline averaging {

/// The sums that fields in space are made of: Σ_p w_p Q_p over the moving spheres, with w the
/// sphere's fraction in the bin, V = 4π a³/3 its volume and m its mass; and Σ_c w_c Q_c over
/// contacts, with w_c the fraction of the branch. Components are along the bin's directions: (x, y,
/// z), or (r, φ, z). Those of a vector or tensor follow each other: the first one is named.
enum class SpaceMoment : std::size_t {
  volume,                    ///< V [m³]; first, as in the plane
  mass,                      ///< m [kg]
  momentum,                  ///< m v_α [kg m/s]
  spin = momentum + 3,       ///< m ω_α [kg rad/s]
  dynamic = spin + 3,        ///< m v_α v_β: xx, yy, zz, xy, xz, yz [N m]
  fabric = dynamic + 6,      ///< V Σ_c n_α n_β over the sphere's contacts, likewise [m³]
  contacts = fabric + 6,     ///< V C, C the sphere's number of contacts, those with walls included
                             ///< [m³]
  heldVolume,                ///< V of spheres with C ≥ 4 [m³]
  heldContacts,              ///< V C of those [m³]
  heat,                      ///< Σ_c P/2, P what the contact turns into heat; with a wall P [W]
  stress,                    ///< per contact f_α l_β, row by row: xx, xy, xz, yx … [N m]
  branches = stress + 9,     ///< per contact 1 [-]
  wallForce = branches + 1,  ///< per contact with a wall the force on the sphere, where it acts [N]
  end = wallForce + 3
};

inline constexpr std::size_t spaceMomentCount = static_cast<std::size_t>(SpaceMoment::end);

using SpaceMoments = std::array<double, spaceMomentCount>;

/// The moment so many places further on.
constexpr SpaceMoment operator+(SpaceMoment first, int further) {
  return static_cast<SpaceMoment>(static_cast<std::size_t>(first) +
                                  static_cast<std::size_t>(further));
}

inline double& at(SpaceMoments& moments, SpaceMoment which) {
  return moments[static_cast<std::size_t>(which)];
}
inline double at(const SpaceMoments& moments, SpaceMoment which) {
  return moments[static_cast<std::size_t>(which)];
}

/// Contacts that hold a sphere in place. One with fewer is a rattler, or on its way to be one; C*
/// counts only spheres with as many (Göncü, Durán and Luding 2010, C. R. Mécanique 338:570: M₄/N₄).
inline constexpr double fewestThatHold = 4.0;

/// Of dynamic stress and fabric, in their order.
inline constexpr std::array<std::array<int, 2>, 6> symmetricComponents = {
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};

/// Computes the moments of snapshots of one scene of spheres.
///
/// f is the force on the first sphere and l the branch from the second one's centre to its own,
/// (a_i + a_j − δ) n: compression is positive, the first index is the force's. The branch is
/// the nearest image's: it goes from the first sphere along the contact's normal, and never to
/// where the snapshot has the second one. Whatever the weight, stress lies along it, a bin has the
/// fraction of the branch inside; that is what balances forces slab by slab.
///
/// Against a wall, a sphere of one or a plane, the branch ends where the force acts, a − δ/2 from
/// the centre or on the plane, and there the force enters as one from outside (Weinhart et al.
/// 2012, Granular Matter 14:289): with t = Σ_c f φ at those points, at rest
/// ∂σ_αβ/∂x_β = t_α + ρ g_α up to the wall, with any function φ.
class SpaceMomentSums {
 public:
  /// @param bins  kept as long as this lives
  /// @throws std::invalid_argument if the bins do not go with a weight
  SpaceMomentSums(std::shared_ptr<const SpaceBins> bins, const std::vector<Weight>& weights,
                  const SpaceScene& scene);

  /// As MomentSums'.
  void changeDisks(const SpaceScene& scene);

  /// Per weight, per slot the moments. Moments that the snapshot has no data for stay zero: ask
  /// SpaceSnapshot whether they mean anything.
  /// @throws std::invalid_argument if the snapshot does not fit the scene
  void compute(const SpaceSnapshot& snapshot, std::vector<std::vector<SpaceMoments>>& sums);

 private:
  /// Sums over one sphere's contacts.
  struct ContactSums {
    std::array<double, 6> fabric{};
    double count = 0.0;
    double heat = 0.0;  ///< [W]
  };

  void sumContacts(const ContactsOf<3>& contacts);
  SpaceMoments momentsOf(const SpaceSnapshot& snapshot, std::size_t sphere) const;
  void addBranches(const SpaceSnapshot& snapshot, const Weight& weight,
                   std::vector<SpaceMoments>& sums);

  std::shared_ptr<const SpaceBins> bins_;
  std::vector<Weight> weights_;
  std::vector<double> radius_;  ///< of moving spheres, then of wall spheres [m]
  std::vector<double> mass_;
  SceneCounts counts_;
  std::vector<ContactSums> contactSums_;
  BinFractions fractions_;
  std::vector<LineFraction> along_;
};

}  // namespace crossgrain::inline averaging
