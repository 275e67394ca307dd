#pragma once

#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "averaging/block_series.hpp"
#include "averaging/fields.hpp"
#include "averaging/moments.hpp"
#include "averaging/rings.hpp"
#include "averaging/weights.hpp"

namespace crossgrain::inline averaging {

/// One field against the radius, under one method: time means over a run, one entry per ring (or
/// bin, in the order of slots, overflow left out).
struct Profile {
  std::string method;  ///< "slicing", …
  std::string field;   ///< as in profiles.csv
  std::string unit;
  std::vector<std::optional<double>> mean;
  /// Standard error of the mean within this run, autocorrelation accounted for: it is conditional
  /// on the packing and says nothing about other packings.
  std::vector<std::optional<double>> standardError;
  std::vector<std::optional<double>> nEff;  ///< independent samples that the run is worth
  std::vector<std::optional<double>> dof;   ///< of Student's t for a confidence interval
};

/// Collects the snapshots of one run and averages them over time.
///
/// The time mean of a field is the field of the time-mean moments: a velocity is ⟨Σ w V v⟩/⟨Σ w V⟩
/// and not the mean of the rings' momentary velocities, and fabric_deviator that of the mean fabric
/// tensor. Its error comes from the series Σ_q ∂field/∂moment_q (moment_q(t) − ⟨moment_q⟩), over
/// the moments of all bins that the field is made of; for a ratio that is (numerator −
/// mean·denominator)/⟨denominator⟩. Memory does not grow with the number of snapshots
/// (BlockSeries).
template <int D>
class ProfileAccumulatorOf {
 public:
  using Coordinates = std::conditional_t<D == 2, averaging::Coordinates, SpaceBins>;
  using Moments = MomentsOf<D>;
  using Sums = std::conditional_t<D == 2, MomentSums, SpaceMomentSums>;

  /// @param countWallDisks adds the wall disks' area in the rings to volume_fraction; off in the
  ///        thesis' labels ν̄ (see MomentSums)
  ProfileAccumulatorOf(std::shared_ptr<const Coordinates> coordinates, std::vector<Weight> weights,
                       const Scene& scene, bool countWallDisks = false) requires(D == 2)
      : ProfileAccumulatorOf(coordinates, weights,
                             MomentSums(coordinates, weights, scene, countWallDisks),
                             springConstants(scene)) {}

  /// Over rings.
  ProfileAccumulatorOf(const Rings& rings, std::vector<Weight> weights, const Scene& scene,
                       bool countWallDisks = false) requires(D == 2)
      : ProfileAccumulatorOf(std::make_shared<Rings>(rings), std::move(weights), scene,
                             countWallDisks) {}

  ProfileAccumulatorOf(std::shared_ptr<const SpaceBins> bins, std::vector<Weight> weights,
                       const SpaceScene& scene) requires(D == 3)
      : ProfileAccumulatorOf(bins, weights, SpaceMomentSums(bins, weights, scene),
                             springConstants(scene)) {}

  /// @throws std::invalid_argument if the snapshot does not fit the scene, or has spin or contacts
  ///         where earlier ones had none (or the other way round)
  void add(const SnapshotOf<D>& snapshot);

  /// From now on snapshots are of that scene: other disks, the same walls and springs.
  void changeDisks(const SceneOf<D>& scene) { sums_.changeDisks(scene); }

  std::size_t snapshots() const { return snapshots_; }

  /// Every field that the snapshots have data for, method by method. Empty before the first add.
  std::vector<Profile> profiles() const;

  /// Snapshots of part k of n equal parts of the run, as indices [first, last), whole blocks of
  /// them; the last few may be of none. Absent where there are fewer blocks than parts.
  std::optional<std::pair<std::size_t, std::size_t>> part(std::size_t k, std::size_t n) const;
  /// Means alone, of the run without those snapshots. @pre part(k, n)
  std::vector<Profile> profilesWithout(std::size_t k, std::size_t n) const;

  /// Time-mean moments per slot, overflow included, of the weight of that index.
  std::vector<Moments> meanMoments(std::size_t weight) const;

 private:
  ProfileAccumulatorOf(std::shared_ptr<const Coordinates> coordinates, std::vector<Weight> weights,
                       Sums sums, SpringConstants springs)
      : coordinates_(std::move(coordinates)),
        weights_(std::move(weights)),
        springs_(springs),
        sums_(std::move(sums)),
        series_(weights_.size(), BlockSeries(coordinates_->slots() * std::tuple_size_v<Moments>)) {}

  /// Of every field and weight. @param meansOf  of a weight @param errors  whether they are wanted
  template <typename MeansOf>
  std::vector<Profile> profilesOf(MeansOf&& meansOf, bool errors) const;
  Profile profile(std::size_t weight, const FieldSpec& field, const std::vector<Moments>& mean,
                  bool errors) const;

  std::shared_ptr<const Coordinates> coordinates_;
  std::vector<Weight> weights_;
  SpringConstants springs_;
  Sums sums_;
  std::vector<BlockSeries> series_;              ///< per weight, of all moments of all slots
  std::vector<std::vector<Moments>> momentary_;  ///< of the last snapshot
  std::size_t snapshots_ = 0;
  std::vector<const FieldSpec*> fields_;          ///< those that the snapshots have data for
  bool reportsHeat_ = false, lacksHeat_ = false;  ///< whether snapshots have Contacts::dissipation
};
using ProfileAccumulator = ProfileAccumulatorOf<2>;

}  // namespace crossgrain::inline averaging
