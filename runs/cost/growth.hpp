#pragma once

#include <vector>

#include "adapters/scene.hpp"
#include "results/cost_chaos.hpp"

namespace crossgrain::inline runs {

/// Least squares of log separation over time, between ten times the first separation and `most`,
/// where neither the first steps' reordering nor the size of a disk bends the line. Fewer than four
/// points there, or no growth: absent.
Growth fitGrowth(const std::vector<Separation>& separations, double most);

/// √(Σ|a − b|²/N)/d
double rmsDistance(const std::vector<Vec2>& a, const std::vector<Vec2>& b, double diameter);

/// Every disk moved by that much in a direction of its own, always the same. @param shift [m]
Scene perturbed(Scene scene, double shift);

/// The time until an error of `error` after `start` has grown to `most` at the exponent, as a
/// multiple of `unit`, at least one and at most `longest`.
Window trajectoryWindow(const Growth& growth, double error, double start, double most, double unit,
                        double longest);

}  // namespace crossgrain::inline runs
