#include "averaging/transition_density.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace crossgrain::inline averaging {

namespace {

/// 1 or 0 at an x in units of its spread.
struct Outcome {
  double x = 0.0, y = 0.0;
};

/// Logistic regression of two parameters on x in units of its own spread.
struct Logistic {
  double level = 0.0, slope = 0.0;
  double i00 = 0.0, i01 = 0.0, i11 = 0.0;  ///< Fisher's information

  double determinant() const { return i00 * i11 - i01 * i01; }
};

/// A step of Newton's method on Firth's score Σ (y − p + h(½ − p)) (1, x); h are the hat values.
/// @returns the largest change
double firthStep(Logistic& fit, const std::vector<Outcome>& points) {
  std::vector<double> chance;
  fit.i00 = fit.i01 = fit.i11 = 0.0;
  for (const Outcome& at : points) {
    chance.push_back(1.0 / (1.0 + std::exp(-fit.level - fit.slope * at.x)));
    const double weight = chance.back() * (1.0 - chance.back());
    fit.i00 += weight;
    fit.i01 += weight * at.x;
    fit.i11 += weight * at.x * at.x;
  }
  const double det = fit.determinant();
  double score0 = 0.0, score1 = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double x = points[k].x, p = chance[k];
    const double hat = p * (1.0 - p) * (fit.i11 - 2.0 * x * fit.i01 + x * x * fit.i00) / det;
    const double residual = points[k].y - p + hat * (0.5 - p);
    score0 += residual;
    score1 += residual * x;
  }
  double d0 = (fit.i11 * score0 - fit.i01 * score1) / det;
  double d1 = (fit.i00 * score1 - fit.i01 * score0) / det;
  // Far steps overshoot where chances are near 0 and 1.
  const double largest = std::max(std::abs(d0), std::abs(d1));
  const double shorter = std::min(1.0, 1.0 / largest);
  fit.level += shorter * d0;
  fit.slope += shorter * d1;
  return largest;
}

}  // namespace

std::optional<TransitionDensity> transitionDensity(std::span<const LoadState> packings,
                                                   double beyond) {
  const auto carrying = std::ranges::count_if(packings, &LoadState::carries);
  if (carrying == 0 || carrying == std::ssize(packings)) return std::nullopt;
  const auto [low, high] = std::ranges::minmax(packings, {}, &LoadState::nu);
  const double middle = 0.5 * (low.nu + high.nu), unit = 0.5 * (high.nu - low.nu);
  if (!(unit > 0.0)) return std::nullopt;
  std::vector<Outcome> points;
  for (const LoadState& each : packings)
    points.push_back({(each.nu - middle) / unit, each.carries ? 1.0 : 0.0});
  Logistic fit;
  constexpr int mostSteps = 500;
  constexpr double settled = 1e-10;
  int steps = 0;
  while (firthStep(fit, points) > settled)
    if (++steps > mostSteps || !std::isfinite(fit.slope)) return std::nullopt;
  if (!(fit.slope > 0.0)) return std::nullopt;
  const double half = -fit.level / fit.slope;
  const double at = middle + unit * half;
  if (at < low.nu - beyond || at > high.nu + beyond) return std::nullopt;
  // Var(−a/b) = (Var a + 2 h Cov(a, b) + h² Var b)/b², h = −a/b.
  const double variance =
      (fit.i11 - 2.0 * half * fit.i01 + half * half * fit.i00) / fit.determinant();
  return TransitionDensity{at, unit * std::sqrt(variance) / fit.slope};
}

}  // namespace crossgrain::inline averaging
