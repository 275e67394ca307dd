#include "cases/volume_fraction.hpp"

namespace crossgrain {

double volumeFraction(const Case& c) {
  const auto square = [](double x) { return x * x; };
  const double disks = c.particles.small * square(c.particles.smallRadius) +
                       c.particles.large * square(c.particles.largeRadius);
  return disks / (square(c.cell.outerRadius) - square(c.cell.innerRadius));
}

}  // namespace crossgrain
