// Fabric and stress: C12, C13, C15 to C17, C26.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "averaging/fits.hpp"
#include "runs/thesis/claims_judges.hpp"
#include "runs/thesis/claims_rings.hpp"

namespace crossgrain::inline runs {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// A field's mean over some rings over that over others.
std::optional<double> meansOver(const LegRun& at, std::string_view field, const RingSpan& some,
                                const RingSpan& others) {
  return over(meanOf(overRings(at, field, some)), meanOf(overRings(at, field, others)));
}

/// dev/tr of a tensor, "fabric", "stress" or "strain", mean over rings.
std::optional<double> deviatorIn(const LegRun& at, const std::string& tensor,
                                 const RingSpan& span) {
  return meanOf(ratioOf(at, tensor + "_deviator", tensor + "_trace", span));
}

/// Exponent of a shear stress in r, off the walls.
RunFigure exponentOf(std::string_view field) {
  return [=](const LegRun& at) -> std::optional<Measured> {
    std::vector<FitPoint> points;
    for (const RingValue& each : overRings(at, field, offWalls(at))) {
      const auto measured = inRing(at, field, each.ring);
      points.push_back({each.r / at.leg->cell.innerRadius, each.value, measured->within});
    }
    const Fit fit = fitPowerLaw(points);
    if (!fit.converged) return std::nullopt;
    const auto p = std::ranges::find(fit.parameters, "p", &FitParameter::name);
    return Measured(p->value, p->standardError);
  };
}

std::optional<double> sumOfBoth(const std::optional<Measured>& a,
                                const std::optional<Measured>& b) {
  if (!a || !b) return std::nullopt;
  return a->value + b->value;
}

std::optional<double> headOf(const LegRun& at, std::string_view name) {
  const std::vector<HeadNumber>& head = at.run->run.head;
  const auto found = std::ranges::find(head, name, &HeadNumber::name);
  return found == head.end() ? std::nullopt : found->value;
}

/// lg of an overlap that the head has in diameters [m].
RunFigure overlapOf(std::string_view name) {
  return [=](const LegRun& at) -> std::optional<Measured> {
    const auto overlap = headOf(at, name);
    if (!overlap) return std::nullopt;
    return log10Of(*overlap * at.leg->cell.diameter);
  };
}

/// Mean over the band of the logarithm of one component over another's size.
RunFigure logRatioInBand(std::string_view field, std::string_view by, RingSpan band) {
  return [=](const LegRun& at) -> std::optional<Measured> {
    std::vector<RingValue> logs;
    for (RingValue each : ratioOf(at, field, by, band)) {
      const auto log = logOf(std::abs(each.value));
      if (!log) continue;
      each.value = *log;
      logs.push_back(each);
    }
    return meanOf(logs);
  };
}

}  // namespace

void judgeFabricTrace(const ClaimScope& scope, Evidence& evidence) {
  const RunSet set = scope.carrying(scope.upward());
  const RingSpan band = bandOf(scope), bulk = bulkOf(scope);
  const auto inBulk = [=](const LegRun& at) { return meanOf(overRings(at, "fabric_trace", bulk)); };
  evidence.mean("band", set, [=](const LegRun& at) -> std::optional<Measured> {
    return meansOver(at, "fabric_trace", band, bulk);
  });
  evidence.mean("outermost", set, [=](const LegRun& at) -> std::optional<Measured> {
    const std::size_t rings = ringCount(at);
    const auto last = rings > 0 ? inRing(at, "fabric_trace", rings - 1) : std::nullopt;
    if (!last) return std::nullopt;
    return over(last->value, inBulk(at));
  });
  evidence.trend("with_density", set,
                 [=](const LegRun& at) -> std::optional<Measured> { return inBulk(at); });
  evidence.mean("identity", set, [](const LegRun& at) -> std::optional<Measured> {
    std::optional<double> largest;
    for (const RingValue& each : ratioOf(at, "fabric_trace", "coordination", offWalls(at))) {
      const auto nu = inRing(at, "volume_fraction", each.ring);
      if (!nu || !(nu->value > 0.0)) continue;
      largest = std::max(largest.value_or(0.0), std::abs(each.value / nu->value - 1.0));
    }
    return largest;
  });
}

void judgeFabricAnisotropy(const ClaimScope& scope, Evidence& evidence) {
  const RunSet set = scope.carrying(scope.upward());
  const RingSpan inside = insideBandOf(scope), band = bandOf(scope), bulk = bulkOf(scope);
  evidence.mean("axis", set, [=](const LegRun& at) -> std::optional<Measured> {
    return over(meanAxis(overRings(at, "fabric_angle", inside)), degree);
  });
  evidence.trend("with_density", set, [=](const LegRun& at) -> std::optional<Measured> {
    return deviatorIn(at, "fabric", band);
  });
  evidence.mean("with_distance", set, [=](const LegRun& at) -> std::optional<Measured> {
    return over(deviatorIn(at, "fabric", bulk), deviatorIn(at, "fabric", band));
  });
}

