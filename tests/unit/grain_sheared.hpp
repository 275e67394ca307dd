#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "engines/grain/spheres.hpp"
#include "tests/unit/grain_scenes.hpp"

/// A sheared scene in space, and all that can be seen of one, for tests that compare runs.
namespace crossgrain::test {

inline constexpr double sphereRadius = 0.005, sphereDensity = 2500.0;

inline grain::ContactLaw springLaw() {
  grain::ContactLaw law = sphereLaw();
  law.conventions.coulombBound = grain::CoulombBound::magnitude;
  return law;
}

/// A lattice of loose spheres of up to 1.05 g, and a step of which their contacts take some thirty.
inline void place(grain::SpheresSetup& setup, int along, int up, const grain::Vec3<double>& first) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int z = 0; z < up; ++z)
    for (int y = 0; y < along; ++y)
      for (int x = 0; x < along; ++x) {
        const double a = sphereRadius * (0.9 + 0.1 * uniform(random));
        const double mass = 4.0 / 3.0 * M_PI * a * a * a * sphereDensity;
        setup.position.push_back(first + 2.0 * sphereRadius *
                                             grain::Vec3<double>{1.0 * x, 1.0 * y, 1.0 * z});
        setup.velocity.push_back(
            0.8 * grain::Vec3<double>{uniform(random), uniform(random), uniform(random)});
        setup.spin.push_back(
            100.0 * grain::Vec3<double>{uniform(random), uniform(random), uniform(random)});
        setup.radius.push_back(a);
        setup.mass.push_back(mass);
        setup.inertia.push_back(0.4 * mass * a * a);
      }
  setup.dt = M_PI * std::sqrt(0.5 * 1.05e-3 / setup.law.kn) / 30.0;
}

/// 245 spheres between two walls of spheres that slide and swing, periodic along x and y.
inline grain::SpheresSetup sheared(const grain::ContactLaw& law = springLaw()) {
  constexpr int along = 7, up = 5;
  constexpr double side = 2.0 * sphereRadius * along;
  grain::SpheresSetup setup;
  setup.law = law;
  place(setup, along, up, {0.3 * sphereRadius, 0.7 * sphereRadius, 2.0 * sphereRadius});
  setup.box = grain::SpaceBox{{}, {side, side, 1.0}, {true, true, false}};
  for (const double sign : {-1.0, 1.0}) {
    grain::SpaceWall wall;
    for (int n = 0; n < along * along; ++n) {
      wall.position.push_back({2.0 * sphereRadius * (n % along), 2.0 * sphereRadius * (n / along),
                               sign > 0.0 ? 2.0 * sphereRadius * (up + 0.9) : 0.1 * sphereRadius});
      wall.radius.push_back(sphereRadius);
    }
    wall.motion = [sign](double t) {
      return grain::SpaceWall::State{{0.5 * sign * t, 0.0, 1e-4 * std::sin(500.0 * t)},
                                     {0.5 * sign, 0.0, 0.05 * std::cos(500.0 * t)}};
    };
    setup.walls.push_back(wall);
  }
  return setup;
}

/// The same of larger spheres, a hundred of which touch from the start.
inline grain::SpheresSetup pressed(const grain::ContactLaw& law = springLaw()) {
  grain::SpheresSetup setup = sheared(law);
  for (double& radius : setup.radius) radius *= 1.05;
  setup.skin = 1e-4;
  return setup;
}

/// All that can be seen of it.
inline std::vector<double> bitsOf(grain::Spheres& spheres, std::size_t walls) {
  std::vector<double> bits{static_cast<double>(spheres.contactEvaluations())};
  const auto put = [&](const grain::Vec3<double>& v) { bits.insert(bits.end(), {v.x, v.y, v.z}); };
  for (std::size_t i = 0; i < spheres.size(); ++i)
    for (const grain::Vec3<double>& v : {spheres.position(i), spheres.velocity(i), spheres.spin(i)})
      put(v);
  for (const grain::SpaceContact& c : spheres.contacts()) {
    bits.insert(bits.end(), {1.0 * c.i, 1.0 * c.j, c.overlap, c.normalForce, 1.0 * c.sliding});
    for (const grain::Vec3<double>& v : {c.normal, c.tangentialForce, c.rollingTorque}) put(v);
  }
  for (std::size_t w = 0; w < walls; ++w) {
    put(spheres.wallLoad(w).first);
    put(spheres.wallLoad(w).second);
  }
  return bits;
}

}  // namespace crossgrain::test
