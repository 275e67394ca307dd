#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "averaging/fits.hpp"
#include "runs/thesis/claims_scope.hpp"
#include "runs/thesis/claims_statistics.hpp"

/// Numbers of one run, read off its profiles. Fields are those of its first method, as verdicts
/// are.
namespace crossgrain::inline runs {

/// Rings whose centres lie in from ≤ r̃ < to.
struct RingSpan {
  double from = 0.0, to = 0.0;
};

/// A ring that has a number.
struct RingValue {
  std::size_t ring = 0;
  double r = 0.0, rTilde = 0.0;  ///< of its centre; [m], [-]
  double value = 0.0;
};

/// Where claims look, by the rules' common numbers.
RingSpan bandOf(const ClaimScope& scope);        ///< from the wheel on
RingSpan insideBandOf(const ClaimScope& scope);  ///< without the first layer
RingSpan bulkOf(const ClaimScope& scope);
/// All rings but those at the walls.
RingSpan offWalls(const LegRun& at);

/// The rings that have the field; none where the run lacks it.
std::vector<RingValue> overRings(const LegRun& at, std::string_view field, const RingSpan& span);
/// Of all rings.
std::vector<RingValue> overRings(const LegRun& at, const Profile* profile);

/// Of ring k = 0 … B−1, with its error within the run.
std::optional<Measured> inRing(const LegRun& at, std::string_view field, std::size_t k);
/// The ring whose centre is next to an r̃; absent without profiles.
std::optional<std::size_t> ringNear(const LegRun& at, double rTilde);
/// B; 0 without profiles.
std::size_t ringCount(const LegRun& at);

std::optional<double> meanOf(const std::vector<RingValue>& rings);
std::optional<double> medianOf(const std::vector<RingValue>& rings);
/// √⟨x²⟩
std::optional<double> rmsOf(const std::vector<RingValue>& rings);
/// Their scatter, √⟨(x − ⟨x⟩)²⟩, over |⟨x⟩|.
std::optional<double> scatterOf(const std::vector<RingValue>& rings);

/// One field over another, ring by ring where both are there and the latter is not 0.
std::vector<RingValue> ratioOf(const LegRun& at, std::string_view field, std::string_view by,
                               const RingSpan& span);

std::optional<double> over(std::optional<double> a, std::optional<double> b);  ///< a/b
std::optional<double> less(std::optional<double> a, std::optional<double> b);  ///< a − b
std::optional<double> logOf(std::optional<double> x);    ///< ln; absent unless x > 0
std::optional<double> log10Of(std::optional<double> x);  ///< absent unless x > 0

/// Mean of axes, that are angles up to π, by their doubled angles; in (−π/2, π/2].
std::optional<double> meanAxis(const std::vector<RingValue>& axes);

/// A parameter that was fitted to the run.
std::optional<Measured> fitOf(const LegRun& at, std::string_view name);

/// Mean over the spans of the averaged time, by their lengths.
std::optional<double> averagedOf(const LegRun& at, std::optional<double> ThesisSpan::*quantity);

}  // namespace crossgrain::inline runs
