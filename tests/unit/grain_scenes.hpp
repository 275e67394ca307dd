#pragma once

#include <cmath>
#include <ostream>
#include <random>

#include "engines/grain/simulation.hpp"

// What the names of parametrised tests show.
namespace grain {

inline void PrintTo(Precision precision, std::ostream* out) {
  *out << (precision == Precision::float64 ? "float64" : "float32");
}
inline void PrintTo(Integrator integrator, std::ostream* out) {
  *out << (integrator == Integrator::positionVerlet   ? "positionVerlet"
           : integrator == Integrator::velocityVerlet ? "velocityVerlet"
                                                      : "semiImplicitEuler");
}
inline void PrintTo(Tangential law, std::ostream* out) {
  constexpr const char* names[] = {"none", "coulomb", "viscous", "spring", "springDashpot"};
  *out << names[static_cast<int>(law)];
}

}  // namespace grain

/// Scenes in the numbers of Lätzel (2003), Table 4.1: two small disks are the pair of section 2.
namespace test {

inline constexpr double radius = 3.7e-3;
inline constexpr double mass = 0.275e-3;
inline constexpr double inertia = 0.5 * mass * radius * radius;

inline grain::Law thesisLaw() {
  grain::Law law;
  law.kn = 352.1;
  law.gn = 0.19;
  law.kt = 267.1;
  law.gt = 0.15;
  law.mu = 0.44;
  law.tangential = grain::Tangential::springDashpot;
  return law;
}

/// t_c = π/ω of two small disks [s].
inline double contactTime() {
  const double reduced = 0.5 * mass, eta = 0.19 / (2.0 * reduced);
  return M_PI / std::sqrt(352.1 / reduced - eta * eta);
}

inline void addDisk(grain::Disks& disks, double x, double y, double vx, double vy, double spin) {
  disks.x.push_back(x);
  disks.y.push_back(y);
  disks.vx.push_back(vx);
  disks.vy.push_back(vy);
  disks.spin.push_back(spin);
  disks.radius.push_back(radius);
  disks.mass.push_back(mass);
  disks.inertia.push_back(inertia);
}

/// Two small disks that touch half a step after t = 0 and approach with v [m/s] along x, offset
/// sideways by `impact` (sine of the impact angle), each with that spin.
inline grain::Setup collidingPair(double v, double impact, double spin, double dt) {
  grain::Setup setup;
  setup.law = thesisLaw();
  setup.dt = dt;
  const double nx = std::sqrt(1.0 - impact * impact);
  const double ahead = 0.25 * v * dt;
  addDisk(setup.disks, radius * nx + ahead, radius * impact, -0.5 * v, 0.0, spin);
  addDisk(setup.disks, -radius * nx - ahead, -radius * impact, 0.5 * v, 0.0, spin);
  return setup;
}

/// Leaves the first disk alone, to the right of a fixed plane through the origin.
inline void putOnPlane(grain::Setup& setup) {
  grain::Disks& disks = setup.disks;
  for (auto* values : {&disks.x, &disks.y, &disks.vx, &disks.vy, &disks.spin, &disks.radius,
                       &disks.mass, &disks.inertia})
    values->resize(1);
  grain::Wall wall;
  wall.planes.push_back({0.0, 0.0, 1.0, 0.0});
  wall.motion = [](double) { return grain::WallState{}; };
  wall.moves = false;
  setup.walls.push_back(wall);
}

/// A loose heap of disks with random velocities and spins, so that many collide at once.
inline grain::Setup crowd(int side, std::uint64_t seed, double dt) {
  grain::Setup setup;
  setup.law = thesisLaw();
  setup.dt = dt;
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53 - 0.5; };
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      addDisk(setup.disks, 2.02 * radius * i, 2.02 * radius * j, 0.5 * uniform(), 0.5 * uniform(),
              100.0 * uniform());
  return setup;
}

}  // namespace test