void judgeStressProfiles(const ClaimScope& scope, Evidence& evidence) {
  const RunSet set = scope.carrying(scope.upward());
  const auto meanRatio = [](std::string_view field, std::string_view by) {
    return [=](const LegRun& at) -> std::optional<Measured> {
      return over(meanOf(overRings(at, field, offWalls(at))),
                  meanOf(overRings(at, by, offWalls(at))));
    };
  };
  evidence.mean("exponent_rp", set, exponentOf("stress_rp"));
  evidence.mean("exponent_pr", set, exponentOf("stress_pr"));
  evidence.mean("diagonal", set, meanRatio("stress_pp", "stress_rr"));
  evidence.mean("symmetry", set, meanRatio("stress_pr", "stress_rp"));
  evidence.mean("constant", set, [](const LegRun& at) -> std::optional<Measured> {
    return scatterOf(overRings(at, "stress_rr", offWalls(at)));
  });
  RunSet smooth = scope.family("bottom");
  std::erase_if(smooth.runs, [](const LegRun& at) { return at.leg->bottomFriction; });
  smooth.words += " without bottom friction";
  evidence.mean("balance", smooth, [](const LegRun& at) -> std::optional<Measured> {
    std::vector<RingValue> torque;
    for (RingValue each : overRings(at, "stress_pr", offWalls(at))) {
      const auto couple = inRing(at, "couple_stress_zr", each.ring);
      if (!couple) continue;
      each.value = each.r * (each.r * each.value + couple->value);
      torque.push_back(each);
    }
    return scatterOf(torque);
  });
}

void judgeDynamicStress(const ClaimScope& scope, Evidence& evidence) {
  const RunSet set = scope.carrying(scope.flow());
  const RingSpan band = bandOf(scope);
  evidence.mean("orders", set, [](const LegRun& at) -> std::optional<Measured> {
    const auto moving =
        sumOfBoth(inRing(at, "dynamic_stress_rr", 0), inRing(at, "dynamic_stress_pp", 0));
    const auto resting = sumOfBoth(inRing(at, "stress_rr", 0), inRing(at, "stress_pp", 0));
    return log10Of(over(resting, moving));
  });
  evidence.mean("pp_over_rr", set, logRatioInBand("dynamic_stress_pp", "dynamic_stress_rr", band));
  evidence.mean("rr_over_rp", set, logRatioInBand("dynamic_stress_rr", "dynamic_stress_rp", band));
}

void judgeStressOverDensity(const ClaimScope& scope, Evidence& evidence) {
  const RunSet all = scope.upward(), carrying = scope.carrying(all);
  const RingSpan band = bandOf(scope), bulk = bulkOf(scope);
  const auto meanStress = [](std::string_view field) {
    return [=](const LegRun& at) -> std::optional<Measured> {
      return meanOf(overRings(at, field, offWalls(at)));
    };
  };
  evidence.trend("rr_with_density", all, meanStress("stress_rr"));
  evidence.trend("rp_with_density", all, meanStress("stress_rp"));
  evidence.trend("dev_with_density", carrying, [=](const LegRun& at) -> std::optional<Measured> {
    return deviatorIn(at, "stress", band);
  });
  evidence.mean("dev_with_distance", carrying, [=](const LegRun& at) -> std::optional<Measured> {
    return over(deviatorIn(at, "stress", bulk), deviatorIn(at, "stress", band));
  });
  evidence.mean("rr", scope.at(scope.number("label")),
                [](const LegRun& at) -> std::optional<Measured> {
                  return log10Of(meanOf(overRings(at, "stress_rr", offWalls(at))));
                });
}

void judgeOverlap(const ClaimScope& scope, Evidence& evidence) {
  const RunSet set = scope.flow();
  evidence.mean("overlap", set, overlapOf("max_overlap_over_d"));
  evidence.mean("mean_overlap", set, overlapOf("mean_overlap_over_d"));
  evidence.mean("overlap_804", scope.at(scope.number("label")), overlapOf("max_overlap_over_d"));
  evidence.mean("trace", set, [](const LegRun& at) -> std::optional<Measured> {
    return log10Of(meanOf(overRings(at, "stress_trace", offWalls(at))));
  });
}

}  // namespace crossgrain::inline runs
