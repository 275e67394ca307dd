#pragma once

#include <optional>
#include <string>
#include <vector>

namespace crossgrain::inline results {

/// How far apart two runs are at a time.
struct Separation {
  double time = 0.0;   ///< [s]
  double value = 0.0;  ///< rms distance of disks [d]
};

/// An exponential fitted to growing separations.
struct Growth {
  std::optional<double> exponent, standardError;  ///< λ of exp(λ t) [1/s]; absent: no such part
};

/// A window that is short against chaos.
struct Window {
  double length = 0.0;  ///< [s]
  std::string why;      ///< one sentence
};

/// How a packing's chaos was measured, and the window that follows.
struct ChaosStudy {
  std::vector<Separation> separations;
  Growth growth;
  Window window;
};

}  // namespace crossgrain::inline results
