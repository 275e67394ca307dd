#include "averaging/weights.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gsl/gsl_integration.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace crossgrain::inline averaging {

namespace {

/// The discs that make up a kernel of width w.
std::vector<std::pair<double, double>> kernelDiscs(const Weight& weight) {
  if (weight.method == WeightMethod::lineHeaviside) return {{weight.width, 1.0}};
  constexpr std::size_t nodes = 6;
  gsl_integration_fixed_workspace* rule = gsl_integration_fixed_alloc(
      gsl_integration_fixed_laguerre, nodes, 0.0, 1.0, /*alpha=*/1.0, 0.0);
  std::vector<std::pair<double, double>> discs;
  for (std::size_t k = 0; k < nodes; ++k)
    discs.emplace_back(weight.width * std::sqrt(gsl_integration_fixed_nodes(rule)[k]),
                       gsl_integration_fixed_weights(rule)[k]);
  gsl_integration_fixed_free(rule);
  return discs;
}

/// In enum order.
constexpr auto allNames = [] {
  std::array<std::string_view, 8> names{};
  std::ranges::copy(weightNames, names.begin());
  std::ranges::copy(std::span(spaceWeightNames).last(3), names.begin() + weightNames.size());
  return names;
}();

}  // namespace

std::span<const std::string_view> weightNamesIn(int dimension) {
  if (dimension == 3) return spaceWeightNames;
  return weightNames;
}

std::string_view toString(WeightMethod method) {
  return allNames.at(static_cast<std::size_t>(method));
}

WeightMethod weightMethod(std::string_view name) {
  const auto found = std::ranges::find(allNames, name);
  if (found == allNames.end())
    throw std::invalid_argument(fmt::format("weights: unknown method \"{}\"; there are {}", name,
                                            fmt::join(allNames, ", ")));
  return static_cast<WeightMethod>(found - allNames.begin());
}

Partition::Partition(const Coordinates& coordinates, const Weight& weight)
    : coordinates_(coordinates), weight_(weight) {
  if (weight.isFunction())
    throw std::invalid_argument(
        fmt::format("weights: {} is of slabs in space", toString(weight.method)));
  if (!weight.alongBranch()) return;
  if (!std::isfinite(weight.width) || !(weight.width > 0.0))
    throw std::invalid_argument(fmt::format("weights: {} needs a kernel width above 0, got {} m",
                                            toString(weight.method), weight.width));
  discs_ = kernelDiscs(weight);
}

const BinFractions& Partition::ofDisk(const Vec2& x, double a) {
  if (weight_.method == WeightMethod::centre)
    fractions_.assign(1, {coordinates_.slotAt(x), 1.0});
  else if (!weight_.alongBranch())
    coordinates_.discFractions(
        x, a, weight_.method == WeightMethod::slicing ? Edges::exact : Edges::straight, fractions_);
  else {
    fractions_.clear();
    for (const auto& [radius, part] : discs_) {
      coordinates_.discFractions(x, radius, Edges::exact, disc_);
      for (const BinFraction& fraction : disc_)
        fractions_.push_back({fraction.slot, part * fraction.fraction});
    }
  }
  return fractions_;
}

const BinFractions& Partition::ofBody(const Vec2& x, const std::vector<Vec2>& outline) {
  if (weight_.method == WeightMethod::centre || weight_.alongBranch()) return ofDisk(x, 0.0);
  coordinates_.outlineFractions(outline, fractions_);
  return fractions_;
}

const BinFractions& Partition::ofWallDisk(const Vec2& x, double a) {
  ofDisk(x, a);
  return keepInCell(x, a);
}

const BinFractions& Partition::ofWallPoint(const Vec2& point, const Vec2& centre, double a) {
  ofDisk(point, a);
  return keepInCell(centre, a);
}

const BinFractions& Partition::keepInCell(const Vec2& x, double a) {
  const auto keep = [&](BinFractions& fractions) {
    double kept = 0.0;
    for (const BinFraction& fraction : fractions)
      if (!coordinates_.isOverflow(fraction.slot)) kept += fraction.fraction;
    if (!(kept > 0.0)) return false;
    std::erase_if(fractions, [&](const BinFraction& s) { return coordinates_.isOverflow(s.slot); });
    for (BinFraction& fraction : fractions) fraction.fraction /= kept;
    return true;
  };
  if (keep(fractions_)) return fractions_;
  // All or nothing by a point on the wall, which rounding may have put outside.
  coordinates_.discFractions(x, a, Edges::exact, disc_);
  if (keep(disc_))
    fractions_.assign(1, {std::ranges::max_element(disc_, {}, &BinFraction::fraction)->slot, 1.0});
  return fractions_;
}

std::vector<BranchPoint> branchPoints(double length, double width) {
  const double node = std::sqrt(0.6);
  const int pieces = std::max(1, static_cast<int>(std::ceil(length / width)));
  std::vector<BranchPoint> points;
  for (int k = 0; k < pieces; ++k)
    for (const auto& [x, part] :
         {std::pair{-node, 5.0 / 18.0}, {0.0, 8.0 / 18.0}, {node, 5.0 / 18.0}})
      points.push_back({(k + 0.5 * (1.0 + x)) / pieces, part / pieces});
  return points;
}

}  // namespace crossgrain::inline averaging
