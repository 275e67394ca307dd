#pragma once

#include <algorithm>
#include <limits>
#include <optional>

namespace crossgrain::inline averaging {

/// An error as it was measured, and what it is uncertain by. All three in the same unit.
struct MeasuredError {
  double value = 0.0;
  std::optional<double> statistical;  ///< its standard error
  std::optional<double> reference;    ///< the error of what it was held against
  /// Whether repeats of the measurement scatter. An error that does and whose scatter nobody knows,
  /// as that of averages over a single packing, says nothing: it does not count anywhere.
  bool scatters = false;

  bool saysNothing() const { return scatters && !statistical; }
  double uncertainty() const {
    return saysNothing() ? std::numeric_limits<double>::infinity()
                         : statistical.value_or(0.0) + reference.value_or(0.0);
  }
  /// The interval that the true error lies in, the lower end at least 0.
  double low() const { return std::max(0.0, value - uncertainty()); }
  double high() const { return value + uncertainty(); }
  /// Below its own standard error or the reference's.
  bool mayBeChance() const {
    return value < statistical.value_or(0.0) || value < reference.value_or(0.0);
  }
  /// What it counts with where it is compared or drawn: the value, but its upper bound where it may
  /// be chance. Absent where it says nothing.
  std::optional<double> counted() const {
    if (saysNothing()) return std::nullopt;
    return mayBeChance() ? high() : value;
  }
};

}  // namespace crossgrain::inline averaging
