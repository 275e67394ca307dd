// Rate and cost: C9, C25.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "runs/thesis/claims_judges.hpp"
#include "runs/thesis/claims_rings.hpp"

namespace crossgrain::inline runs {
namespace {

constexpr double day = 86400.0;  // s
constexpr double hour = 3600.0;  // s

/// Slope of a number in lg Ω, with a level for each ν̄.
void putSlope(const ClaimScope& scope, Evidence& evidence, const std::string& figure,
              const RunSet& set, const std::function<std::optional<double>(const LegRun&)>& of) {
  std::vector<GroupedPoint> points;
  RunSet used;
  const double same = scope.common("same_label");
  for (const LegRun& at : set.runs) {
    const auto value = of(at);
    if (!value || !std::isfinite(*value)) continue;
    const auto level = static_cast<std::size_t>(std::lround(at.leg->label / same));
    points.push_back({std::log10(std::abs(at.leg->cell.omega)), *value, level});
    used.runs.push_back(at);
  }
  evidence.restsOn(used);
  evidence.put(figure, commonSlope(points),
               points.empty()
                   ? Evidence::missing(set)
                   : fmt::format("{}: {} with the data, no two rates at one ν̄ or none left for "
                                 "the error",
                                 set.words, points.size()));
}

/// Seconds of CPU that a rotation at that rate takes, by the steps that it has.
std::optional<double> secondsOfRotation(const LegRun& at, double omega) {
  const CouetteRun& run = at.run->run;
  if (!run.stats || !run.realised || run.stats->steps == 0 || !(run.realised->dt > 0.0))
    return std::nullopt;
  const double steps = 2.0 * std::numbers::pi / omega / run.realised->dt;
  return run.stats->cpuSeconds / static_cast<double>(run.stats->steps) * steps;
}

}  // namespace

void judgeRateIndependence(const ClaimScope& scope, Evidence& evidence) {
  RunSet slow = scope.family("rate"), fast = slow;
  const double to = scope.number("independent_to"), slack = 1e-6 * to;
  const auto outside = [&](double low, double high) {
    return [=, &scope](const LegRun& at) {
      const double omega = std::abs(at.leg->cell.omega);
      return omega < low || omega > high || at.leg->label < scope.common("flow_from");
    };
  };
  std::erase_if(slow.runs, outside(0.0, to + slack));
  std::erase_if(fast.runs, outside(to - slack, std::numeric_limits<double>::infinity()));
  slow.words += fmt::format(" up to Ω = {:g} /s", to);
  fast.words += fmt::format(" from Ω = {:g} /s on", to);
  // Per decade of Ω; as an exponent, per ln 10.
  const auto lnPressure = [](const LegRun& at) -> std::optional<double> {
    const auto log = logOf(averagedOf(at, &ThesisSpan::outerPressure));
    return over(log, std::numbers::ln10);
  };
  putSlope(scope, evidence, "exponent", slow, lnPressure);
  putSlope(scope, evidence, "exponent_fast", fast, lnPressure);
  putSlope(scope, evidence, "velocity", slow, [](const LegRun& at) -> std::optional<double> {
    const auto velocity = inRing(at, "azimuthal_velocity", 0);
    const CouetteCell& cell = at.leg->cell;
    if (!velocity) return std::nullopt;
    return velocity->value / (cell.omega * cell.innerRadius);
  });
  putSlope(scope, evidence, "length", slow, [](const LegRun& at) -> std::optional<double> {
    const auto length = fitOf(at, "velocity_decay");
    if (!length) return std::nullopt;
    return logOf(length->value);
  });
}

void judgeCost(const ClaimScope& scope, Evidence& evidence) {
  const RunSet set = scope.flow();
  const double omega = scope.number("omega"), then = scope.number("days") * day;
  evidence.mean("speed_up", set, [=](const LegRun& at) -> std::optional<Measured> {
    return over(then, secondsOfRotation(at, omega));
  });
  evidence.mean("hours", set, [=](const LegRun& at) -> std::optional<Measured> {
    return over(secondsOfRotation(at, omega), hour);
  });
}

}  // namespace crossgrain::inline runs
