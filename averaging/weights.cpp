#include "averaging/weights.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace crossgrain {

namespace {

constexpr std::array<std::pair<std::string_view, WeightMethod>, 3> methodNames = {
    {{"slicing", WeightMethod::slicing},
     {"straight_cut", WeightMethod::straightCut},
     {"centre", WeightMethod::centre}}};

/// x − sin x cos x for x in [0, π], given p = tan(x/2): the area of the segment of a unit circle
/// that subtends the angle 2x.
double segment(double p) {
  if (p < 0.05) {
    // (y − sin y)/2 with y = 2x: the difference would cancel, its series does not.
    const double y = 4.0 * std::atan(p);
    const double y2 = y * y;
    return y * y2 / 12.0 *
           (1.0 - y2 / 20.0 * (1.0 - y2 / 42.0 * (1.0 - y2 / 72.0 * (1.0 - y2 / 110.0))));
  }
  if (std::isinf(p)) return std::numbers::pi;
  const double q = 1.0 + p * p;
  return 2.0 * std::atan(p) - 2.0 * p * (1.0 - p * p) / (q * q);
}

}  // namespace

std::string_view toString(WeightMethod method) {
  for (const auto& [name, value] : methodNames)
    if (value == method) return name;
  throw std::invalid_argument("weights: not a method");
}

WeightMethod weightMethod(std::string_view name) {
  for (const auto& [known, value] : methodNames)
    if (known == name) return value;
  throw std::invalid_argument(fmt::format(
      "weights: unknown method \"{}\"; there are slicing, straight_cut and centre", name));
}

double commonArea(double r, double a, double R) {
  const double pi = std::numbers::pi;
  // Twice s−R, s−r, s−a and s of the triangle with sides r, a, R; R − r first, it is the small one.
  const double beyondEdge = a - (R - r);
  const double beforeEdge = a + (R - r);
  const double clearOfOrigin = (r - a) + R;
  if (beyondEdge <= 0.0) return pi * a * a;
  if (beforeEdge <= 0.0) return 0.0;
  if (clearOfOrigin <= 0.0) return pi * R * R;
  const double perimeter = r + a + R;
  const double halfAtOrigin = std::sqrt(beforeEdge * beyondEdge / (perimeter * clearOfOrigin));
  const double halfAtCentre = std::sqrt(beforeEdge * clearOfOrigin / (perimeter * beyondEdge));
  return R * R * segment(halfAtOrigin) + a * a * segment(halfAtCentre);
}

double straightCutArea(double r, double a, double R) {
  const double phi = std::acos(std::clamp((r - R) / a, -1.0, 1.0));
  return a * a * (phi - std::sin(phi) * std::cos(phi));
}

void binWeights(const Rings& rings, WeightMethod method, double r, double a, BinWeights& weights) {
  weights.fraction.clear();
  if (method == WeightMethod::centre) {
    weights.first = rings.binOf(r);
    weights.fraction.push_back(1.0);
    return;
  }
  const auto areaWithin = method == WeightMethod::slicing ? commonArea : straightCutArea;
  const double area = std::numbers::pi * a * a;
  weights.first = rings.binOf(std::max(r - a, 0.0));
  double before = 0.0;
  // Differences of one rising sequence that ends at the whole area: they add up to 1.
  for (int outer = weights.first + 1; outer <= rings.count() && rings.edge(outer) < r + a;
       ++outer) {
    const double within = areaWithin(r, a, rings.edge(outer)) / area;
    weights.fraction.push_back(std::max(within - before, 0.0));
    before = std::max(within, before);
  }
  weights.fraction.push_back(std::max(1.0 - before, 0.0));
}

}  // namespace crossgrain
