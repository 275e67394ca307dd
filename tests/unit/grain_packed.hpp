#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "tests/unit/grain_scenes.hpp"

/// A packed scene with every kind of wall, for tests that compare runs.
namespace crossgrain::test {

/// A turning wheel of wall disks [m, rad/s].
inline grain::Wall wheel(double x, double y, double rim, double omega) {
  const auto count = static_cast<int>(2.0 * M_PI * rim / (2.0 * wallRadius));
  grain::Wall wall;
  for (int k = 0; k < count; ++k) {
    wall.diskX.push_back(x + rim * std::cos(2.0 * M_PI * k / count));
    wall.diskY.push_back(y + rim * std::sin(2.0 * M_PI * k / count));
    wall.diskRadius.push_back(wallRadius);
  }
  wall.motion = [=](double t) {
    return grain::WallState{.x = x, .y = y, .angle = omega * t, .spin = omega};
  };
  return wall;
}

/// Four planes around width × height, of which the lid moves up and down by `swing` [m] in 20 ms.
inline std::vector<grain::Wall> box(double width, double height, double swing) {
  grain::Wall lid;
  lid.planes = {{0.0, height, 0.0, -1.0}};
  lid.motion = [=](double t) {
    const double w = 2.0 * M_PI / 0.02;
    return grain::WallState{.y = -swing * std::sin(w * t), .vy = -swing * w * std::cos(w * t)};
  };
  return {standing({{0.0, 0.0, 1.0, 0.0}, {width, 0.0, -1.0, 0.0}, {0.0, 0.0, 0.0, 1.0}}), lid};
}

/// About side² disks of radius 3.7 mm ± 10 % at volume fraction 0.83 in a box, off their triangular
/// lattice by a little, around a wheel that shears them. Many touch from the start.
inline grain::Setup packed(int side, std::uint64_t seed) {
  grain::Setup setup{.law = thesisLaw(), .dt = 4e-5};
  Draw draw(seed);
  const auto uniform = [&] { return draw.uniform(-1.0, 1.0); };
  const double spacing = 2.0 * smallRadius * 1.045, row = spacing * std::sqrt(0.75);
  const double width = spacing * (side + 0.5);
  const auto rows = static_cast<int>(width / row);
  const double height = row * (rows - 1) + spacing;
  const double rim = 0.15 * width, omega = 0.5 / rim;
  for (int l = 0; l < rows; ++l)
    for (int k = 0; k < side; ++k) {
      const double x = spacing * (k + (l % 2 == 0 ? 0.5 : 1.0)) + 0.02 * smallRadius * uniform();
      const double y = 0.5 * spacing + row * l + 0.02 * smallRadius * uniform();
      const double a = smallRadius * (1.0 + 0.1 * uniform());
      const double vx = 0.1 * uniform(), vy = 0.1 * uniform(), spin = 30.0 * uniform();
      if (std::hypot(x - 0.5 * width, y - 0.5 * height) < rim + a + 1e-3) continue;
      addDisk(setup.disks, x, y, vx, vy, spin);
      setup.disks.radius.back() = a;
      setup.disks.mass.back() = smallMass * a * a / (smallRadius * smallRadius);
      setup.disks.inertia.back() = 0.5 * setup.disks.mass.back() * a * a;
    }
  setup.walls = box(width, height, 0.3 * smallRadius);
  setup.walls.push_back(wheel(0.5 * width, 0.5 * height, rim, omega));
  return setup;
}

/// Everything that can be seen of the disks.
inline std::vector<double> stateOf(const grain::Simulation& s) {
  std::vector<double> state;
  for (std::size_t i = 0; i < s.movingCount(); ++i)
    state.insert(state.end(), {s.x(i), s.y(i), s.velocityX(i), s.velocityY(i), s.spin(i)});
  return state;
}

inline std::vector<double> contactsOf(const grain::Simulation& s) {
  std::vector<double> all;
  for (const grain::Contact& c : s.contacts())
    all.insert(all.end(),
               {static_cast<double>(c.i), static_cast<double>(c.j), c.nx, c.ny, c.overlap,
                c.normalForce, c.tangentialForce, c.spring, static_cast<double>(c.sliding)});
  return all;
}

/// "" where both runs are in the same state to the bit, else what differs first.
inline std::string difference(const grain::Simulation& a, const grain::Simulation& b) {
  const auto first = [](const std::vector<double>& u, const std::vector<double>& v,
                        const std::string& what, std::size_t stride) {
    if (u.size() != v.size())
      return std::to_string(u.size() / stride) + " and " + std::to_string(v.size() / stride) + " " +
             what;
    for (std::size_t k = 0; k < u.size(); ++k)
      if (u[k] != v[k])
        return what + " " + std::to_string(k / stride) + ", value " + std::to_string(k % stride) +
               ": off by " + std::to_string(u[k] - v[k]) + " of " + std::to_string(u[k]);
    return std::string();
  };
  if (a.steps() != b.steps()) return "steps";
  const std::string disks = first(stateOf(a), stateOf(b), "disks", 5);
  if (!disks.empty()) return disks;
  const std::string contacts = first(contactsOf(a), contactsOf(b), "contacts", 9);
  if (!contacts.empty()) return contacts;
  return a.contactEvaluations() == b.contactEvaluations() ? "" : "contact evaluations";
}

/// That the general kernels and two threads come to the same bits over the first steps and, as a
/// restart does, over the last 100. @returns the run after so many steps
inline grain::Simulation withSameBits(const grain::Setup& setup, std::uint64_t steps) {
  grain::Setup general = setup, threaded = setup;
  general.generalKernels = true;
  threaded.threads = 2;
  const std::uint64_t first = std::min<std::uint64_t>(steps - 100, 500);
  grain::Simulation whole = advanced(setup, first);
  for (const grain::Setup& other : {general, threaded})
    EXPECT_EQ(difference(advanced(other, first), whole), "");
  whole.advance(steps - 100 - first);
  std::stringstream kept;
  whole.save(kept);
  whole.advance(100);
  for (const grain::Setup& other : {setup, general, threaded}) {
    grain::Simulation restored(grain::Setup{other});
    kept.seekg(0);
    restored.restore(kept);
    restored.advance(100);
    EXPECT_EQ(difference(restored, whole), "");
  }
  return whole;
}

/// > 0: energy from nowhere [J].
inline double residual(const grain::EnergyLedger& l) {
  return l.states() - l.initial - l.workOfWalls - l.gainedByConvention + l.lostNormalDamping +
         l.lostTangentialDamping + l.lostSliding + l.lostRollingDamping + l.lostRolling +
         l.lostBottom + l.lostRelease + l.lostPlastic + l.lostDetachment;
}

}  // namespace crossgrain::test
