#pragma once

#include "results/thesis.hpp"

namespace crossgrain::inline results {

/// Significant digits of what is kept: a thousandth of any scatter between packings and less.
inline constexpr int keptDigits = 6;
inline constexpr int keptDigitsOfErrors = 3, keptDigitsOfDensities = 4;

/// What claims, tables and figures are made of, and no more: a tenth of a run. Profiles are kept of
/// the fields that they read; finer rings and distributions of legs of Table 3.2 and its readings
/// alone; of distributions the rings that they look at; no series, checks and pictures; of
/// collisions e_n and Ψ_f. Numbers of profiles, distributions, histories and collisions are rounded
/// to so many digits, all else is as it was. What was kept once stays: kept(kept(r)) == kept(r).
///
/// A climb keeps before it judges, so that the file says all that its claims rest on, to the bit.
/// The whole of each run stays in the command's folder (runs/).
ThesisResults kept(ThesisResults results);

}  // namespace crossgrain::inline results
