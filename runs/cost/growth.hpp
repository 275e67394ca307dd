#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "adapters/scene.hpp"

namespace crossgrain::inline runs {

/// How far apart two runs are at a time.
struct Separation {
  double time;   ///< [s]
  double value;  ///< rms distance of disks [d]
};

/// An exponential fitted to growing separations.
struct Growth {
  std::optional<double> exponent, standardError;  ///< λ of exp(λ t) [1/s]; absent: no such part
};

/// Least squares of log separation over time, between ten times the first separation and `most`,
/// where neither the first steps' reordering nor the size of a disk bends the line. Fewer than four
/// points there, or no growth: absent.
Growth fitGrowth(const std::vector<Separation>& separations, double most);

/// √(Σ|a − b|²/N)/d
double rmsDistance(const std::vector<Vec2>& a, const std::vector<Vec2>& b, double diameter);

/// Every disk moved by that much in a direction of its own, always the same. @param shift [m]
Scene perturbed(Scene scene, double shift);

/// A window that is short against chaos.
struct Window {
  double length;    ///< [s]
  std::string why;  ///< one sentence
};

/// The time until an error of `error` after `start` has grown to `most` at the exponent, as a
/// multiple of `unit`, at least one and at most `longest`.
Window trajectoryWindow(const Growth& growth, double error, double start, double most, double unit,
                        double longest);

}  // namespace crossgrain::inline runs
