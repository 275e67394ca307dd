#include "studies/flow/endpoint_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/flow.hpp"
#include "studies/flow/frame.hpp"
#include "studies/flow/summary.hpp"

namespace crossgrain::inline studies {

namespace {

using Value = std::optional<double>;

/// Slope of the straight line through the points that are there, by weighted least squares:
/// Σ w (x − x̄)(y − ȳ) / Σ w (x − x̄)².
Value slopeOf(const std::vector<double>& x, const Numbers& y, const std::vector<double>& weight) {
  const std::size_t size = std::min({x.size(), y.size(), weight.size()});
  double whole = 0.0, meanX = 0.0, meanY = 0.0;
  for (std::size_t k = 0; k < size; ++k)
    if (y[k]) {
      whole += weight[k];
      meanX += weight[k] * x[k];
      meanY += weight[k] * *y[k];
    }
  if (!(whole > 0.0)) return {};
  meanX /= whole;
  meanY /= whole;
  double both = 0.0, square = 0.0;
  for (std::size_t k = 0; k < size; ++k)
    if (y[k]) {
      both += weight[k] * (x[k] - meanX) * (*y[k] - meanY);
      square += weight[k] * (x[k] - meanX) * (x[k] - meanX);
    }
  return square > 0.0 ? Value(both / square) : Value{};
}

/// A series where it is there, in the order of time.
struct Points {
  std::vector<double> t, y;
};

/// At t, on the parabola through point k and its two neighbours (Lagrange's form). Fewer than three
/// points: through those that are there.
double onParabola(const Points& points, std::size_t k, double t) {
  const std::size_t count = std::min<std::size_t>(3, points.t.size());
  const std::size_t first = std::min(k > 0 ? k - 1 : 0, points.t.size() - count);
  double sum = 0.0;
  for (std::size_t i = first; i < first + count; ++i) {
    double term = points.y[i];
    for (std::size_t j = first; j < first + count; ++j)
      if (j != i) term *= (t - points.t[j]) / (points.t[i] - points.t[j]);
    sum += term;
  }
  return sum;
}

double atTime(const Points& points, double t) {
  const auto nearest =
      std::ranges::min_element(points.t, {}, [t](double each) { return std::abs(each - t); });
  return onParabola(points, static_cast<std::size_t>(nearest - points.t.begin()), t);
}

/// y = y_k + slope (t − t_k) + bend (t − t_k)², through point k and its two neighbours.
struct Parabola {
  double slope, bend;
};
Parabola parabolaAt(const Points& points, std::size_t k) {
  const double before = points.t[k - 1] - points.t[k], after = points.t[k + 1] - points.t[k];
  const double left = (points.y[k - 1] - points.y[k]) / before,
               right = (points.y[k + 1] - points.y[k]) / after;
  const double bend = (right - left) / (after - before);
  return {left - bend * before, bend};
}

/// Of y, or of −y for the smallest. What flies freely lies on a parabola; at either end, or where
/// the three are on a line, the point itself is all that is known. So it is where a velocity jumps:
/// a parabola from before a jump to after it rises above both, by up to an eighth of the jump, to a
/// value that never was. Three points do not tell a peak from a jump, a fourth does: next to a peak
/// the curve bends as at it, exactly so in free flight and to (ωΔt)²/2 in a swing, while beside a
/// jump by J it bends by J/2Δt² the other way, or as little as on its own. A quarter takes every
/// peak of nine snapshots a period, on which the parabola is right to 1 %.
double largest(const Points& points, double sign) {
  constexpr double sameBend = 0.25;
  const auto top = std::ranges::max_element(points.y, {}, [sign](double y) { return sign * y; });
  const auto k = static_cast<std::size_t>(top - points.y.begin()), last = points.y.size() - 1;
  if (k == 0 || k == last) return *top;
  const auto [slope, bend] = parabolaAt(points, k);
  const auto bendsAlike = [&](std::size_t at) {
    return at > 0 && at < last &&
           std::abs(parabolaAt(points, at).bend - bend) <= sameBend * std::abs(bend);
  };
  const bool smooth = last < 3 || bendsAlike(k - 1) || bendsAlike(k + 1);
  return bend == 0.0 || !smooth ? *top : *top - slope * slope / (4.0 * bend);
}

/// On the straight line between the two points on either side of the level.
Value whenAt(const Points& points, double level) {
  for (std::size_t k = 0; k < points.t.size(); ++k) {
    const double now = points.y[k] - level;
    if (now == 0.0) return points.t[k];
    if (k == 0 || (now > 0.0) == (points.y[k - 1] > level)) continue;
    const double before = points.y[k - 1] - level;
    return points.t[k - 1] + (points.t[k] - points.t[k - 1]) * before / (before - now);
  }
  return {};
}

bool isOfContacts(const std::string& quantity, int dimension) {
  const auto numbers = regionNumbers(dimension);
  const auto found = std::ranges::find(numbers, quantity, &RegionNumber::name);
  return found != numbers.end() && found->ofContacts;
}

std::string missing(const std::string& what, std::size_t count, std::size_t all) {
  return fmt::format("{} in {} of {} snapshots", what, count, all);
}

/// The time of which no snapshot of the run is, so that there is no value of one time; absent:
/// there is one. An engine's snapshots are at the end, and no further from any other time than they
/// are apart; files may be of a part of the averaged time [s].
std::optional<double> missedTime(const Endpoint& how, const Case& setup, const RunSeries& series) {
  const bool atEnd = how.reduction == Reduction::end && !how.between;
  if (!atEnd && how.reduction != Reduction::end && how.reduction != Reduction::time) return {};
  const FlowTimes averaged = flowTimes(setup);
  const double t = atEnd                              ? averaged.end()
                   : how.reduction == Reduction::time ? how.level
                                                      : how.between->second;
  const double within = (atEnd ? 0.5 : 1.0) * averaged.interval * (1.0 + 1e-6);
  const Numbers& times = valuesOf(series, "t_s");
  const bool covered = !times.empty() && times.front() && times.back() &&
                       t >= *times.front() - within && t <= *times.back() + within;
  return covered ? std::nullopt : std::optional(t);
}

EndpointValue ofSeries(const std::string& quantity, const Endpoint& how, const Case& setup,
                       const FlowRun& run) {
  if (!run.series) return {};
  const std::string name = how.disk || how.wall ? how.series() : quantity;
  // A disk's velocity may be of another instant than its place.
  const bool ofVelocity = how.disk && quantity != "x" && quantity != "y" && quantity != "z";
  const Numbers& values = valuesOf(*run.series, name);
  const Numbers& times = valuesOf(*run.series, ofVelocity ? "velocity_t_s" : "t_s");
  Points points;
  std::size_t all = 0;
  Value last;
  for (std::size_t k = 0; k < std::min(values.size(), times.size()); ++k) {
    const auto [from, to] = how.between.value_or(std::pair(-INFINITY, INFINITY));
    if (!times[k] || *times[k] < from || *times[k] > to) continue;
    ++all;
    last = values[k] ? Value(*values[k] / how.area) : Value{};
    if (!last) continue;
    points.t.push_back(*times[k]);
    points.y.push_back(*last);
  }
  if (const auto t = missedTime(how, setup, *run.series))
    return {{}, fmt::format("no snapshot near t = {:.6g} s", *t), true};
  if (all == 0)
    return {{},
            how.between ? fmt::format("no snapshot from {:g} to {:g} s", how.between->first,
                                      how.between->second)
                        : "",
            how.between.has_value()};
  const std::size_t absent = all - points.t.size();
  const bool extreme = how.reduction == Reduction::maximum || how.reduction == Reduction::minimum;
  const bool gap = static_cast<double>(absent) > mostMissing * static_cast<double>(all);
  if (points.t.empty() || (gap && !(extreme && isOfContacts(quantity, setup.dimension)) &&
                           how.reduction != Reduction::end))
    return {{}, missing("no " + name, absent, all)};
  switch (how.reduction) {
    case Reduction::end:
      // With `between` the value at its end, where a snapshot need not be.
      return {how.between && last ? Value(atTime(points, how.between->second)) : last, ""};
    case Reduction::rate:
      return {slopeOf(points.t, Numbers(points.y.begin(), points.y.end()),
                      std::vector(points.t.size(), 1.0)),
              ""};
    case Reduction::maximum:
      return {largest(points, 1.0), ""};
    case Reduction::minimum:
      return {largest(points, -1.0), ""};
    case Reduction::time:
      return {atTime(points, how.level), ""};
    case Reduction::reaches:
      if (const Value t = whenAt(points, how.level)) return {t, ""};
      return {{}, fmt::format("{} never is {:g}", name, how.level)};
    default:
      break;
  }
  double sum = 0.0;
  for (const double y : points.y) sum += y;
  return {sum / static_cast<double>(points.y.size()), ""};
}

EndpointValue ofField(const std::string& field, const Endpoint& how, const Case& setup,
                      const FlowRun& run) {
  if (how.reduction == Reduction::bin) {
    const Profile* profile = profileOf(run.profiles, setup.averaging.methods.front(), field);
    const auto bin = static_cast<std::size_t>(how.bin);
    return {profile && bin < profile->mean.size() ? profile->mean[bin] : Value{}, ""};
  }
  const Numbers& disks = run.series ? valuesOf(*run.series, "disks") : Numbers{};
  const auto empty = static_cast<std::size_t>(std::ranges::count(disks, std::optional(0.0)));
  if (static_cast<double>(empty) > mostMissing * static_cast<double>(disks.size()))
    return {{},
            missing(fmt::format("no {} in the averaged part", anyConvex(setup) ? "body" : "disk"),
                    empty, disks.size())};
  if (how.reduction == Reduction::mean) return {cellMean(setup, run, field), ""};
  const auto [value, weight] = weightedBins(setup, run, field);
  return {slopeOf(placesOf(setup).r, value, weight), ""};
}

EndpointValue reduced(const std::string& quantity, const Endpoint& how, const Case& setup,
                      const FlowRun& run) {
  if (quantity == planePressure && setup.dimension == 2) {  // a flow without contacts has none
    const Value rr = ofField("stress_rr", how, setup, run).value,
                pp = ofField("stress_pp", how, setup, run).value;
    if (!rr || !pp || !(*rr + *pp > 0.0)) return {};
    return {0.5 * (*rr + *pp), ""};
  }
  if (quantity == sceneCoordination) return ofSeries("coordination", how, setup, run);
  const auto numbers = regionNumbers(setup.dimension);
  if (how.disk || how.wall ||
      std::ranges::find(numbers, quantity, &RegionNumber::name) != numbers.end())
    return ofSeries(quantity, how, setup, run);
  return ofField(quantity, how, setup, run);
}

}  // namespace

EndpointValue endpointValue(const Endpoint& endpoint, const Case& setup, const FlowRun& run) {
  const EndpointValue own = reduced(endpoint.quantity, endpoint, setup, run);
  if (endpoint.per.empty() || !own.value) return own;
  const EndpointValue below = reduced(endpoint.per, endpoint, setup, run);
  if (!below.value) return below;
  if (*below.value == 0.0) return {{}, endpoint.per + " is 0"};
  return {*own.value / *below.value, ""};
}

}  // namespace crossgrain::inline studies
