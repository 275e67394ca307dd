#include "cases/volume_fraction.hpp"

#include <algorithm>
#include <cmath>

namespace crossgrain::inline cases {

namespace {

double square(double x) {
  return x * x;
}

/// Areas are in units of π.
double cellArea(const Cell& cell) {
  return square(cell.outerRadius) - square(cell.innerRadius);
}

}  // namespace

double volumeFraction(const Case& c) {
  const Particles& p = c.particles;
  return (p.small * square(p.smallRadius) + p.large * square(p.largeRadius)) / cellArea(c.cell);
}

double diskNumber(const Cell& cell, const Particles& particles, double fraction,
                  double largeFraction) {
  const double each = (1.0 - largeFraction) * square(particles.smallRadius) +
                      largeFraction * square(particles.largeRadius);
  return fraction * cellArea(cell) / each;
}

void setNumbers(const Cell& cell, Particles& particles, double fraction, double largeFraction) {
  const double all = diskNumber(cell, particles, fraction, largeFraction);
  particles.large = static_cast<int>(std::lround(largeFraction * all));
  const double left = fraction * cellArea(cell) - particles.large * square(particles.largeRadius);
  const double small = left / square(particles.smallRadius);
  particles.small = largeFraction == 1.0 ? 0 : static_cast<int>(std::lround(std::max(0.0, small)));
}

}  // namespace crossgrain::inline cases
