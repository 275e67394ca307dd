// Volume fraction, averaging, time: C3 to C6.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runs/thesis/claims_judges.hpp"
#include "runs/thesis/claims_rings.hpp"

namespace crossgrain::inline runs {
namespace {

/// What rounding leaves between times that were typed in [rotations].
constexpr double sliverOfRotation = 1e-6;

/// ν by one method and another, ring by ring: the latter less the former.
struct TwoMethods {
  std::vector<RingValue> slicing, centre, difference;
};

TwoMethods methodsOf(const LegRun& at, const std::vector<Profile>& profiles) {
  TwoMethods both{overRings(at, profileOf(profiles, "slicing", "volume_fraction")),
                  overRings(at, profileOf(profiles, "centre", "volume_fraction")),
                  {}};
  for (RingValue each : both.centre) {
    const auto found = std::ranges::find(both.slicing, each.ring, &RingValue::ring);
    if (found == both.slicing.end()) continue;
    each.value -= found->value;
    both.difference.push_back(each);
  }
  return both;
}

TwoMethods fineMethodsOf(const LegRun& at, double fewest) {
  const RingAverages* finest = nullptr;
  for (const RingAverages& each : at.run->finer)
    if (each.rings >= fewest && (!finest || each.rings > finest->rings)) finest = &each;
  return finest ? methodsOf(at, finest->profiles) : TwoMethods{};
}

std::optional<double> largestOfRings(const std::vector<RingValue>& rings) {
  if (rings.empty()) return std::nullopt;
  return std::ranges::max(rings, {}, &RingValue::value).value;
}

/// The spans between which the thesis has its cell steady; null without both of them.
struct SteadySpans {
  const ThesisSpan *first = nullptr, *begin = nullptr, *end = nullptr;
};

SteadySpans steadySpansOf(const ClaimScope& scope, const LegRun& at) {
  SteadySpans spans;
  const std::vector<ThesisSpan>& history = at.run->history;
  if (history.empty()) return spans;
  spans.first = &history.front();
  for (const ThesisSpan& span : history) {
    if (!spans.begin && span.from > scope.number("steady_from") - sliverOfRotation)
      spans.begin = &span;
    if (span.to < scope.number("steady_to") + sliverOfRotation) spans.end = &span;
  }
  if (!spans.begin || spans.end <= spans.begin || spans.begin == spans.first) return {};
  return spans;
}

std::optional<double> changeOf(const ThesisSpan* from, const ThesisSpan* to,
                               std::optional<double> ThesisSpan::*quantity) {
  if (!from || !to) return std::nullopt;
  return less(to->*quantity, from->*quantity);
}

RunSet timedAt(const ClaimScope& scope, double label) {
  RunSet set = scope.timed();
  std::erase_if(set.runs, [&](const LegRun& at) {
    return std::abs(at.leg->label - label) > scope.common("same_label");
  });
  set.words += fmt::format(" at ν̄ = {:g}", label);
  return set;
}

/// Who carries after so many rotations.
struct CarryingSet {
  RunSet set;
  std::vector<Carrying> packings;
};

CarryingSet carryingAfter(const ClaimScope& scope, double rotation) {
  CarryingSet after{scope.timed(), {}};
  std::erase_if(after.set.runs, [&](const LegRun& at) {
    const ThesisSpan* const span = reports::spanAt(*at.run, rotation);
    if (!span || !span->wheelContacts) return true;
    after.packings.push_back(
        {at.leg->label, *span->wheelContacts >= scope.common("wheel_contacts")});
    return false;
  });
  after.set.words += fmt::format(" followed for {:g} rotations", rotation);
  return after;
}

void putCritical(const ClaimScope& scope, Evidence& evidence, const std::string& figure,
                 const CarryingSet& after) {
  const auto carry = std::ranges::count_if(after.packings, &Carrying::carries);
  evidence.put(
      figure,
      estimateOf(halfCarry(after.packings, scope.number("label_spread")), after.packings.size()),
      after.packings.empty() ? Evidence::missing(after.set)
                             : fmt::format("{} of {} {} carry, from which no critical ν̄ follows",
                                           carry, after.packings.size(), after.set.words));
  evidence.restsOn(after.set);
}

}  // namespace

void judgeBinning(const ClaimScope& scope, Evidence& evidence) {
  const RunSet set = scope.at(scope.number("label"));
  const double fewest = scope.number("fewest_fine");
  evidence.mean("meeting", set, [](const LegRun& at) -> std::optional<Measured> {
    return rmsOf(methodsOf(at, at.run->run.profiles).difference);
  });
  evidence.mean("centre_peak", set, [=](const LegRun& at) -> std::optional<Measured> {
    return largestOfRings(fineMethodsOf(at, fewest).centre);
  });
  evidence.mean("slicing_peak", set, [=](const LegRun& at) -> std::optional<Measured> {
    return largestOfRings(fineMethodsOf(at, fewest).slicing);
  });
  evidence.mean("noise", set, [=](const LegRun& at) -> std::optional<Measured> {
    return over(rmsOf(fineMethodsOf(at, fewest).difference),
                rmsOf(methodsOf(at, at.run->run.profiles).difference));
  });
}

void judgeDensityInTime(const ClaimScope& scope, Evidence& evidence) {
  const RunSet set = timedAt(scope, scope.number("label"));
  const auto wheel = &ThesisSpan::volumeFractionAtWheel;
  const double late = scope.number("late");
  evidence.mean("inner_change", set, [&](const LegRun& at) -> std::optional<Measured> {
    const SteadySpans spans = steadySpansOf(scope, at);
    return changeOf(spans.begin, spans.end, wheel);
  });
  evidence.mean("early_less_late", set, [&](const LegRun& at) -> std::optional<Measured> {
    const SteadySpans spans = steadySpansOf(scope, at);
    const auto before = changeOf(spans.first, spans.begin, wheel);
    const auto after = changeOf(spans.begin, spans.end, wheel);
    if (!before || !after) return std::nullopt;
    return std::abs(*before) - std::abs(*after);
  });
  evidence.mean("outer_change", set, [&](const LegRun& at) -> std::optional<Measured> {
    const SteadySpans spans = steadySpansOf(scope, at);
    return changeOf(spans.first, spans.end, &ThesisSpan::volumeFractionOutside);
  });
  evidence.mean("inner_late", set, [&](const LegRun& at) -> std::optional<Measured> {
    return changeOf(steadySpansOf(scope, at).begin, reports::spanAt(*at.run, late), wheel);
  });
  evidence.mean("pressure_late", set, [&](const LegRun& at) -> std::optional<Measured> {
    const SteadySpans spans = steadySpansOf(scope, at);
    const ThesisSpan* const last = reports::spanAt(*at.run, late);
    if (!spans.begin || !last) return std::nullopt;
    return logOf(over(last->outerPressure, spans.begin->outerPressure));
  });
}

void judgeDilatedZone(const ClaimScope& scope, Evidence& evidence) {
  const RunSet set = scope.flow();
  const auto decay = [](const LegRun& at) { return fitOf(at, "dilation_decay"); };
  const auto lengths = [decay](double many) {
    return [=](const LegRun& at) -> std::optional<Measured> {
      const auto c = decay(at);
      if (!c || !(c->value > 0.0)) return std::nullopt;
      std::optional<double> error;
      if (c->within) error = many * *c->within / (c->value * c->value);
      return Measured(many / c->value, error);
    };
  };
  evidence.mean("width", set, lengths(1.0));
  evidence.mean("reach", set, lengths(3.0));
  evidence.mean("dilation", set, [=](const LegRun& at) -> std::optional<Measured> {
    const auto b = fitOf(at, "dilation"), c = decay(at);
    if (!b || !c) return std::nullopt;
    return b->value * std::exp(-0.5 * c->value);
  });
  evidence.mean("nu0", set, [](const LegRun& at) { return fitOf(at, "volume_fraction_outside"); });
  evidence.mean("b", set, [](const LegRun& at) { return fitOf(at, "dilation"); });
}

void judgeCriticalDensity(const ClaimScope& scope, Evidence& evidence) {
  putCritical(scope, evidence, "critical", carryingAfter(scope, scope.number("thesis_rotation")));
  for (const int rotation : {1, 2, 5, 10, 20}) {
    const CarryingSet after = carryingAfter(scope, rotation);
    putCritical(scope, evidence, fmt::format("critical_{}", rotation), after);
    std::vector<Measured> share;
    for (const Carrying& each : after.packings) share.emplace_back(each.carries ? 1.0 : 0.0);
    evidence.put(fmt::format("carry_{}", rotation), meanOver(share), Evidence::missing(after.set));
  }
  const auto blocked = [](const LegRun& at) -> std::optional<Measured> {
    if (!at.run->run.regime) return std::nullopt;
    return at.run->run.regime->blockedFraction;
  };
  evidence.mean("blocked_above", scope.blocked(), blocked);
  evidence.mean("blocked_below", scope.flow(), blocked);
}

}  // namespace crossgrain::inline runs
