#pragma once

namespace crossgrain::inline averaging {

/// The one-sided level at which each of `analyses` interim analyses, equally many samples apart, is
/// to test so that all of them together reject a true hypothesis with chance alpha (Pocock 1977;
/// Jennison and Turnbull 2000, ch. 2, whose tables are for two sides, and ch. 3 for levels in place
/// of normal quantiles where the scatter is estimated). Successive means go together, so the level
/// is above alpha/analyses, which a union bound gives: 0.0193 for four analyses and 0.05.
/// @pre analyses ≥ 1, 0 < alpha < ½
double pocockLevel(int analyses, double alpha);

}  // namespace crossgrain::inline averaging
