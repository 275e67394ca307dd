#pragma once

#include <array>
#include <memory>
#include <vector>

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"
#include "averaging/moments.hpp"
#include "averaging/space_bins.hpp"

namespace crossgrain::inline averaging {

/// Computes the moments of snapshots of one scene of spheres.
///
/// f is the force on the first sphere and l the branch from the second one's centre to its own,
/// (a_i + a_j − δ) n: compression is positive, the first index is the force's. The branch is
/// the nearest image's: it goes from the first sphere along the contact's normal, and never to
/// where the snapshot has the second one. Whatever the weight, stress lies along it, a bin has the
/// fraction of the branch inside; that is what balances forces slab by slab.
///
/// Of convex bodies branches join centres of mass, and end at walls where the force acts; their
/// volumes are divided among bins by points that fill them (pointsIn()).
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
    std::array<double, 6> fabric{}, overlap{};  ///< Σ_c n⊗n, Σ_c (δ/a) n⊗n [-]
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
  void setBodies(const SpaceScene& scene);

  std::vector<double> mass_, volume_;
  std::vector<std::int32_t> shape_;        ///< −1: a sphere; empty: all are
  std::vector<std::vector<Vec3>> points_;  ///< that fill each shape
  std::optional<BoxOf<3>> box_;
  SceneCounts counts_;
  std::vector<ContactSums> contactSums_;
  BinFractions fractions_;
  std::vector<LineFraction> along_;
};

}  // namespace crossgrain::inline averaging
