// Deformation and moduli: C18 to C21, C27.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reports/thesis/divergence.hpp"
#include "runs/thesis/claims_judges.hpp"
#include "runs/thesis/claims_rings.hpp"

namespace crossgrain::inline runs {
namespace {

/// Change of ln(dev/tr) of the band between two labels, along the regression line over runs.
void putChange(const ClaimScope& scope, Evidence& evidence, const std::string& figure,
               const RunSet& set, const std::string& tensor) {
  std::vector<GroupedPoint> points;
  RunSet used;
  for (const LegRun& at : set.runs) {
    const auto share =
        logOf(meanOf(ratioOf(at, tensor + "_deviator", tensor + "_trace", bandOf(scope))));
    if (!share) continue;
    points.push_back({at.leg->label, *share, 0});
    used.runs.push_back(at);
  }
  evidence.restsOn(used);
  auto change = commonSlope(points);
  const double span = scope.number("change_to") - scope.number("change_from");
  if (change) {
    change->value *= span;
    *change->standardError *= span;
  }
  evidence.put(
      figure, change,
      points.empty() ? Evidence::missing(set) : fmt::format("{}: too few, or of one ν̄", set.words));
}

/// Differences of two axes ring by ring, averaged [degrees].
RunFigure axisLess(std::string_view field, std::string_view other, RingSpan span) {
  return [=](const LegRun& at) -> std::optional<Measured> {
    std::vector<RingValue> differences;
    const std::vector<RingValue> others = overRings(at, other, span);
    for (RingValue each : overRings(at, field, span)) {
      const auto found = std::ranges::find(others, each.ring, &RingValue::ring);
      if (found == others.end()) continue;
      each.value -= found->value;
      differences.push_back(each);
    }
    return over(meanAxis(differences), std::numbers::pi / 180.0);
  };
}

/// E over the mean field's, in rings that hold enough contacts.
std::vector<RingValue> bulkRatios(const LegRun& at, double leastTrace) {
  std::vector<RingValue> ratios = ratioOf(at, "bulk_modulus", "mean_field_modulus", offWalls(at));
  std::erase_if(ratios, [&](const RingValue& each) {
    const auto trace = inRing(at, "fabric_trace", each.ring);
    return !trace || trace->value < leastTrace;
  });
  return ratios;
}

/// Largest |2πhE/k_n − tr F − dev F (dev ε/tr ε) cos 2(φ_ε − φ_F)| over tr F.
std::optional<double> offIdentity(const LegRun& at, double leastTrace) {
  std::optional<double> largest;
  for (const RingValue& each : bulkRatios(at, leastTrace)) {
    const auto of = [&](std::string_view field) { return inRing(at, field, each.ring); };
    const auto trace = of("fabric_trace"), deviator = of("fabric_deviator"),
               strain = of("strain_trace"), strainDeviator = of("strain_deviator"),
               angle = of("fabric_angle"), strainAngle = of("strain_angle");
    if (!trace || !deviator || !strain || !strainDeviator || !angle || !strainAngle) continue;
    if (strain->value == 0.0) continue;
    const double anisotropic = deviator->value / trace->value * strainDeviator->value /
                               strain->value * std::cos(2.0 * (strainAngle->value - angle->value));
    largest = std::max(largest.value_or(0.0), std::abs(each.value - 1.0 - anisotropic));
  }
  return largest;
}

/// What a run has more of a number than the ladder's run of the same packing; where there is none,
/// than the ladder's runs of that label on average.
RunFigure beyondLadder(const ClaimScope& scope, const RunSet& ladder,
                       const std::function<std::optional<double>(const LegRun&)>& of) {
  return [=, &scope](const LegRun& at) -> std::optional<Measured> {
    const auto own = of(at);
    double sum = 0.0, count = 0.0;
    for (const LegRun& other : ladder.runs) {
      if (std::abs(other.leg->label - at.leg->label) > scope.common("same_label")) continue;
      const auto value = of(other);
      if (!value) continue;
      const bool samePacking = other.leg->cell.small == at.leg->cell.small &&
                               other.leg->cell.large == at.leg->cell.large &&
                               other.run->seed == at.run->seed &&
                               other.run->packing == at.run->packing;
      if (samePacking) return less(own, value);
      sum += *value;
      count += 1.0;
    }
    return less(own, over(sum, count));
  };
}

/// G/tr F, ring by ring, where both are positive.
std::vector<RingValue> shearRatios(const LegRun& at, const RingSpan& span) {
  std::vector<RingValue> ratios = ratioOf(at, "shear_modulus", "fabric_trace", span);
  std::erase_if(ratios, [](const RingValue& each) { return !(each.value > 0.0); });
  return ratios;
}

/// See reports/thesis/divergence.hpp.
std::optional<double> traceOfDivergence(const ClaimScope& scope, const LegRun& at) {
  const auto view = reports::ringViewOf(*at.leg, *at.run);
  if (!view) return std::nullopt;
  return reports::traceOfDivergence(*view, {scope.common("band_to"), scope.common("first_layer_to"),
                                            scope.common("bulk_to"), scope.number("factor")});
}

}  // namespace

void judgeDeformation(const ClaimScope& scope, Evidence& evidence) {
  const RunSet all = scope.carrying(scope.upward());
  const auto ratio = [band = bandOf(scope),
                      bulk = bulkOf(scope)](const LegRun& at) -> std::optional<Measured> {
    return over(meanOf(overRings(at, "strain_trace", band)),
                meanOf(overRings(at, "strain_trace", bulk)));
  };
  evidence.mean(
      "band",
      scope.carrying(scope.labels(scope.common("flow_from"), scope.number("low_to"), "of low ν̄")),
      ratio);
  evidence.trend("flatter", all, ratio);
  const RunSet figures = scope.carrying(
      scope.labels(scope.common("flow_from"),
                   scope.number("change_to") + scope.common("same_label"), "of the figure's ν̄"));
  putChange(scope, evidence, "deviator", figures, "strain");
  putChange(scope, evidence, "fabric", figures, "fabric");
}

void judgeAxes(const ClaimScope& scope, Evidence& evidence) {
  const RunSet set = scope.carrying(scope.upward());
  const RingSpan inside = insideBandOf(scope);
  evidence.mean("fabric_stress", set, axisLess("fabric_angle", "stress_angle", inside));
  evidence.mean("stress_strain", set, axisLess("stress_angle", "strain_angle", inside));
}

void judgeBulkModulus(const ClaimScope& scope, Evidence& evidence) {
  const RunSet set = scope.carrying(scope.upward());
  const double least = scope.number("least_trace");
  const auto excess = [=](const LegRun& at) { return less(meanOf(bulkRatios(at, least)), 1.0); };
  evidence.mean("mean_field", set,
                [=](const LegRun& at) -> std::optional<Measured> { return excess(at); });
  std::vector<RingValue> everywhere;
  for (const LegRun& at : set.runs)
    for (const RingValue& each : bulkRatios(at, least)) everywhere.push_back(each);
  const auto middle = meanOf(everywhere);
  evidence.mean("collapse", set, [=](const LegRun& at) -> std::optional<Measured> {
    std::vector<RingValue> off = bulkRatios(at, least);
    for (RingValue& each : off) each.value -= *middle;
    return rmsOf(off);
  });
  const auto beside = [&](const char* figure, const char* family, auto differs, const char* words) {
    RunSet legs = scope.family(family);
    std::erase_if(legs.runs, [&](const LegRun& at) { return !differs(*at.leg); });
    legs.words += words;
    evidence.mean(figure, scope.carrying(legs), beyondLadder(scope, set, excess));
  };
  const double kn = set.runs.empty() ? 0.0 : set.runs.front().leg->kn;
  beside(
      "stiffness", "kn", [kn](const ThesisLeg& leg) { return leg.kn != kn; }, " of another k_n");
  beside(
      "frictionless", "friction", [](const ThesisLeg& leg) { return leg.mu == 0.0; },
      " without friction");
  evidence.mean("identity", set, [=](const LegRun& at) -> std::optional<Measured> {
    return offIdentity(at, least);
  });
}

void judgeShearModulus(const ClaimScope& scope, Evidence& evidence) {
  const RunSet set = scope.carrying(scope.flow());
  const RingSpan band = bandOf(scope), bulk = bulkOf(scope);
  std::vector<std::vector<TrendPoint>> runs;
  for (const LegRun& at : set.runs) {
    std::vector<TrendPoint> points;
    for (const RingValue& each : shearRatios(at, band)) {
      const double trace = inRing(at, "fabric_trace", each.ring)->value;
      points.push_back({std::log(trace), std::log(each.value * trace)});
    }
    if (!points.empty()) runs.push_back(std::move(points));
  }
  evidence.restsOn(set);
  evidence.put("exponent", slopeOverRuns(runs),
               runs.empty()
                   ? Evidence::missing(set)
                   : fmt::format("{}: fewer than three with the data, or of one tr F", set.words));
  evidence.mean("divergence", set, [=](const LegRun& at) -> std::optional<Measured> {
    return over(medianOf(shearRatios(at, bulk)), medianOf(shearRatios(at, band)));
  });
}

void judgeDivergence(const ClaimScope& scope, Evidence& evidence) {
  const RunSet all = scope.carrying(scope.upward());
  const auto trace = [&](const LegRun& at) -> std::optional<Measured> {
    return traceOfDivergence(scope, at);
  };
  evidence.trend("with_density", all, trace);
  evidence.mean("trace", scope.carrying(scope.flow()), trace);
  std::vector<GroupedPoint> points;
  for (const LegRun& at : all.runs)
    if (const auto found = traceOfDivergence(scope, at))
      points.push_back({at.leg->label, *found, 0});
  evidence.put("slope", commonSlope(points), Evidence::missing(all));
}

}  // namespace crossgrain::inline runs
