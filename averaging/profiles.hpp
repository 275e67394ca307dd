#pragma once

#include <optional>
#include <string>
#include <vector>

#include "averaging/fields.hpp"
#include "averaging/moments.hpp"
#include "averaging/rings.hpp"
#include "averaging/weights.hpp"

namespace crossgrain {

/// One field against the radius, under one method: time means over a run, one entry per ring.
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
/// tensor. Its error comes from the series Σ_q ∂field/∂moment_q (moment_q(t) − ⟨moment_q⟩); for a
/// ratio that is (numerator − mean·denominator)/⟨denominator⟩.
class ProfileAccumulator {
 public:
  /// @param countWallDisks adds the wall disks' area in the rings to volume_fraction; off in the
  ///        thesis' labels ν̄ (see MomentSums)
  ProfileAccumulator(Rings rings, std::vector<WeightMethod> methods, const Scene& scene,
                     bool countWallDisks = false);

  /// @throws std::invalid_argument if the snapshot does not fit the scene, or has spin or contacts
  ///         where earlier ones had none (or the other way round)
  void add(const Snapshot& snapshot);

  std::size_t snapshots() const { return series_.size(); }
  const Rings& rings() const { return rings_; }

  /// Every field that the snapshots have data for, method by method. Empty before the first add.
  std::vector<Profile> profiles() const;

  /// Time-mean moments per bin (Rings::slot), overflow included, of the method of that index.
  std::vector<Moments> meanMoments(std::size_t method) const;

 private:
  Profile profile(std::size_t method, const FieldSpec& field,
                  const std::vector<Moments>& mean) const;

  Rings rings_;
  std::vector<WeightMethod> methods_;
  MomentSums sums_;
  std::vector<std::vector<std::vector<Moments>>> series_;  ///< snapshot, method, bin
  std::vector<const FieldSpec*> fields_;  ///< those that the snapshots have data for
};

}  // namespace crossgrain
