#include "runs/cost/growth.hpp"

#include <fmt/format.h>
#include <gsl/gsl_fit.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace crossgrain::inline runs {

Growth fitGrowth(const std::vector<Separation>& separations, double most) {
  std::vector<double> time, logarithm;
  if (separations.empty()) return {};
  const double least = 10.0 * separations.front().value;
  for (const Separation& at : separations) {
    if (at.value > most) break;  // what comes after has forgotten how it began
    if (!(at.value > least)) continue;
    time.push_back(at.time);
    logarithm.push_back(std::log(at.value));
  }
  if (time.size() < 4) return {};
  double intercept = 0.0, slope = 0.0, var00 = 0.0, var01 = 0.0, var11 = 0.0, squares = 0.0;
  gsl_fit_linear(time.data(), 1, logarithm.data(), 1, time.size(), &intercept, &slope, &var00,
                 &var01, &var11, &squares);
  if (!(slope > 0.0)) return {};
  return {slope, std::sqrt(var11)};
}

double rmsDistance(const std::vector<Vec2>& a, const std::vector<Vec2>& b, double diameter) {
  double squares = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) squares += (a[k] - b[k]).squaredNorm();
  return std::sqrt(squares / static_cast<double>(a.size())) / diameter;
}

Scene perturbed(Scene scene, double shift) {
  std::mt19937_64 random(1);
  for (Vec2& position : scene.disks.position) {
    // Not std::uniform_real_distribution: libraries differ in what it draws.
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(random() >> 11) * 0x1p-53;
    position += shift * Vec2(std::cos(angle), std::sin(angle));
  }
  return scene;
}

Window trajectoryWindow(const Growth& growth, double error, double start, double most, double unit,
                        double longest) {
  double length = longest;
  std::string why =
      fmt::format("no exponential growth was seen: the longest window, {:.3g} s", longest);
  if (growth.exponent && error > 0.0) {
    const double grown = start + std::max(0.0, std::log(most / error)) / *growth.exponent;
    length = std::min(grown, longest);
    why = fmt::format(
        "the reference errs by {:.2g} d after {:.3g} s, which at {:.3g} /s grows to {:.2g} d in "
        "{:.3g} s{}",
        error, start, *growth.exponent, most, grown,
        grown > longest ? fmt::format("; the window is at most {:.3g} s", longest) : "");
  }
  const double units = std::max(1.0, std::floor(length / unit * (1.0 + 1e-12)));
  return {units * unit, why};
}

}  // namespace crossgrain::inline runs
