#include "runs/cost/order.hpp"

#include <fmt/format.h>
#include <gsl/gsl_fit.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "averaging/statistics.hpp"

namespace crossgrain::inline runs {

namespace {

constexpr double aboveFloor = 3.0;
constexpr double slopeTolerance = 0.5;  ///< tells neighbouring orders apart
constexpr double bend = 0.15;
constexpr double confidence = 0.95;
constexpr std::size_t fewest = 3;

using Points = std::vector<CostPoint>;
using Indices = std::vector<std::size_t>;

double slopeBetween(const CostPoint& a, const CostPoint& b) {
  return std::log(*b.error / *a.error) / std::log(*b.dt / *a.dt);
}

/// Why a point cannot be in any fit; empty if it can.
std::string unusable(const CostPoint& point) {
  if (!point.ran()) {
    const std::string status = toString(point.status);
    return point.reason.empty() ? status : status + ": " + point.reason;
  }
  if (!point.dt) return "no time step is known";
  if (!point.error) return "no error is known";
  if (*point.error <= 0.0) return "no error is left";
  if (point.kind == CostKind::averages && !point.statistical)
    return "no statistical error is known";
  if (point.referenceError && *point.error < aboveFloor * *point.referenceError)
    return fmt::format("below {} times the reference's own error", aboveFloor);
  if (point.statistical && *point.error < aboveFloor * *point.statistical)
    return fmt::format("below {} times its statistical error", aboveFloor);
  return {};
}

/// The level at which the error stops falling with the step; absent if it does not.
std::optional<double> plateau(const Points& points, const Indices& rising) {
  std::optional<double> level;
  for (std::size_t k = 1; k < rising.size(); ++k) {
    const CostPoint &a = points[rising[k - 1]], &b = points[rising[k]];
    if (slopeBetween(a, b) >= slopeTolerance) break;
    level = std::max({level.value_or(0.0), *a.error, *b.error});
  }
  return level;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

bool straight(const std::vector<double>& slopes) {
  const double middle = median(slopes);
  return std::ranges::all_of(slopes,
                             [&](double s) { return std::abs(s - middle) < slopeTolerance; });
}

/// First and number of the longest run of neighbours with one slope.
std::pair<std::size_t, std::size_t> asymptoticRange(const Points& points, const Indices& rising) {
  std::pair<std::size_t, std::size_t> best{0, 0};
  for (std::size_t first = 0; first < rising.size(); ++first) {
    std::vector<double> slopes;
    for (std::size_t last = first + 1; last < rising.size(); ++last) {
      slopes.push_back(slopeBetween(points[rising[last - 1]], points[rising[last]]));
      const std::size_t count = last - first + 1;
      if (count > best.second && straight(slopes)) best = {first, count};
    }
  }
  return best;
}

void fitLine(OrderFit& fit, const Points& points) {
  std::vector<double> x, y;
  for (const std::size_t k : fit.used) {
    x.push_back(std::log(*points[k].dt));
    y.push_back(std::log(*points[k].error));
  }
  double intercept = 0.0, slope = 0.0, var00 = 0.0, var01 = 0.0, var11 = 0.0, squares = 0.0;
  gsl_fit_linear(x.data(), 1, y.data(), 1, x.size(), &intercept, &slope, &var00, &var01, &var11,
                 &squares);
  fit.order = slope;
  fit.standardError = std::sqrt(var11);
  fit.halfWidth =
      *fit.standardError * studentQuantile(confidence, static_cast<double>(x.size() - 2));
  fit.amplitude = std::exp(intercept);
}

OrderVerdict verdictOn(const OrderFit& fit) {
  if (!fit.order) return OrderVerdict::noFit;
  if (!fit.theory) return OrderVerdict::noClaim;
  const double distance = *fit.order - *fit.theory, reach = *fit.halfWidth + bend;
  if (distance < -reach) return OrderVerdict::notMet;
  if (distance > reach) return OrderVerdict::exceeded;
  return *fit.halfWidth > slopeTolerance ? OrderVerdict::undecided : OrderVerdict::met;
}

/// Points that can be fitted, by rising dt, one per dt; the others go to fit.leftOut.
Indices usable(const Points& points, OrderFit& fit) {
  Indices rising(points.size());
  for (std::size_t k = 0; k < rising.size(); ++k) rising[k] = k;
  std::ranges::stable_sort(rising, {}, [&](std::size_t k) { return points[k].dt; });
  Indices kept;
  for (const std::size_t k : rising) {
    std::string why = unusable(points[k]);
    if (why.empty() && !kept.empty() && points[kept.back()].dt == points[k].dt)
      why = "the same step again";
    if (why.empty())
      kept.push_back(k);
    else
      fit.leftOut.push_back({k, why});
  }
  return kept;
}

}  // namespace

OrderFit fitOrder(const std::vector<CostPoint>& points, std::optional<double> theory) {
  OrderFit fit;
  if (!points.empty()) {
    fit.engine = points.front().engine;
    fit.kind = points.front().kind;
    fit.measure = points.front().measure;
  }
  fit.theory = theory;
  Indices rising = usable(points, fit);
  const auto level = plateau(points, rising);
  if (level) {
    const auto atFloor = [&](std::size_t k) { return *points[k].error < aboveFloor * *level; };
    for (const std::size_t k : rising)
      if (atFloor(k)) fit.leftOut.push_back({k, "where the error stops falling with the step"});
    std::erase_if(rising, atFloor);
  }
  const auto [first, count] = asymptoticRange(points, rising);
  for (std::size_t k = 0; k < rising.size(); ++k)
    if (count >= fewest && k >= first && k < first + count)
      fit.used.push_back(rising[k]);
    else
      fit.leftOut.push_back({rising[k], count >= fewest ? "the local slope departs" : "too few"});
  if (!fit.used.empty()) {
    fit.dtLow = points[fit.used.front()].dt;
    fit.dtHigh = points[fit.used.back()].dt;
    fitLine(fit, points);
  }
  fit.verdict = verdictOn(fit);
  if (!fit.order)
    fit.reason = level && rising.size() < fewest
                     ? fmt::format("the error stops falling with the step at {:.2g}", *level)
                     : "fewer than three points in the asymptotic range";
  return fit;
}

namespace {

std::optional<double> claimOf(const std::map<std::string, int>& theory, const std::string& engine,
                              const std::string& integrator) {
  const auto claim = theory.find(integrator.empty() ? engine : engine + " " + integrator);
  return claim == theory.end() ? std::nullopt : std::optional<double>(claim->second);
}

bool severalSteps(const Points& points) {
  return std::ranges::any_of(points, [&](const CostPoint& p) { return p.dt != points.front().dt; });
}

}  // namespace

std::vector<OrderFit> fitOrders(const std::vector<CostPoint>& points,
                                const std::map<std::string, int>& theory) {
  using Group = std::tuple<std::string, CostKind, std::string, std::string>;
  std::vector<std::pair<Group, Indices>> groups;  // in the order of the points
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto scheme = schemeOf(points[k].knob, points[k].setting);
    if (!scheme) continue;
    const Group group{points[k].engine, points[k].kind, points[k].measure, *scheme};
    auto found = std::ranges::find(groups, group, &std::pair<Group, Indices>::first);
    if (found == groups.end()) found = groups.insert(groups.end(), {group, {}});
    found->second.push_back(k);
  }
  std::vector<OrderFit> fits;
  for (const auto& [group, members] : groups) {
    Points own;
    for (const std::size_t k : members) own.push_back(points[k]);
    if (!severalSteps(own)) continue;
    const std::string& integrator = std::get<3>(group);
    OrderFit fit = fitOrder(own, claimOf(theory, std::get<0>(group), integrator));
    fit.integrator = integrator;
    for (std::size_t& k : fit.used) k = members[k];
    for (LeftOut& left : fit.leftOut) left.point = members[left.point];
    fits.push_back(std::move(fit));
  }
  return fits;
}

}  // namespace crossgrain::inline runs
