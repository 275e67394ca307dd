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

namespace crossgrain::inline averaging {

/// What a field needs beside positions and velocities.
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
SpringConstants springConstants(const Scene& scene);

/// One bin as its fields see it: moments of it and of its neighbours, and the scene's constants.
class BinView {
 public:
  /// @param means  moments per slot  @pre slot is no overflow; the arguments outlive the view
  BinView(const Coordinates& coordinates, std::span<const Moments> means, std::size_t slot,
          SpringConstants springs = {})
      : coordinates_(coordinates), means_(means), slot_(slot), springs_(springs) {}

  /// A moment; its index among all is slot · momentCount + moment.
  Linear operator[](Moment which) const;

  /// Σ w Q / V
  Linear perVolume(Moment which) const { return (*this)[which] / volume(); }

  bool isEmpty() const { return !((*this)[Moment::volume].value > 0.0); }
  double volume() const { return coordinates_.volume(slot_); }
  double height() const { return coordinates_.height(); }
  double kn() const { return springs_.kn.value(); }
  double kt() const { return springs_.kt.value(); }

  /// Derivative of a field along the first direction, and a field divided by the radius; NaN where
  /// the coordinate has no slope or a neighbour no value.
  Linear slope(Linear (*field)(const BinView&)) const;
  Linear overRadius(const Linear& x) const;

 private:
  const Coordinates& coordinates_;
  std::span<const Moments> means_;
  std::size_t slot_;
  SpringConstants springs_;
};

/// One field: its name and unit as in profiles.csv, how people call and write it, its defining sum
/// as text and as formula. Where there is nothing to measure the formula is not finite (0/0), and
/// the field absent. All labels of reports come from here.
struct FieldSpec {
  std::string_view name;
  std::string_view words;  ///< "shear stress"; empty: the name
  std::string_view symbol;  ///< "σ_rφ", "σ^dyn_rr": marks as in reports/common/labels.hpp; or empty
  std::string_view unit;
  std::string_view definition;
  Needs needs;
  Linear (*formula)(const BinView&);
  /// Grows with what a bin holds (twice the moments, twice the field: a stress) and vanishes with
  /// it, so that a mean over bins weighs it with their volumes; else it is one of the content (a
  /// velocity), which weighs Σ w V, and has no value in an empty bin. Worked out from the formula.
  bool perVolume = false;
};

/// All fields of rings, in the order of profiles.csv.
std::span<const FieldSpec> fieldTable();

/// The same where the directions are x and y, by their names there ("stress_xy", "velocity_x"),
/// without those that only rings have.
std::span<const FieldSpec> cartesianFieldTable();

/// Whichever of them is the coordinate's.
std::span<const FieldSpec> fieldsOf(const Coordinates& coordinates);

/// Of either table. @throws std::invalid_argument if there is no field of that name
const FieldSpec& fieldSpec(std::string_view name);

/// The field in a bin. Absent where there is nothing to measure: in a bin without disks everything
/// but volume_fraction and density, which are 0.
std::optional<Linear> evaluate(const FieldSpec& field, const BinView& bin);

/// Whether the snapshot and the scene hold what the field needs.
bool available(const FieldSpec& field, const Snapshot& snapshot, const SpringConstants& springs);

}  // namespace crossgrain::inline averaging
