// Couple stress, and the model that has one: C23, C24.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "runs/thesis/claims_cosserat.hpp"
#include "runs/thesis/claims_judges.hpp"
#include "runs/thesis/claims_rings.hpp"

namespace crossgrain::inline runs {
namespace {

/// The model's number at ξ, its logarithm being linear between points. Absent outside, and where it
/// is not positive.
std::optional<double> modelAt(const std::vector<double>& xi, const std::vector<double>& of,
                              double at) {
  const auto above = std::ranges::lower_bound(xi, at);
  if (above == xi.end() || xi.size() != of.size()) return std::nullopt;
  const auto k = static_cast<std::size_t>(above - xi.begin());
  if (k == 0) return at == xi.front() ? std::optional(of.front()) : std::nullopt;
  if (!(of[k - 1] > 0.0) || !(of[k] > 0.0)) return std::nullopt;
  const double share = (at - xi[k - 1]) / (xi[k] - xi[k - 1]);
  return std::exp((1.0 - share) * std::log(of[k - 1]) + share * std::log(of[k]));
}

double xiOf(const LegRun& at, double r) {
  const CouetteCell& cell = at.leg->cell;
  return (r - cell.innerRadius) / (cell.outerRadius - cell.innerRadius);
}

/// Root mean square of ln(model/run), both taken relative to their first ring.
std::optional<double> distanceOf(const LegRun& at, const std::vector<RingValue>& rings,
                                 const std::vector<double>& xi, const std::vector<double>& of) {
  std::vector<RingValue> off;
  for (RingValue each : rings) {
    const auto log = less(logOf(modelAt(xi, of, xiOf(at, each.r))), logOf(each.value));
    if (!log) continue;
    each.value = *log;
    off.push_back(each);
  }
  if (off.size() < 3 || off.front().ring != 0) return std::nullopt;
  const double first = off.front().value;
  for (RingValue& each : off) each.value -= first;
  return rmsOf(off);
}

/// Size of the mean over each ring and the one outside of it, at the edge between them: the
/// oscillation from layer to layer cancels.
std::vector<RingValue> pairsOf(const std::vector<RingValue>& rings) {
  std::vector<RingValue> pairs;
  for (std::size_t k = 0; k + 1 < rings.size(); ++k) {
    RingValue both = rings[k];
    both.r = 0.5 * (rings[k].r + rings[k + 1].r);
    both.value = std::abs(0.5 * (rings[k].value + rings[k + 1].value));
    pairs.push_back(both);
  }
  return pairs;
}

constexpr const char* noModel = "the model has no solution";

void putModel(const ClaimScope& scope, Evidence& evidence, const RunSet& set,
              const std::optional<CosseratFields>& model) {
  const RingSpan fitted{0.0, scope.number("fit_to")};
  if (!model) {
    for (const char* const figure : {"velocity", "spin", "model_couple"})
      evidence.put(figure, {}, noModel);
    return;
  }
  evidence.mean("velocity", set, [&](const LegRun& at) -> std::optional<Measured> {
    return distanceOf(at, overRings(at, "azimuthal_velocity", fitted), model->xi, model->u);
  });
  evidence.mean("spin", set, [&](const LegRun& at) -> std::optional<Measured> {
    return distanceOf(at, pairsOf(overRings(at, "spin", fitted)), model->xi, model->omega);
  });
  evidence.put("model_couple", exactly(model->m.back() / model->m.front()), "");
}

}  // namespace

void judgeCoupleStress(const ClaimScope& scope, Evidence& evidence) {
  const RunSet set = scope.carrying(scope.upward());
  const RingSpan band = bandOf(scope), bulk = bulkOf(scope);
  const auto resistance = [](const LegRun& at, const RingSpan& span) {
    return medianOf(overRings(at, "torque_resistance", span));
  };
  evidence.mean("wheel", set, [=](const LegRun& at) -> std::optional<Measured> {
    const auto first = inRing(at, "couple_stress_zr", 0);
    if (!first) return std::nullopt;
    return over(std::abs(first->value), rmsOf(overRings(at, "couple_stress_zr", bulk)));
  });
  evidence.mean("with_distance", set, [=](const LegRun& at) -> std::optional<Measured> {
    return over(resistance(at, bulk), resistance(at, band));
  });
  evidence.trend("with_density", set,
                 [=](const LegRun& at) -> std::optional<Measured> { return resistance(at, bulk); });
  evidence.mean("identity", set, [=](const LegRun& at) -> std::optional<Measured> {
    const auto kt = legChoices(at.leg->caseToml).kt;
    const auto ratio = medianOf(ratioOf(at, "torque_resistance", "fabric_trace", bulk));
    if (!kt || !ratio || !(*kt > 0.0)) return std::nullopt;
    return *ratio * 2.0 * std::numbers::pi * at.leg->cell.height / *kt;
  });
}

void judgeCosserat(const ClaimScope& scope, Evidence& evidence,
                   const std::optional<CosseratFields>& model) {
  const RunSet set = scope.carrying(scope.flow());
  const RingSpan bulk = bulkOf(scope);
  putModel(scope, evidence, set, model);
  evidence.mean("asymmetry", set, [](const LegRun& at) -> std::optional<Measured> {
    const auto pr = inRing(at, "stress_pr", 0), rp = inRing(at, "stress_rp", 0);
    if (!pr || !rp) return std::nullopt;
    return over(2.0 * (pr->value - rp->value), pr->value + rp->value);
  });
  const auto atWheel = [](const LegRun& at) -> std::optional<double> {
    const auto couple = inRing(at, "couple_stress_zr", 0);
    if (!couple) return std::nullopt;
    return std::abs(couple->value);
  };
  evidence.mean("couple", set, [=](const LegRun& at) -> std::optional<Measured> {
    return over(rmsOf(overRings(at, "couple_stress_zr", bulk)), atWheel(at));
  });
  const double unit = scope.number("particle_diameter") * scope.number("length_ratio") *
                      std::sqrt(2.0 * (scope.number("shape") + 1.0));
  evidence.mean("couple_size", set, [=](const LegRun& at) -> std::optional<Measured> {
    return over(over(atWheel(at), unit), meanOf(overRings(at, "stress_rr", offWalls(at))));
  });
}

void judgeCosseratModel(const ClaimScope& scope, Evidence& evidence) {
  judgeCosserat(scope, evidence, cosseratAsPrinted());
}

}  // namespace crossgrain::inline runs
