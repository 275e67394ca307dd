// Velocity and spin profiles: C7, C8, C10, C22.
#include <algorithm>
#include <cmath>

#include "runs/thesis/claims_judges.hpp"
#include "runs/thesis/claims_rings.hpp"

namespace crossgrain::inline runs {
namespace {

/// Root mean square distance of ln v_φ from its straight line in r̃. Absent with fewer than four
/// rings that turn with the wheel.
std::optional<double> roughnessOf(const LegRun& at, double to) {
  const double wheel = at.leg->cell.omega;
  std::vector<RingValue> rings = overRings(at, "azimuthal_velocity", {0.0, to});
  std::erase_if(rings, [&](const RingValue& each) { return !(each.value * wheel > 0.0); });
  if (rings.size() < 4) return std::nullopt;
  const auto n = static_cast<double>(rings.size());
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (RingValue& each : rings) {
    each.value = std::log(each.value / wheel);
    x += each.rTilde / n;
    y += each.value / n;
  }
  for (const RingValue& each : rings) {
    xx += (each.rTilde - x) * (each.rTilde - x);
    xy += (each.rTilde - x) * (each.value - y);
  }
  for (RingValue& each : rings) each.value -= y + xy / xx * (each.rTilde - x);
  return rmsOf(rings);
}

/// S d/(ΩD), D = 2R_i, per S.
double spinUnit(const LegRun& at) {
  const CouetteCell& cell = at.leg->cell;
  return cell.diameter / (cell.omega * 2.0 * cell.innerRadius);
}

std::optional<Measured> scaledSpin(const LegRun& at, std::size_t ring) {
  const auto spin = inRing(at, "spin", ring);
  if (!spin) return std::nullopt;
  const double unit = spinUnit(at);
  std::optional<double> error;
  if (spin->within) error = std::abs(unit) * *spin->within;
  return Measured(spin->value * unit, error);
}

/// Twice the distance from the deepest trough to the highest peak beyond it, on fine rings.
std::optional<double> periodOf(const LegRun& at, double fewest, double within) {
  for (const RingAverages& fine : at.run->finer) {
    if (fine.rings < fewest) continue;
    const Profile* profile = profileOf(fine.profiles, "centre", "spin");
    if (!profile) profile = profileOf(fine.profiles, "spin");
    std::vector<RingValue> rings = overRings(at, profile);
    std::erase_if(rings, [&](const RingValue& each) { return each.rTilde > within; });
    if (rings.size() < 4) continue;
    const double wheel = at.leg->cell.omega;
    const auto turning = [&](const RingValue& each) { return each.value * wheel; };
    const auto trough = std::ranges::min_element(rings, {}, turning);
    const auto peak = std::ranges::max_element(trough, rings.end(), {}, turning);
    if (peak != trough) return 2.0 * (peak->rTilde - trough->rTilde);
  }
  return std::nullopt;
}

/// Root mean square of v_r about its mean [m/s].
std::optional<double> radialWidth(const LegRun& at, std::size_t ring) {
  const auto stress = inRing(at, "fluctuation_stress_rr", ring);
  const auto density = inRing(at, "density", ring);
  if (!stress || !density || !(stress->value >= 0.0) || !(density->value > 0.0))
    return std::nullopt;
  return std::sqrt(stress->value / density->value);
}

RunFigure radialMean(double rTilde) {
  return [=](const LegRun& at) -> std::optional<Measured> {
    const auto ring = ringNear(at, rTilde);
    if (!ring) return std::nullopt;
    const auto velocity = inRing(at, "radial_velocity", *ring);
    if (!velocity) return std::nullopt;
    return over(velocity->value, radialWidth(at, *ring));
  };
}

}  // namespace

void judgeVelocityDecay(const ClaimScope& scope, Evidence& evidence) {
  const RunSet set = scope.flow();
  const double to = scope.number("fit_to");
  const auto amplitude = [](const LegRun& at) { return fitOf(at, "velocity_amplitude"); };
  evidence.mean("length", set, [](const LegRun& at) { return fitOf(at, "velocity_decay"); });
  evidence.mean("roughness", set,
                [=](const LegRun& at) -> std::optional<Measured> { return roughnessOf(at, to); });
  evidence.mean("slip", set, amplitude);
  evidence.trend("with_density", scope.upward(), amplitude);
}

void judgeSpinOscillation(const ClaimScope& scope, Evidence& evidence) {
  const RunSet flow = scope.flow(), printed = scope.at(scope.number("label"));
  evidence.mean("first_layer", flow, [](const LegRun& at) { return scaledSpin(at, 0); });
  evidence.mean("second_layer", flow, [](const LegRun& at) { return scaledSpin(at, 1); });
  evidence.mean("period", flow, [&](const LegRun& at) -> std::optional<Measured> {
    return periodOf(at, scope.number("fewest_fine"), scope.number("period_within"));
  });
  evidence.mean("amplitude", printed, [](const LegRun& at) { return fitOf(at, "spin_amplitude"); });
  evidence.mean("decay", printed, [](const LegRun& at) { return fitOf(at, "spin_decay"); });
  evidence.mean("phase", printed, [](const LegRun& at) { return fitOf(at, "spin_phase"); });
}

void judgeRadialVelocities(const ClaimScope& scope, Evidence& evidence) {
  const RunSet set = scope.flow();
  const double inner = scope.number("inner"), outer = scope.number("outer");
  const auto width = [](const LegRun& at, double rTilde) -> std::optional<double> {
    const auto ring = ringNear(at, rTilde);
    if (!ring) return std::nullopt;
    return radialWidth(at, *ring);
  };
  evidence.mean("inner_mean", set, radialMean(inner));
  evidence.mean("outer_mean", set, radialMean(outer));
  evidence.mean("widths", set, [=](const LegRun& at) -> std::optional<Measured> {
    return over(width(at, inner), width(at, outer));
  });
  evidence.trend("width_with_density", scope.upward(),
                 [=](const LegRun& at) -> std::optional<Measured> { return width(at, inner); });
}

void judgeContinuumRotation(const ClaimScope& scope, Evidence& evidence) {
  const RunSet set = scope.flow();
  const double to = scope.number("layers_to");
  evidence.mean("follows", set, [=](const LegRun& at) -> std::optional<Measured> {
    return over(meanOf(overRings(at, "spin", {0.0, to})),
                meanOf(overRings(at, "continuum_rotation", {0.0, to})));
  });
  evidence.mean("oscillates", set, [](const LegRun& at) -> std::optional<Measured> {
    const auto first = inRing(at, "excess_rotation", 0), second = inRing(at, "excess_rotation", 1),
               third = inRing(at, "excess_rotation", 2);
    if (!first || !second || !third) return std::nullopt;
    return (2.0 * second->value - first->value - third->value) / (4.0 * at.leg->cell.omega);
  });
}

}  // namespace crossgrain::inline runs
