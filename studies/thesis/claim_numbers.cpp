#include "studies/thesis/claim_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "averaging/fits.hpp"
#include "continuum/cosserat.hpp"

namespace crossgrain::inline studies {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double rotationRounding = 1e-6;  // between times that were typed in [rotations]
using Maybe = std::optional<double>;

Maybe quotient(Maybe a, Maybe b) {
  if (!a || !b || *b == 0.0) return std::nullopt;
  return *a / *b;
}

Maybe rmsOf(const std::vector<RingValue>& rings) {
  double squares = 0.0;
  for (const RingValue& each : rings) squares += each.value * each.value;
  return std::sqrt(squares / static_cast<double>(rings.size()));
}

/// Of a run's history the first span, those between which the thesis has its cell steady, and a
/// late one; the first three null unless the steady ones are there and come after the first.
const ThesisSpan* spanOf(std::string_view when, const CaseRun& at, const ClaimScope& scope) {
  if (when == "late") return spanAt(*at.run, scope.number("late"));
  const std::vector<ThesisSpan>& history = at.run->history;
  if (history.empty()) return nullptr;
  const ThesisSpan *const first = &history.front(), *begin = nullptr, *end = nullptr;
  for (const ThesisSpan& span : history) {
    if (!begin && span.from > scope.number("steady_from") - rotationRounding) begin = &span;
    if (span.to < scope.number("steady_to") + rotationRounding) end = &span;
  }
  if (!begin || !end || end <= begin || begin == first) return nullptr;
  return when == "first" ? first : when == "begin" ? begin : when == "end" ? end : nullptr;
}

Maybe blockedShare(const CaseRun& at, const ClaimScope&) {
  const auto& regime = at.run->run.regime;
  return regime ? regime->blockedFraction : std::nullopt;
}

const Distribution* distributionOf(const CaseRun& at, std::string_view quantity,
                                   std::optional<int> ring, std::size_t axes) {
  for (const Distribution& each : at.run->run.distributions)
    if (each.quantity == quantity && each.ring == ring)
      return each.axes.size() == axes ? &each : nullptr;
  return nullptr;
}

double middleOf(const Bins& bins, std::size_t k) {
  return bins.low + (static_cast<double>(k) + 0.5) * bins.width;
}

/// Mean density over the bins that are wanted, by their middles; absent where there is none.
template <typename Wanted>
Maybe densityWhere(const Distribution* of, double unit, const Wanted& wanted) {
  if (!of) return std::nullopt;
  double sum = 0.0, bins = 0.0;
  const auto across = static_cast<std::size_t>(of->axes[0].count);
  for (std::size_t k = 0; k < of->density.size(); ++k) {
    const double x = middleOf(of->axes[0], k % across);
    if (!wanted(x, of->axes.size() > 1 ? middleOf(of->axes[1], k / across) : 0.0)) continue;
    sum += unit * of->density[k];
    bins += 1.0;
  }
  return quotient(sum, bins);
}

Maybe jointDensity(std::string_view where, const CaseRun& at, const ClaimScope& scope) {
  const double restV = scope.number("rest_velocity"), restS = scope.number("rest_spin");
  const double half = scope.number("ridge_half_width"), off = scope.number("ridge_off");
  const auto within = [&](double v, double s, double times) {
    return std::abs(v) <= times * restV && std::abs(s) <= times * restS;
  };
  // Away from rest and up to the wheel's own speed.
  const auto stripe = [&](double v, double distance) {
    return v > 2.0 * restV && v < 1.0 && std::abs(distance) <= half;
  };
  return densityWhere(distributionOf(at, "azimuthal_velocity_and_spin", {}, 2), 1.0,
                      [&](double v, double s) {
                        if (where == "rest") return within(v, s, 1.0);
                        if (where == "beside_rest") return within(v, s, 3.0) && !within(v, s, 1.0);
                        if (where == "ridge") return stripe(v, v - 1.0 - s);
                        return stripe(v, std::abs(v - 1.0 - s) - off);
                      });
}

Maybe velocityDensity(double from, double to, const CaseRun& at) {
  return densityWhere(distributionOf(at, "azimuthal_velocity", 0, 1), 1.0,
                      [&](double v, double) { return v >= from && v <= to; });
}

const Distribution* directionsIn(const CaseRun& at, std::optional<std::size_t> ring) {
  return ring ? distributionOf(at, "contact_direction", static_cast<int>(*ring), 1) : nullptr;
}

/// Relative to uniform, opposite directions taken together.
Maybe directionsNear(double angle, const Distribution* of, const ClaimScope& scope) {
  const double window = scope.number("window");
  return densityWhere(of, 2.0 * pi, [&](double direction, double) {
    const double off = direction - angle;
    return std::abs(off - pi * std::round(off / pi)) <= window;
  });
}

Maybe meanOfBoth(Maybe a, Maybe b) {
  if (!a || !b) return std::nullopt;
  return 0.5 * (*a + *b);
}

/// In the rings at the wheel and 2 d out (figures 7.9 a and b).
Maybe directionsInBand(double angle, const CaseRun& at, const ClaimScope& scope) {
  return meanOfBoth(directionsNear(angle, directionsIn(at, ringNear(at, 0.5)), scope),
                    directionsNear(angle, directionsIn(at, ringNear(at, 2.5)), scope));
}

Maybe outerDirections(double angle, const CaseRun& at, const ClaimScope& scope) {
  const std::size_t rings = ringCount(at);
  const auto outermost = rings > 0 ? std::optional(rings - 1) : std::nullopt;
  return directionsNear(angle, directionsIn(at, outermost), scope);
}

Maybe leastOuterDirections(const CaseRun& at, const ClaimScope& scope) {
  Maybe least;
  for (const double angle : {-pi / 6.0, pi / 6.0, pi / 2.0}) {
    const auto density = outerDirections(angle, at, scope);
    if (!density) return std::nullopt;
    least = std::min(least.value_or(*density), *density);
  }
  return least;
}

/// Root mean square distance of a ring's contact directions from uniform.
Maybe anisotropy(double rTilde, const CaseRun& at) {
  const Distribution* const of = directionsIn(at, ringNear(at, rTilde));
  if (!of || of->density.empty()) return std::nullopt;
  const std::size_t bins = of->density.size(), half = bins / 2;
  double squares = 0.0;
  for (std::size_t k = 0; k < bins; ++k) {
    const double both = pi * (of->density[k] + of->density[(k + half) % bins]);
    squares += (both - 1.0) * (both - 1.0);
  }
  return std::sqrt(squares / static_cast<double>(bins));
}

/// Absent with fewer than four rings that turn with the wheel.
Maybe roughness(const CaseRun& at, const ClaimScope& scope) {
  const double wheel = at.setup->cell.omega;
  std::vector<RingValue> rings = ringsOf(at, "azimuthal_velocity", {0.0, scope.number("fit_to")});
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

/// Twice the distance from the deepest trough to the highest peak beyond it, on fine rings.
Maybe spinPeriod(const CaseRun& at, const ClaimScope& scope) {
  for (const RingAverages& fine : at.run->finer) {
    if (fine.rings < scope.number("fewest_fine")) continue;
    const Profile* profile = profileOf(fine.profiles, "centre", "spin");
    if (!profile) profile = profileOf(fine.profiles, "spin");
    std::vector<RingValue> rings = ringsOf(at.setup->cell, profile);
    const double within = scope.number("period_within");
    std::erase_if(rings, [&](const RingValue& each) { return each.rTilde > within; });
    if (rings.size() < 4) continue;
    const auto turning = [&](const RingValue& each) { return each.value * at.setup->cell.omega; };
    const auto trough = std::ranges::min_element(rings, {}, turning);
    const auto peak = std::ranges::max_element(trough, rings.end(), {}, turning);
    if (peak != trough) return 2.0 * (peak->rTilde - trough->rTilde);
  }
  return std::nullopt;
}

/// Off the walls, with its error.
FormulaValue exponentOf(const char* field, const CaseRun& at) {
  std::vector<FitPoint> points;
  const Profile* const profile = profileOf(at.run->run.profiles, field);
  for (const RingValue& each : ringsOf(at, field)) {
    if (each.ring == 0 || each.ring + 1 == ringCount(at)) continue;
    const bool known = each.ring < profile->standardError.size();
    points.push_back({each.r / at.setup->cell.innerRadius, each.value,
                      known ? profile->standardError[each.ring] : std::nullopt});
  }
  const Fit fit = fitPowerLaw(points);
  if (!fit.converged) return uncertain({});
  const auto p = std::ranges::find(fit.parameters, "p", &FitParameter::name);
  FormulaValue exponent = uncertain(p->value);
  exponent.errors.front() = p->standardError;
  return exponent;
}

Maybe divergenceTrace(const CaseRun& at, const ClaimScope& scope) {
  return traceOfDivergence(at, {scope.common("band_to"), scope.common("first_layer_to"),
                                scope.common("bulk_to"), scope.number("factor")});
}

/// Mohan's model with the constants of chapter 9 as printed, finer than any ring: u falls by a
/// tenth between points.
const std::vector<CosseratPoint>& modelAsPrinted() {
  static const std::vector<CosseratPoint> points = [] {
    constexpr int last = 400;
    const CosseratOutcome outcome = solveCosserat({});
    std::vector<CosseratPoint> all;
    for (int k = 0; k <= last; ++k)
      all.push_back(outcome.solution.value().at(static_cast<double>(k) / last));
    return all;
  }();
  return points;
}

/// The model's number at ξ, its logarithm being linear between points. Absent outside, and where it
/// is not positive.
Maybe modelAt(double xi, double CosseratPoint::*of) {
  const std::vector<CosseratPoint>& model = modelAsPrinted();
  const auto above = std::ranges::lower_bound(model, xi, {}, &CosseratPoint::xi);
  if (above == model.end() || above == model.begin()) return std::nullopt;
  const CosseratPoint &right = *above, &left = *std::prev(above);
  if (!(left.*of > 0.0) || !(right.*of > 0.0)) return std::nullopt;
  const double share = (xi - left.xi) / (right.xi - left.xi);
  return std::exp((1.0 - share) * std::log(left.*of) + share * std::log(right.*of));
}

/// Root mean square of ln(model/run), both taken relative to their first ring.
Maybe distanceFromModel(const std::vector<RingValue>& rings, const CouetteCell& cell,
                        double CosseratPoint::*of) {
  std::vector<RingValue> off;
  for (RingValue each : rings) {
    const auto model =
        modelAt((each.r - cell.innerRadius) / (cell.outerRadius - cell.innerRadius), of);
    if (!model || !(each.value > 0.0)) continue;
    each.value = std::log(*model) - std::log(each.value);
    off.push_back(each);
  }
  if (off.size() < 3 || off.front().ring != 0) return std::nullopt;
  const double first = off.front().value;
  for (RingValue& each : off) each.value -= first;
  return rmsOf(off);
}

Maybe modelVelocity(const CaseRun& at, const ClaimScope& scope) {
  return distanceFromModel(ringsOf(at, "azimuthal_velocity", {0.0, scope.number("fit_to")}),
                           at.setup->cell, &CosseratPoint::u);
}

/// Of the size of the mean spin over each ring and the one outside of it, at the edge between them:
/// the oscillation from layer to layer cancels.
Maybe modelSpin(const CaseRun& at, const ClaimScope& scope) {
  const auto rings = ringsOf(at, "spin", {0.0, scope.number("fit_to")});
  std::vector<RingValue> pairs;
  for (std::size_t k = 0; k + 1 < rings.size(); ++k) {
    RingValue both = rings[k];
    both.r = 0.5 * (rings[k].r + rings[k + 1].r);
    both.value = std::abs(0.5 * (rings[k].value + rings[k + 1].value));
    pairs.push_back(both);
  }
  return distanceFromModel(pairs, at.setup->cell, &CosseratPoint::omega);
}

using NumberOfRun = Maybe (*)(const CaseRun& at, const ClaimScope& scope);
struct NamedNumber {
  std::string_view name;
  NumberOfRun of;
};

// clang-format off
constexpr NamedNumber numbersOfRun[] = {
    {"blocked_share", blockedShare},
    {"density_rest", [](auto& at, auto& scope) { return jointDensity("rest", at, scope); }},
    {"density_beside_rest", [](auto& at, auto& scope) { return jointDensity("beside_rest", at, scope); }},
    {"density_ridge", [](auto& at, auto& scope) { return jointDensity("ridge", at, scope); }},
    {"density_beside_ridge", [](auto& at, auto& scope) { return jointDensity("beside_ridge", at, scope); }},
    {"velocity_half", [](auto& at, auto&) { return velocityDensity(0.42, 0.58, at); }},
    {"velocity_before_half", [](auto& at, auto&) { return velocityDensity(0.18, 0.34, at); }},
    {"velocity_one", [](auto& at, auto&) { return velocityDensity(0.94, 1.06, at); }},
    {"velocity_before_one", [](auto& at, auto&) { return velocityDensity(0.78, 0.90, at); }},
    {"directions_tangential", [](auto& at, auto& scope) { return directionsInBand(pi / 2.0, at, scope); }},
    {"directions_shear_side", [](auto& at, auto& scope) { return directionsInBand(pi / 6.0, at, scope); }},
    {"directions_other_side", [](auto& at, auto& scope) { return directionsInBand(5.0 * pi / 6.0, at, scope); }},
    {"directions_left", [](auto& at, auto& scope) { return outerDirections(-pi / 6.0, at, scope); }},
    {"directions_right", [](auto& at, auto& scope) { return outerDirections(pi / 6.0, at, scope); }},
    {"directions_least", leastOuterDirections},
    {"anisotropy_inside", [](auto& at, auto&) { return anisotropy(0.5, at); }},
    {"anisotropy_outside", [](auto& at, auto&) { return meanOfBoth(anisotropy(8.0, at), anisotropy(12.0, at)); }},
    {"roughness", roughness},
    {"spin_period", spinPeriod},
    {"divergence_trace", divergenceTrace},
    {"model_velocity", modelVelocity},
    {"model_spin", modelSpin}};
// clang-format on

constexpr std::pair<std::string_view, std::optional<double> ThesisSpan::*> numbersOfSpans[] = {
    {"nu_wheel_", &ThesisSpan::volumeFractionAtWheel},
    {"nu_outside_", &ThesisSpan::volumeFractionOutside},
    {"pressure_", &ThesisSpan::outerPressure}};

}  // namespace

std::optional<FormulaValue> namedNumber(std::string_view name, const CaseRun& at,
                                        const ClaimScope& scope) {
  for (const auto* const numbers : {&scope.rule.numbers, &scope.rules.common})
    for (const ClaimNumber& number : *numbers)
      if (number.name == name) return chosen(number.value);
  for (const NamedNumber& number : numbersOfRun)
    if (number.name == name) return uncertain(number.of(at, scope));
  for (const auto& [prefix, quantity] : numbersOfSpans)
    if (name.starts_with(prefix)) {
      const ThesisSpan* const span = spanOf(name.substr(prefix.size()), at, scope);
      return uncertain(span ? span->*quantity : std::nullopt);
    }
  if (name == "exponent_rp") return exponentOf("stress_rp", at);
  if (name == "exponent_pr") return exponentOf("stress_pr", at);
  return std::nullopt;
}

double modelCoupleGrowth() {
  return modelAsPrinted().back().m / modelAsPrinted().front().m;
}

}  // namespace crossgrain::inline studies
