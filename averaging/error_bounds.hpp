#pragma once

#include <algorithm>
#include <limits>
#include <optional>

namespace crossgrain::inline averaging {

/// Ends of a confidence interval.
struct ErrorInterval {
  double low = 0.0, high = 0.0;
};

/// An error as it was measured, and what it is uncertain by. All in the same unit.
struct MeasuredError {
  double value = 0.0;
  std::optional<double> statistical;  ///< its standard error
  std::optional<double> reference;    ///< the error of what it was compared with
  /// Whether repeats of the measurement scatter. An error that does and whose scatter nobody knows,
  /// as that of averages over a single packing, says nothing: it does not count anywhere.
  bool scatters = false;
  /// Of an error whose scatter is given by a confidence interval, that interval.
  std::optional<ErrorInterval> interval = {};
  /// By how much it can differ from 0 by another argument than this measurement.
  std::optional<double> bound = {};

  bool saysNothing() const { return scatters && !statistical && !bound; }
  double uncertainty() const {
    return scatters && !statistical ? std::numeric_limits<double>::infinity()
                                    : statistical.value_or(0.0) + reference.value_or(0.0);
  }
  /// The interval that the true error lies in, the lower end at least 0.
  double low() const { return interval ? interval->low : std::max(0.0, value - uncertainty()); }
  double high() const { return boundCounts() ? *bound : measuredHigh(); }
  /// Whether the bound is the smaller of the two. One that the measurement excludes does not count.
  bool boundCounts() const { return bound && *bound >= low() && *bound < measuredHigh(); }
  /// Below its own standard error or the reference's.
  bool mayBeChance() const {
    return value < statistical.value_or(0.0) || value < reference.value_or(0.0);
  }
  /// What it counts with where it is compared or drawn: the value, but its upper bound where it may
  /// be chance. Absent where it says nothing.
  std::optional<double> counted() const {
    if (saysNothing()) return std::nullopt;
    return mayBeChance() ? high() : std::min(value, high());
  }

 private:
  double measuredHigh() const { return interval ? interval->high : value + uncertainty(); }
};

}  // namespace crossgrain::inline averaging
