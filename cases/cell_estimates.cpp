#include "cases/cell_estimates.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/couette.hpp"
#include "cases/scales.hpp"

namespace crossgrain::inline cases {

namespace {

/// How far wall disks at that spacing keep a small disk's surface off the circle of their centres,
/// averaged along the wall [m].
double wallDepth(const Case& setup) {
  const double reach = setup.cell.wallRadius + setup.particles.smallRadius;
  const double half = std::min(0.5 * setup.cell.wallSpacing, reach);
  // mean of √(reach² − x²) over |x| <= half
  const double area = 0.5 * (half * std::sqrt(reach * reach - half * half) +
                             reach * reach * std::asin(half / reach));
  return area / half - setup.particles.smallRadius;
}

/// Sites of a square lattice between two circles.
std::vector<Vec2> squareSites(double constant, double inner, double outer) {
  std::vector<Vec2> sites;
  const auto half = static_cast<int>(outer / constant) + 1;
  for (int row = -half; row <= half; ++row)
    for (int column = -half; column <= half; ++column) {
      const Vec2 site(column * constant, row * constant);
      if (site.norm() >= inner && site.norm() <= outer) sites.push_back(site);
    }
  return sites;
}

}  // namespace

double bulkVolumeFraction(const Case& setup, double volumeFraction) {
  constexpr double layering = 0.17;  // of d, fitted to both cells
  const double width = setup.cell.outerRadius - setup.cell.innerRadius;
  const double lost = wallDepth(setup) + layering * 2.0 * setup.particles.smallRadius;
  return volumeFraction * width / (width - 2.0 * lost);
}

std::optional<double> expectedPressure(const Case& setup, double bulk) {
  if (setup.law.normal != NormalLaw::linear || bulk <= dilutedBelow) return std::nullopt;
  const double fabric = 4.0 * bulk;
  return setup.law.kn * fabric / (2.0 * std::numbers::pi * setup.cell.height) *
         (bulk / dilutedBelow - 1.0);
}

std::optional<double> expectedInertialNumber(const Case& setup, double bulk) {
  const auto pressure = expectedPressure(setup, bulk);
  if (!pressure) return std::nullopt;
  const double density = std::ranges::find(scales(), "disk_density", &Scale::name)->of(setup);
  const double speed = std::abs(setup.cell.omega) * setup.cell.innerRadius;
  return 0.5 * speed * std::sqrt(density / *pressure);
}

Packing madeUpPacking(const Case& setup) {
  Packing packing;
  packing.disks = diskKinds(setup.particles);
  Disks& disks = packing.disks;
  const Cell& cell = setup.cell;
  double narrow = 0.0, wide = cell.outerRadius - cell.innerRadius;
  std::vector<Vec2> sites;
  for (int halving = 0; halving < 40; ++halving) {
    const double constant = 0.5 * (narrow + wide);
    const double clearance = cell.wallRadius + 0.5 * constant;
    const double inner = cell.innerRadius + clearance, outer = cell.outerRadius - clearance;
    const bool tooMany =
        4.0 * outer * outer > 100.0 * constant * constant * static_cast<double>(disks.size() + 100);
    auto found = tooMany ? std::vector<Vec2>() : squareSites(constant, inner, outer);
    const bool enough = tooMany || found.size() >= disks.size();
    (enough ? narrow : wide) = constant;
    if (enough && !tooMany) sites = std::move(found);
  }
  const double radius = 0.5 * narrow * (1.0 + 1e-6);
  sites.resize(disks.size(), Vec2(cell.innerRadius, cell.outerRadius));
  disks.position = sites;
  for (std::size_t i = 0; i < disks.size(); ++i) {
    disks.radius[i] = radius;
    disks.inertia[i] = setup.particles.inertiaFactor * disks.mass[i] * radius * radius;
  }
  return packing;
}

}  // namespace crossgrain::inline cases
