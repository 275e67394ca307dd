#pragma once

#include <cmath>
#include <ostream>
#include <utility>
#include <vector>

#include "engines/grain/simulation.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/thesis.hpp"

// Texts in the names of parametrised tests.
namespace grain {

inline void PrintTo(Precision precision, std::ostream* out) {
  *out << (precision == Precision::float64 ? "float64" : "float32");
}

}  // namespace grain

namespace crossgrain::inline contact_law {

inline void PrintTo(Integrator integrator, std::ostream* out) {
  *out << (integrator == Integrator::positionVerlet   ? "positionVerlet"
           : integrator == Integrator::velocityVerlet ? "velocityVerlet"
                                                      : "semiImplicitEuler");
}
inline void PrintTo(TangentialLaw law, std::ostream* out) {
  constexpr const char* names[] = {"none", "coulomb", "viscous", "spring", "springDashpot"};
  *out << names[static_cast<int>(law)];
}

}  // namespace crossgrain::inline contact_law

/// Scenes of the thesis' small disks.
namespace crossgrain::test {

inline grain::ContactLaw thesisLaw() {
  grain::ContactLaw law = withThesisConstants(grain::ContactLaw{});
  law.tangential = grain::TangentialLaw::springDashpot;
  return law;
}

/// Of spheres of some grams.
inline grain::ContactLaw sphereLaw() {
  grain::ContactLaw law;
  law.kn = 1e5;
  law.gn = 1.5;
  law.kt = 2.857e4;
  law.gt = 0.4;
  law.mu = 0.3;
  law.tangential = grain::TangentialLaw::springDashpot;
  return law;
}

/// t_c = π/ω of two small disks [s].
inline double contactTime() {
  const double reduced = 0.5 * smallMass, eta = thesis.gn / (2.0 * reduced);
  return M_PI / std::sqrt(thesis.kn / reduced - eta * eta);
}

/// A small disk.
inline void addDisk(grain::Disks& disks, double x, double y, double vx, double vy, double spin) {
  disks.x.push_back(x);
  disks.y.push_back(y);
  disks.vx.push_back(vx);
  disks.vy.push_back(vy);
  disks.spin.push_back(spin);
  disks.radius.push_back(smallRadius);
  disks.mass.push_back(smallMass);
  disks.inertia.push_back(smallInertia);
}

/// Two small disks that touch half a step after t = 0 and approach with v [m/s] along x, offset
/// sideways by `impact` (sine of the impact angle), each with that spin.
inline grain::Setup collidingPair(double v, double impact, double spin, double dt) {
  grain::Setup setup{.law = thesisLaw(), .dt = dt};
  const double nx = std::sqrt(1.0 - impact * impact);
  const double ahead = 0.25 * v * dt;
  addDisk(setup.disks, smallRadius * nx + ahead, smallRadius * impact, -0.5 * v, 0.0, spin);
  addDisk(setup.disks, -smallRadius * nx - ahead, -smallRadius * impact, 0.5 * v, 0.0, spin);
  return setup;
}

/// A body of planes that stands still.
inline grain::Wall standing(std::vector<grain::Plane> planes) {
  grain::Wall wall;
  wall.planes = std::move(planes);
  wall.motion = [](double) { return grain::WallState{}; };
  wall.moves = false;
  return wall;
}

/// Leaves the first disk alone, to the right of a fixed plane through the origin.
inline void putOnPlane(grain::Setup& setup) {
  grain::Disks& disks = setup.disks;
  for (auto* values : {&disks.x, &disks.y, &disks.vx, &disks.vy, &disks.spin, &disks.radius,
                       &disks.mass, &disks.inertia})
    values->resize(1);
  setup.walls.push_back(standing({{0.0, 0.0, 1.0, 0.0}}));
}

/// A loose heap of disks with random velocities and spins, so that many collide at once.
inline grain::Setup crowd(int side, std::uint64_t seed, double dt) {
  grain::Setup setup{.law = thesisLaw(), .dt = dt};
  Draw draw(seed);
  const auto uniform = [&] { return draw.uniform(-0.5, 0.5); };
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      addDisk(setup.disks, 2.02 * smallRadius * i, 2.02 * smallRadius * j, 0.5 * uniform(),
              0.5 * uniform(), 100.0 * uniform());
  return setup;
}

/// The setup after so many steps.
inline grain::Simulation advanced(grain::Setup setup, std::uint64_t steps) {
  grain::Simulation simulation(std::move(setup));
  simulation.advance(steps);
  return simulation;
}

}  // namespace crossgrain::test
