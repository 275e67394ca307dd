#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "cases/loader_sections.hpp"
#include "cases/volume_fraction.hpp"

namespace crossgrain::inline cases {

double massOf(const Reader& in, double density, double radius, double height) {
  const double mass = density * std::numbers::pi * radius * radius * height;
  if (!std::isnormal(mass))
    in.fail("density", fmt::format("makes disks of radius {} m weigh {} kg", radius, mass));
  return mass;
}

namespace {

/// small_mass and large_mass, or a density of which disks of the cell's height are made.
void readMasses(Reader& in, const Cell& cell, Particles& particles) {
  double density = 0.0;
  in.read("density", density, positive("kg/m^3"));
  if (!in.has("density")) {
    in.require("small_mass", particles.smallMass, positive("kg"));
    in.require("large_mass", particles.largeMass, positive("kg"));
    return;
  }
  for (const char* const mass : {"small_mass", "large_mass"}) {
    in.take(mass);
    if (in.has(mass)) in.fail("density", fmt::format("and {}: give one of them", mass));
  }
  particles.smallMass = massOf(in, density, particles.smallRadius, cell.height);
  particles.largeMass = massOf(in, density, particles.largeRadius, cell.height);
}

/// Which part of the disks are large, by number; given by number or by mass.
double readLargeFraction(Reader& in, const Particles& particles) {
  double byNumber = 0.0, byMass = 0.0;
  in.read("large_number_share", byNumber, between(0.0, 1.0));
  in.read("large_mass_share", byMass, between(0.0, 1.0));
  if (in.has("large_number_share") && in.has("large_mass_share"))
    in.fail("large_mass_share", "and large_number_share: give one of them");
  if (!in.has("large_mass_share")) return byNumber;
  const double large = byMass / particles.largeMass;
  return large / (large + (1.0 - byMass) / particles.smallMass);
}

/// The numbers of disks, or a volume fraction and which part of the disks are large.
void readNumbers(Reader& in, const Cell& cell, Particles& particles) {
  double fraction = 0.0;
  in.read("small", particles.small, between(0, mostDisks));
  in.read("large", particles.large, between(0, mostDisks));
  in.read("volume_fraction", fraction, inside(0.0, 1.0));
  const double largeFraction = readLargeFraction(in, particles);
  const bool shares = in.has("large_number_share") || in.has("large_mass_share");
  if (!in.has("volume_fraction")) {
    if (shares)
      in.failMissing("volume_fraction", "the share of large disks is for a case that gives it");
    return;
  }
  for (const char* const number : {"small", "large"})
    if (in.has(number))
      in.fail("volume_fraction",
              fmt::format("and {}, a number of disks: give one of the two", number));
  if (!shares)
    in.failMissing("large_number_share", "or large_mass_share: 0 if there are no large disks");
  // What is missing is for finish() to say.
  for (const double given : {particles.smallRadius, particles.largeRadius, particles.smallMass,
                             particles.largeMass, cell.height})
    if (!(given > 0.0)) return;
  const double most = diskNumber(cell, particles, fraction, largeFraction);
  if (most > mostDisks)
    in.fail("volume_fraction",
            fmt::format("that would be {:.3g} disks: a case may have at most {}", most, mostDisks));
  setNumbers(cell, particles, fraction, largeFraction);
}

}  // namespace

void readParticles(Reader& in, const Cell& cell, Particles& particles) {
  in.read("inertia_factor", particles.inertiaFactor, aboveZeroTo(1.0));
  in.read("rotation", particles.rotation);
  in.read("max_overlap", particles.maxOverlap, between(0.0, 1.0));
  in.require("small_radius", particles.smallRadius, positive("m"));
  in.require("large_radius", particles.largeRadius, positive("m"));
  readMasses(in, cell, particles);
  readNumbers(in, cell, particles);
  particles.file = in.readFile("file", ".h5");
  in.finish();
  if (particles.largeRadius < particles.smallRadius)
    in.fail("large_radius", fmt::format("must be >= small_radius = {} m", particles.smallRadius));
  if (particles.file)
    particles.small = particles.large = 0;  // how many there are is for the file to say
  else if (particles.small + particles.large == 0)
    in.has("small") ? in.fail("small", "no small and no large disks: a cell without disks")
    : in.has("volume_fraction") ? in.fail("volume_fraction", "is less than one disk has")
                                : in.failMissing("small",
                                                 "or large, or volume_fraction, or file: "
                                                 "a cell without disks");
  if (particles.small > mostDisks - particles.large)
    in.fail("small",
            fmt::format("with large = {} that is more than {} disks", particles.large, mostDisks));
}

}  // namespace crossgrain::inline cases
