#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "averaging/moments.hpp"

namespace crossgrain {

/// What a snapshot must hold for a field to exist.
enum class Needs { kinematics, spin, contacts };

/// How a field is made from a bin's moments.
enum class FieldForm {
  perVolume,  ///< Σ of its moments / volume of the ring
  ratio,      ///< its first moment / its second
  deviator    ///< F_max − F_min of the tensor (rr, φφ, rφ) / volume of the ring
};

/// One field: its name and unit as in profiles.csv, and its defining sum.
struct FieldSpec {
  std::string_view name;
  std::string_view unit;
  std::string_view definition;
  Needs needs;
  FieldForm form;
  std::vector<Moment> moments;
};

/// All fields in the order of profiles.csv.
std::span<const FieldSpec> fieldTable();

/// @throws std::invalid_argument if there is no field of that name
const FieldSpec& fieldSpec(std::string_view name);

/// A field's value and how it answers to small changes of each moment.
struct FieldValue {
  double value = 0.0;
  Moments gradient{};
};

/// The field in a ring of that volume [m³] that holds these moments. Absent where there is nothing
/// to measure: in a ring without disks everything but volume_fraction and density, which are 0.
std::optional<FieldValue> evaluate(const FieldSpec& field, const Moments& moments, double volume);

/// Whether the snapshot holds what the field needs.
bool available(const FieldSpec& field, const Snapshot& snapshot);

}  // namespace crossgrain
