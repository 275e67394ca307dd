#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "adapters/scene.hpp"
#include "averaging/coordinates.hpp"
#include "averaging/linear.hpp"
#include "averaging/moments.hpp"
#include "averaging/space_moments.hpp"

namespace crossgrain::inline averaging {

/// Needs of a field beside positions and velocities.
enum class Needs {
  kinematics,  ///< no more
  spin,
  contacts,
  normalSpring,      ///< contacts, and a scene whose law has a constant k_n
  tangentialSpring,  ///< contacts, and a scene whose law has a constant k_t
  dissipation        ///< contacts whose dissipation the engine reports
};

/// Stiffnesses of the scene's law that some fields are made with; absent where it has none.
struct SpringConstants {
  std::optional<double> kn, kt;  ///< [N/m]
};
template <int D>
SpringConstants springConstants(const SceneOf<D>& scene);

/// One bin as its fields see it: moments of it and of its neighbours, and the scene's constants.
class BinView {
 public:
  /// @param means  moments per slot  @pre slot is no overflow; the arguments outlive the view
  BinView(const Coordinates& coordinates, std::span<const Moments> means, std::size_t slot,
          SpringConstants springs = {})
      : BinView(coordinates, means.front().data(), slot, springs) {}
  /// In space.
  BinView(const SpaceBins& bins, std::span<const SpaceMoments> means, std::size_t slot,
          SpringConstants springs = {})
      : BinView(bins, means.front().data(), slot, springs) {}

  /// Number k of a moment; its index among all is slot · (numbers per slot) + its place there. 0
  /// where the dimension has no such moment.
  Linear sum(Moment which, int k = 0) const;

  /// Σ w Q / V
  Linear perVolume(Moment which, int k = 0) const { return sum(which, k) / volume(); }

  bool isEmpty() const { return !(sum(Moment::volume).value > 0.0); }
  int dimension() const { return bins_.dimension(); }
  double volume() const { return bins_.volume(slot_); }
  /// @pre in the plane
  double height() const { return static_cast<const Coordinates&>(bins_).height(); }
  double kn() const { return springs_.kn.value(); }
  double kt() const { return springs_.kt.value(); }

  /// Derivative of a field along the first direction, and a field divided by the radius; NaN where
  /// the coordinate has no slope or a neighbour no value.
  Linear slope(Linear (*field)(const BinView&)) const;
  Linear overRadius(const Linear& x) const;

 private:
  BinView(const BinSet& bins, const double* means, std::size_t slot, SpringConstants springs)
      : bins_(bins), means_(means), slot_(slot), springs_(springs) {}

  const BinSet& bins_;
  const double* means_;  ///< slot by slot
  std::size_t slot_;
  SpringConstants springs_;
};

/// One field: its name and unit as in profiles.csv, how people call and write it, its defining sum
/// as text and as formula. Where there is nothing to measure the formula is not finite (0/0), and
/// the field absent. All labels of reports come from here.
struct FieldSpec {
  std::string_view name;
  std::string_view words;   ///< "shear stress"; empty: the name
  std::string_view symbol;  ///< "σ_rφ", "σ^dyn_rr": marks as in reports/common/text.hpp; or empty
  std::string_view unit;
  std::string_view definition;
  Needs needs;
  Linear (*formula)(const BinView&);
  /// Grows with what a bin holds (twice the moments, twice the field: a stress) and vanishes with
  /// it, so that a mean over bins weighs it with their volumes; else it is one of the content (a
  /// velocity), which weighs Σ w V, and has no value in an empty bin. Worked out from the formula.
  bool perVolume = false;
};

/// Whether f(2m) = 2 f(m), on moments m with nothing special about them; ratios have f(2m) = f(m).
bool growsWithContent(const FieldSpec& field, int dimension);

/// All fields of bins, in the order of profiles.csv: with the directions of rings about the z axis
/// ("stress_rp", "radial_velocity") or x, y and z ("stress_xy", "velocity_x"). A name has one unit
/// and one meaning in both dimensions.
std::span<const FieldSpec> fieldsIn(int dimension, bool rings);
std::span<const FieldSpec> fieldsOf(const BinSet& bins);

/// Of any bins; null if there is no field of that name.
const FieldSpec* findField(std::string_view name);

/// @throws std::invalid_argument if there is no field of that name
const FieldSpec& fieldSpec(std::string_view name);

/// The field in a bin. Absent where there is nothing to measure: in a bin without disks everything
/// but volume_fraction and density, which are 0.
std::optional<Linear> evaluate(const FieldSpec& field, const BinView& bin);

/// Whether the snapshot and the scene hold what the field needs.
template <int D>
bool available(const FieldSpec& field, const SnapshotOf<D>& snapshot,
               const SpringConstants& springs);

}  // namespace crossgrain::inline averaging
