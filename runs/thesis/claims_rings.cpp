#include "runs/thesis/claims_rings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace crossgrain::inline runs {
namespace {

/// What rounding leaves between times that were typed in [rotations].
constexpr double sliverBetweenTimes = 1e-6;

double ringWidth(const LegRun& at, std::size_t rings) {
  return (at.leg->cell.outerRadius - at.leg->cell.innerRadius) / static_cast<double>(rings);
}

double mean(const std::vector<RingValue>& rings) {
  double sum = 0.0;
  for (const RingValue& each : rings) sum += each.value;
  return sum / static_cast<double>(rings.size());
}

}  // namespace

RingSpan bandOf(const ClaimScope& scope) {
  return {0.0, scope.common("band_to")};
}

RingSpan insideBandOf(const ClaimScope& scope) {
  return {scope.common("first_layer_to"), scope.common("band_to")};
}

RingSpan bulkOf(const ClaimScope& scope) {
  return {scope.common("bulk_from"), scope.common("bulk_to")};
}

RingSpan offWalls(const LegRun& at) {
  const std::size_t rings = ringCount(at);
  if (rings < 3) return {};
  const double width = ringWidth(at, rings) / at.leg->cell.diameter;
  return {width, width * static_cast<double>(rings - 1)};
}

std::vector<RingValue> overRings(const LegRun& at, const Profile* profile) {
  std::vector<RingValue> rings;
  if (!profile) return rings;
  const double width = ringWidth(at, profile->mean.size());
  for (std::size_t k = 0; k < profile->mean.size(); ++k) {
    const auto& value = profile->mean[k];
    if (!value || !std::isfinite(*value)) continue;
    const double depth = (static_cast<double>(k) + 0.5) * width;
    rings.push_back({k, at.leg->cell.innerRadius + depth, depth / at.leg->cell.diameter, *value});
  }
  return rings;
}

std::vector<RingValue> overRings(const LegRun& at, std::string_view field, const RingSpan& span) {
  std::vector<RingValue> rings = overRings(at, profileOf(at.run->run.profiles, field));
  std::erase_if(rings, [&](const RingValue& each) {
    return each.rTilde < span.from || each.rTilde >= span.to;
  });
  return rings;
}

std::optional<Measured> inRing(const LegRun& at, std::string_view field, std::size_t k) {
  const Profile* const profile = profileOf(at.run->run.profiles, field);
  if (!profile || k >= profile->mean.size() || !profile->mean[k]) return std::nullopt;
  const bool known = k < profile->standardError.size();
  return Measured(*profile->mean[k], known ? profile->standardError[k] : std::nullopt);
}

std::size_t ringCount(const LegRun& at) {
  const std::vector<Profile>& profiles = at.run->run.profiles;
  return profiles.empty() ? 0 : profiles.front().mean.size();
}

std::optional<std::size_t> ringNear(const LegRun& at, double rTilde) {
  const std::size_t rings = ringCount(at);
  if (rings == 0) return std::nullopt;
  const double place = rTilde * at.leg->cell.diameter / ringWidth(at, rings);
  return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(rings) - 0.5));
}

std::optional<double> meanOf(const std::vector<RingValue>& rings) {
  if (rings.empty()) return std::nullopt;
  return mean(rings);
}

std::optional<double> medianOf(const std::vector<RingValue>& rings) {
  if (rings.empty()) return std::nullopt;
  std::vector<double> values;
  for (const RingValue& each : rings) values.push_back(each.value);
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

std::optional<double> rmsOf(const std::vector<RingValue>& rings) {
  if (rings.empty()) return std::nullopt;
  double squares = 0.0;
  for (const RingValue& each : rings) squares += each.value * each.value;
  return std::sqrt(squares / static_cast<double>(rings.size()));
}

std::optional<double> scatterOf(const std::vector<RingValue>& rings) {
  if (rings.size() < 2) return std::nullopt;
  const double middle = mean(rings);
  std::vector<RingValue> off = rings;
  for (RingValue& each : off) each.value -= middle;
  return over(rmsOf(off), std::abs(middle));
}

std::vector<RingValue> ratioOf(const LegRun& at, std::string_view field, std::string_view by,
                               const RingSpan& span) {
  std::vector<RingValue> ratios;
  const std::vector<RingValue> lower = overRings(at, by, span);
  for (RingValue each : overRings(at, field, span)) {
    const auto found = std::ranges::find(lower, each.ring, &RingValue::ring);
    if (found == lower.end() || found->value == 0.0) continue;
    each.value /= found->value;
    ratios.push_back(each);
  }
  return ratios;
}

std::optional<double> over(std::optional<double> a, std::optional<double> b) {
  if (!a || !b || *b == 0.0) return std::nullopt;
  return *a / *b;
}

std::optional<double> less(std::optional<double> a, std::optional<double> b) {
  if (!a || !b) return std::nullopt;
  return *a - *b;
}

std::optional<double> logOf(std::optional<double> x) {
  if (!x || !(*x > 0.0)) return std::nullopt;
  return std::log(*x);
}

std::optional<double> log10Of(std::optional<double> x) {
  if (!x || !(*x > 0.0)) return std::nullopt;
  return std::log10(*x);
}

std::optional<double> meanAxis(const std::vector<RingValue>& axes) {
  if (axes.empty()) return std::nullopt;
  double x = 0.0, y = 0.0;
  for (const RingValue& each : axes) {
    x += std::cos(2.0 * each.value);
    y += std::sin(2.0 * each.value);
  }
  return 0.5 * std::atan2(y, x);
}

std::optional<Measured> fitOf(const LegRun& at, std::string_view name) {
  const std::vector<FitRow>& fits = at.run->run.fits;
  const auto found = std::ranges::find(fits, name, &FitRow::name);
  if (found == fits.end() || !found->value) return std::nullopt;
  return Measured(*found->value, found->standardError);
}

std::optional<double> averagedOf(const LegRun& at, std::optional<double> ThesisSpan::*quantity) {
  double sum = 0.0, length = 0.0;
  for (const ThesisSpan& span : at.run->history) {
    if (span.from < at.leg->settleRotations - sliverBetweenTimes || !(span.*quantity)) continue;
    sum += (span.to - span.from) * *(span.*quantity);
    length += span.to - span.from;
  }
  return over(sum, length);
}

}  // namespace crossgrain::inline runs
