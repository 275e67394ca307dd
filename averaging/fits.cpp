#include "averaging/fits.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "averaging/agreement.hpp"
#include "averaging/least_squares.hpp"

namespace crossgrain::inline averaging {

namespace {

constexpr double pi = std::numbers::pi;

/// Correlation of a parameter with the phase beyond which their linearised errors mean nothing: the
/// valley of equal χ² is bent. (Of amplitude and decay length it is only an extrapolation to x =
/// 0.)
constexpr double inseparable = 0.95;

/// Largest χ²/dof of a weighted fit. At 100 the points lie ten of their own errors off the curve,
/// root mean square: what they follow is another curve, and parameters with errors blown up tenfold
/// would be those of the wrong one. (Errors of a profile's rings are too small by a factor of two
/// or three where rings share disks, so that a good fit may well have 10.)
constexpr double largestChi2PerDof = 100.0;

/// Largest value of a decaying curve at x = 0, in units of the spread of the points. A curve that
/// rises tenfold between its first point and x = 0 rests on that point alone.
constexpr double largestExtrapolation = 10.0;

/// A law y = Σ_k c_k g_k(x; q), linear but for the shape q. The best of a grid of q starts the fit.
struct Law {
  std::vector<std::string> names;
  double lastPeriod = 0.0;     ///< of the last parameter, > 0: an angle
  std::vector<double> shapes;  ///< the grid, rising; a fit that leaves it has not found q
  std::size_t shapeIndex;      ///< of q among the parameters
  std::function<std::vector<double>(double x, double q)> basis;
  std::function<std::vector<double>(const std::vector<double>& c, double q)> parameters;
  std::function<double(const std::vector<double>& p, double x)> value;
  bool constantIsNull = false;  ///< no signal means y = const rather than y = 0
  /// Of a law that decays from x = 0: how far, in units of x, and by how much.
  std::function<double(const std::vector<double>&p)> length = {}, amplitude = {};
};

std::vector<double> geometric(double from, double to, int count) {
  std::vector<double> grid;
  for (int k = 0; k < count; ++k) grid.push_back(from * std::pow(to / from, k / (count - 1.0)));
  return grid;
}

/// The law's best linear coefficients for one shape.
std::optional<LinearSolution> solveAt(const Law& law, const WeightedPoints& points, double q) {
  return solveLinear(
      points, [&](double x) { return law.basis(x, q); }, law.basis(0.5, q).size());
}

double chi2At(const Law& law, const WeightedPoints& points, double q) {
  const auto solution = solveAt(law, points, q);
  return solution ? solution->chi2 : std::numeric_limits<double>::infinity();
}

/// Golden section between two shapes that enclose a minimum.
double refinedShape(const Law& law, const WeightedPoints& points, double low, double high) {
  const double section = 1.0 / std::numbers::phi;
  double left = high - section * (high - low);
  double right = low + section * (high - low);
  double atLeft = chi2At(law, points, left);
  double atRight = chi2At(law, points, right);
  for (int k = 0; k < 40; ++k) {
    if (atLeft < atRight) {
      high = std::exchange(right, left);
      atRight = atLeft;
      left = high - section * (high - low);
      atLeft = chi2At(law, points, left);
    } else {
      low = std::exchange(left, right);
      atLeft = atRight;
      right = low + section * (high - low);
      atRight = chi2At(law, points, right);
    }
  }
  return 0.5 * (low + high);
}

/// Parameters near the least sum of squares: the grid finds the valley, golden section its bottom.
/// Empty if no shape can be solved for.
std::vector<double> bestStart(const Law& law, const WeightedPoints& points) {
  double least = std::numeric_limits<double>::infinity();
  std::size_t best = 0;
  for (std::size_t k = 0; k < law.shapes.size(); ++k) {
    const double chi2 = chi2At(law, points, law.shapes[k]);
    if (!(chi2 < least)) continue;
    least = chi2;
    best = k;
  }
  if (!std::isfinite(least)) return {};
  double q = refinedShape(law, points, law.shapes[best - (best > 0)],
                          law.shapes[std::min(best + 1, law.shapes.size() - 1)]);
  if (!(chi2At(law, points, q) <= least)) q = law.shapes[best];
  return law.parameters(solveAt(law, points, q)->coefficients, q);
}

/// Sum of squares of the law without a signal, and how many parameters that has.
std::pair<double, int> nullModel(const Law& law, const WeightedPoints& points) {
  double weights = 0.0;
  double weightedSum = 0.0;
  for (std::size_t k = 0; k < points.x.size(); ++k) {
    weights += points.weight[k];
    weightedSum += points.weight[k] * points.y[k];
  }
  const double level = law.constantIsNull ? weightedSum / weights : 0.0;
  double chi2 = 0.0;
  for (std::size_t k = 0; k < points.x.size(); ++k)
    chi2 += points.weight[k] * (points.y[k] - level) * (points.y[k] - level);
  return {chi2, law.constantIsNull ? 1 : 0};
}

bool determined(const FitParameter& p) {
  if (!std::isfinite(p.value) || !p.standardError || !std::isfinite(*p.standardError)) return false;
  return p.period == 0.0 || *p.standardError < 0.25 * p.period;
}

/// Why the points do not determine the decay that was fitted to them; empty if they can. Longer
/// than their range it is a straight line to them, of which only the slope, amplitude over length,
/// is seen; shorter than half a spacing only the first point feels it.
std::string outOfReach(const Law& law, const WeightedPoints& points, const Fit& fit) {
  if (!law.length) return {};
  std::vector<double> p;
  for (const FitParameter& parameter : fit.parameters) p.push_back(parameter.value);
  const double length = law.length(p), amplitude = std::abs(law.amplitude(p));
  const auto [first, last] = std::ranges::minmax(points.x);
  const double range = last - first;
  const double spacing = range / (static_cast<double>(points.x.size()) - 1.0);
  if (length > range)
    return fmt::format(
        "the decay length {:.3g} is beyond the range {:.3g} of the points: they "
        "show a straight line",
        length, range);
  if (length < 0.5 * spacing)
    return fmt::format("the decay length {:.3g} is below half the spacing {:.3g} of the points",
                       length, spacing);
  const auto [low, high] = std::ranges::minmax(points.y);
  const double spread = law.constantIsNull ? high - low : std::max(std::abs(low), std::abs(high));
  if (amplitude > largestExtrapolation * spread)
    return fmt::format(
        "the amplitude {:.3g} is more than {:g} times the {:.3g} that the points "
        "span",
        amplitude, largestExtrapolation, spread);
  return {};
}

/// Why the fit is not to be believed; empty if it is.
std::string objection(const Law& law, const WeightedPoints& points,
                      const NonlinearSolution& solution, const Fit& fit) {
  for (const FitParameter& p : fit.parameters)
    if (!determined(p)) return fmt::format("the points do not determine {}", p.name);
  if (law.lastPeriod > 0.0)
    for (std::size_t k = 0; k + 1 < law.names.size(); ++k)
      if (const double both = std::abs(solution.correlationWithLast[k]); both > inseparable)
        return fmt::format("the points do not separate {} from {} (correlation {:.3f})",
                           law.names[k], law.names.back(), both);
  const FitParameter& shape = fit.parameters[law.shapeIndex];
  if (shape.value < law.shapes.front() || shape.value > law.shapes.back())
    return fmt::format("{} = {:.3g} ran out of the range {:.3g} to {:.3g} that is fitted",
                       shape.name, shape.value, law.shapes.front(), law.shapes.back());
  if (std::string reach = outOfReach(law, points, fit); !reach.empty()) return reach;
  const auto [nullChi2, nullParameters] = nullModel(law, points);
  const double gained = static_cast<double>(fit.parameters.size()) - nullParameters;
  const double ratio = (nullChi2 - fit.chi2) / gained / (fit.chi2 / fit.dof);
  const double chance =
      fit.chi2 > 0.0 ? gsl_cdf_fdist_Q(std::max(ratio, 0.0), gained, fit.dof) : 0.0;
  if (!(chance < 0.01))
    return fmt::format("no better than {} (F test: p = {:.2g}, 0.01 wanted)",
                       law.constantIsNull ? "a constant" : "zero", chance);
  if (fit.weighted && fit.chi2 / fit.dof > largestChi2PerDof)
    return fmt::format("the points do not follow the curve: χ²/dof = {:.3g}, at most {:g} wanted",
                       fit.chi2 / fit.dof, largestChi2PerDof);
  return {};
}

Fit fitLaw(const Law& law, std::span<const FitPoint> given) {
  Fit fit;
  const WeightedPoints points = weightedPoints(given);
  const std::size_t unknowns = law.names.size();
  fit.weighted = points.weighted;
  fit.dof = static_cast<int>(points.x.size()) - static_cast<int>(unknowns);
  if (fit.dof < 1) {
    fit.reason =
        fmt::format("{} points in range, at least {} wanted", points.x.size(), unknowns + 1);
    return fit;
  }
  const std::vector<double> start = bestStart(law, points);
  if (start.empty()) {
    fit.reason = "no start found: the points are degenerate";
    return fit;
  }
  const NonlinearSolution solution = solveNonlinear(points, law.value, start);
  if (!solution.reason.empty()) {
    fit.reason = solution.reason;
    return fit;
  }
  fit.chi2 = solution.chi2;
  const double perDof = fit.chi2 / fit.dof;
  const double scale = std::sqrt(points.weighted ? std::max(perDof, 1.0) : perDof);
  for (std::size_t k = 0; k < unknowns; ++k)
    fit.parameters.push_back({law.names[k], solution.parameters[k],
                              scale * solution.standardErrors[k],
                              k + 1 < unknowns ? 0.0 : law.lastPeriod});
  fit.reason = objection(law, points, solution, fit);
  fit.converged = fit.reason.empty();
  return fit;
}

std::vector<FitPoint> inRange(std::span<const FitPoint> points, bool (*inside)(double)) {
  std::vector<FitPoint> result;
  std::ranges::copy_if(points, std::back_inserter(result), inside, &FitPoint::x);
  return result;
}

std::vector<FitPoint> pointsOf(const Rings& rings, const Profile& profile, double scale,
                               const std::function<double(int)>& x) {
  std::vector<FitPoint> points;
  for (int ring = 0; ring < rings.count(); ++ring) {
    const auto k = static_cast<std::size_t>(ring);
    if (!profile.mean[k]) continue;
    FitPoint point{x(ring), scale * *profile.mean[k], profile.standardError[k]};
    if (point.standardError) *point.standardError *= std::abs(scale);
    points.push_back(point);
  }
  return points;
}

/// A > 0 and φ within ±π say the same as any other pair.
void makeCanonical(Fit& fit) {
  if (fit.parameters.empty()) return;
  FitParameter& amplitude = fit.parameters[0];
  FitParameter& phase = fit.parameters[2];
  if (amplitude.value < 0.0) {
    amplitude.value = -amplitude.value;
    phase.value += pi;
  }
  phase.value = std::remainder(phase.value, 2.0 * pi);
}

}  // namespace

Fit fitPowerLaw(std::span<const FitPoint> points) {
  std::vector<double> exponents;
  for (int k = -40; k <= 20; ++k) exponents.push_back(0.25 * k);
  const Law law{.names = {"A", "p"},
                .shapes = exponents,
                .shapeIndex = 1,
                .basis = [](double x, double p) { return std::vector{std::pow(x, p)}; },
                .parameters =
                    [](const auto& c, double p) {
                      return std::vector{c[0], p};
                    },
                .value = [](const auto& p, double x) { return p[0] * std::pow(x, p[1]); }};
  return fitLaw(law, inRange(points, [](double x) { return x > 0.0; }));
}

Fit fitVelocityDecay(std::span<const FitPoint> points) {
  const Law law{.names = {"A", "B"},
                .shapes = geometric(0.05, 50.0, 61),
                .shapeIndex = 1,
                .basis = [](double x, double b) { return std::vector{std::exp(-x / b)}; },
                .parameters =
                    [](const auto& c, double b) {
                      return std::vector{c[0], b};
                    },
                .value = [](const auto& p, double x) { return p[0] * std::exp(-x / p[1]); },
                .length = [](const auto& p) { return p[1]; },
                .amplitude = [](const auto& p) { return p[0]; }};
  return fitLaw(law, inRange(points, [](double x) { return x > 0.0 && x < 6.0; }));
}

Fit fitDilation(std::span<const FitPoint> points) {
  const Law law{.names = {"nu0", "B", "C"},
                .shapes = geometric(0.02, 20.0, 61),
                .shapeIndex = 2,
                .basis =
                    [](double x, double c) {
                      return std::vector{1.0, -std::exp(-c * x)};
                    },
                .parameters =
                    [](const auto& c, double shape) {
                      return std::vector{c[0], c[1], shape};
                    },
                .value = [](const auto& p, double x) { return p[0] - p[1] * std::exp(-p[2] * x); },
                .constantIsNull = true,
                .length = [](const auto& p) { return 1.0 / p[2]; },
                .amplitude = [](const auto& p) { return p[1]; }};
  return fitLaw(law, inRange(points, [](double x) { return x >= 0.5 && x <= 8.5; }));
}

Fit fitSpinOscillation(std::span<const FitPoint> points) {
  const Law law{
      .names = {"A", "B", "phi"},
      .lastPeriod = 2.0 * pi,
      .shapes = geometric(0.02, 20.0, 61),
      .shapeIndex = 1,
      .basis =
          [](double x, double b) {
            return std::vector{std::exp(-b * x) * std::cos(pi * x),
                               -std::exp(-b * x) * std::sin(pi * x)};
          },
      .parameters =
          [](const auto& c, double b) {
            return std::vector{std::hypot(c[0], c[1]), b, std::atan2(c[1], c[0])};
          },
      .value = [](const auto& p,
                  double x) { return p[0] * std::exp(-p[1] * x) * std::cos(pi * x + p[2]); },
      .length = [](const auto& p) { return 1.0 / p[1]; },
      .amplitude = [](const auto& p) { return p[0]; }};
  Fit fit = fitLaw(law, points);
  makeCanonical(fit);
  return fit;
}

double spinScale(const Rings& rings, double omega) {
  return rings.diameter() / (omega * 2.0 * rings.innerRadius());
}

std::vector<FitPoint> pointsOverRTilde(const Rings& rings, const Profile& profile, double scale) {
  return pointsOf(rings, profile, scale, [&](int ring) { return rings.rTilde(ring); });
}

std::vector<FitPoint> pointsOverRadius(const Rings& rings, const Profile& profile, double scale) {
  return pointsOf(rings, profile, scale,
                  [&](int ring) { return rings.centre(ring) / rings.innerRadius(); });
}

EnsembleFit ensembleFit(std::span<const Fit> perPacking) {
  EnsembleFit result;
  result.packings = static_cast<int>(perPacking.size());
  std::vector<const Fit*> good;
  for (const Fit& fit : perPacking)
    if (fit.converged) good.push_back(&fit);
  result.converged = static_cast<int>(good.size());
  if (good.empty()) return result;
  for (std::size_t k = 0; k < good.front()->parameters.size(); ++k) {
    FitParameter parameter = good.front()->parameters[k];
    std::vector<std::optional<double>> values;
    for (const Fit* fit : good) {
      const double step = fit->parameters[k].value - parameter.value;
      // Angles next to the first packing's, not on the far side of ±π.
      values.push_back(parameter.value +
                       (parameter.period > 0.0 ? std::remainder(step, parameter.period) : step));
    }
    const auto mean = ensembleMean(values);
    parameter.value = mean->mean;
    parameter.standardError = mean->standardError;
    result.parameters.push_back(parameter);
  }
  return result;
}

}  // namespace crossgrain::inline averaging
