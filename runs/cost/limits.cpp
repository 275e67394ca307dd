#include "runs/cost/limits.hpp"

#include <fmt/format.h>

#include <cmath>

#include "cases/time_step.hpp"

namespace crossgrain::inline runs {

namespace {

/// A packing whose springs are dropped, or that loses its friction, lets go at several times ΩR_i;
/// an instability grows without bound.
constexpr double wildSpeed = 10.0;

}  // namespace

std::string blowUp(const Case& setup, const Snapshot& seen) {
  double squares = 0.0;
  for (std::size_t k = 0; k < seen.position.size(); ++k) {
    const double radius = seen.position[k].norm();
    if (!(radius < setup.cell.outerRadius) || !(radius > setup.cell.innerRadius))
      return fmt::format("{}: disk {} left the cell by t = {:.3g} s", beyondLimit, k,
                         seen.positionTime);
    squares += seen.velocity[k].squaredNorm();
  }
  const double speed = std::sqrt(squares / static_cast<double>(seen.position.size()));
  const double rim = std::abs(setup.cell.omega) * setup.cell.innerRadius;
  if (!(speed < wildSpeed * rim))
    return fmt::format("{}: at t = {:.3g} s the disks' rms speed is {:.3g} times the wheel's rim",
                       beyondLimit, seen.positionTime, speed / rim);
  return {};
}

double packingLimit(const Case& setup) {
  return 2.0 * std::sqrt(lightestReducedMass(setup) / (6.0 * setup.law.kn));
}

}  // namespace crossgrain::inline runs
