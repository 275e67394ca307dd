#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "tests/unit/grain_packed.hpp"

// Whatever the lists do, the contacts of every step are those that a search over all pairs finds.

namespace {

using namespace grain;
namespace test = crossgrain::test;

using Pairs = std::set<std::pair<std::size_t, std::size_t>>;

Pairs listed(const Simulation& simulation) {
  Pairs found;
  for (const Contact& contact : simulation.contacts()) {
    EXPECT_LT(contact.i, contact.j);
    EXPECT_GT(contact.overlap, 0.0);
    EXPECT_TRUE(found.emplace(contact.i, contact.j).second) << "listed twice";
  }
  return found;
}

/// Pairs of disks that overlap, i moving, then disks and planes.
Pairs searched(const Simulation& s, const grain::Setup& setup) {
  std::vector<double> radius = setup.disks.radius;
  for (const Wall& wall : setup.walls)
    radius.insert(radius.end(), wall.diskRadius.begin(), wall.diskRadius.end());
  Pairs found;
  for (std::size_t i = 0; i < s.movingCount(); ++i)
    for (std::size_t j = i + 1; j < s.diskCount(); ++j) {
      const double dx = s.x(i) - s.x(j), dy = s.y(i) - s.y(j);
      const double reach = radius[i] + radius[j];
      if (dx * dx + dy * dy < reach * reach) found.emplace(i, j);
    }
  std::size_t number = s.diskCount();
  for (const Wall& wall : setup.walls) {
    MovingWall moving(wall);
    moving.moveTo(s.time());
    for (std::size_t k = 0; k < wall.planes.size(); ++k, ++number) {
      const Plane plane = moving.plane(k);
      for (std::size_t i = 0; i < s.movingCount(); ++i)
        if ((s.x(i) - plane.x) * plane.nx + (s.y(i) - plane.y) * plane.ny < radius[i])
          found.emplace(i, number);
    }
  }
  return found;
}

/// @returns in how many steps contacts came or went
int expectThemAtEveryStep(grain::Setup setup, int steps) {
  setup.maxOverlap = 0.0;  // also those of disks that pass through each other
  Simulation simulation(setup);
  Pairs last = searched(simulation, setup);
  EXPECT_EQ(listed(simulation), last);
  int changes = 0;
  for (int step = 0; step < steps; ++step) {
    simulation.step();
    Pairs wanted = searched(simulation, setup);
    EXPECT_EQ(listed(simulation), wanted) << "step " << simulation.steps();
    if (testing::Test::HasFailure()) return changes;  // one step tells enough
    changes += wanted != last;
    last = std::move(wanted);
  }
  return changes;
}

/// Skins of so many radii; 0 is tuned.
class Lists : public testing::TestWithParam<double> {
 protected:
  grain::Setup withSkin(grain::Setup setup) const {
    setup.skin = GetParam() * test::smallRadius;
    return setup;
  }
};

INSTANTIATE_TEST_SUITE_P(Skins, Lists, testing::Values(0.0, 0.003, 0.1, 0.5, 3.0));

TEST_P(Lists, FindTheContactsOfAPackedScene) {
  EXPECT_GT(expectThemAtEveryStep(withSkin(test::packed(12, 17)), 400), 200);
}

TEST_P(Lists, FindTheContactsOfAFastScene) {
  grain::Setup setup = test::packed(8, 17);
  for (double& v : setup.disks.vx) v *= 200.0;  // up to 20 m/s: a quarter of the radius in a step
  for (double& v : setup.disks.vy) v *= 200.0;
  EXPECT_GT(expectThemAtEveryStep(withSkin(std::move(setup)), 300), 200);
}

TEST_P(Lists, FindTheContactsOfDisksThatLeapFartherThanAnyHorizon) {
  grain::Setup setup = test::packed(8, 17);
  setup.walls.clear();
  setup.law.kn = setup.law.kt = 1e-9;  // they pass through each other
  setup.law.gn = setup.law.gt = 0.0;
  for (std::size_t i = 0; i < setup.disks.size(); i += 5) {
    // Nearly a diameter to ten of them in a step.
    setup.disks.vx[i] = (i % 2 == 0 ? 180.0 : -180.0) * static_cast<double>(1 + i % 10);
    setup.disks.vy[i] = 37.0;
  }
  EXPECT_GT(expectThemAtEveryStep(withSkin(std::move(setup)), 60), 5);
}

TEST_P(Lists, FindADiskThatIsFastOnlyOnceItWasKicked) {
  // At rest between others until a bullet strikes: its allowance was the least there is.
  grain::Setup setup;
  setup.law = test::thesisLaw();
  setup.law.kn = 1e6;  // leaves at once
  setup.dt = 1e-6;
  for (int k = 0; k < 12; ++k)
    test::addDisk(setup.disks, 2.3 * test::smallRadius * k, 0.0, 0.0, 0.0, 0.0);
  test::addDisk(setup.disks, -2.5 * test::smallRadius, 0.1 * test::smallRadius, 300.0, 0.0, 0.0);
  EXPECT_GT(expectThemAtEveryStep(withSkin(std::move(setup)), 600), 3);
}

TEST_P(Lists, FindADiskThatComesBackFromFarAway) {
  grain::Setup setup = test::packed(8, 17);
  setup.walls.clear();
  setup.gravityX = 100.0;  // it falls back onto the others
  test::addDisk(setup.disks, -2.0, 0.01, -10.0, 0.0, 0.0);
  setup.dt = 1e-3;
  setup.law.kn = setup.law.kt = 1.0;
  setup.law.gn = setup.law.gt = 1e-3;
  for (std::size_t i = 0; i + 1 < setup.disks.size(); ++i) setup.disks.mass[i] = 1e3;
  expectThemAtEveryStep(withSkin(std::move(setup)), 400);
}

TEST_P(Lists, FindTheDisksOfAFastWheel) {
  grain::Setup setup = test::packed(8, 17);
  setup.walls.pop_back();
  const double centre = 8.5 * test::smallRadius * 1.045;
  setup.walls.push_back(test::wheel(centre, centre, 0.012, 9000.0));  // 4.3 mm a step
  setup.law.kn = setup.law.kt = 1.0;
  EXPECT_GT(expectThemAtEveryStep(withSkin(std::move(setup)), 200), 100);
}

/// Eight wall disks, before each of which a disk at rest, each a little farther away than the last;
/// and many disks at rest elsewhere, so that the mean speed is next to nothing.
grain::Setup comb(grain::Wall wall, double dt, double nearest, double pitch) {
  grain::Setup setup;
  setup.law.kn = 1e-9;
  setup.dt = dt;
  const double apart = 4.0 * test::smallRadius;
  for (int k = 0; k < 8; ++k) {
    wall.diskX.push_back(0.0);
    wall.diskY.push_back(apart * k);
    wall.diskRadius.push_back(test::wallRadius);
    test::addDisk(setup.disks, test::wallRadius + test::smallRadius + nearest + pitch * k,
                  apart * k, 0.0, 0.0, 0.0);
    for (int l = 1; l < 20; ++l) test::addDisk(setup.disks, apart * l, apart * k, 0.0, 0.0, 0.0);
  }
  setup.walls.push_back(std::move(wall));
  return setup;
}

TEST_P(Lists, FindTheDisksOfAWallThatSlowsDown) {
  // Its speed at the end of a step is less than the way that it came in that step.
  Wall wall;
  const double swing = 2e-3, w = 2.0 * M_PI / 40e-3;
  wall.motion = [=](double t) {
    return WallState{.x = swing * std::sin(w * t), .vx = swing * w * std::cos(w * t)};
  };
  for (const double dt : {0.3e-3, 0.5e-3, 1e-3, 2e-3})
    EXPECT_GT(expectThemAtEveryStep(withSkin(comb(wall, dt, 1e-6, swing / 8.0)), 120), 15);
}

TEST_P(Lists, FindTheDisksOfAWallThatBrakesToAStop) {
  // In n steps from the speed v. The last disks are within half a step's way of where it stops.
  const double dt = 1e-4, v = 0.1;
  for (int n = 4; n < 40; n += 5) {
    Wall wall;
    const double end = n * dt;
    wall.motion = [=](double t) {
      const double left = std::max(end - t, 0.0);
      return WallState{.x = 0.5 * v * (end - left * left / end), .vx = v * left / end};
    };
    const double total = 0.5 * v * end, pitch = 0.06 * v * dt;
    expectThemAtEveryStep(withSkin(comb(wall, dt, total - 7.5 * pitch, pitch)), n + 20);
  }
}

TEST_P(Lists, FindTheDisksOfAWallThatSetsOff) {
  Wall wall;
  wall.motion = [](double t) {
    const double since = std::max(t - 10e-3, 0.0);
    return WallState{.x = 5.0 * since * since, .vx = 10.0 * since};
  };
  EXPECT_GT(expectThemAtEveryStep(withSkin(comb(wall, 0.5e-3, 1e-6, 5e-4)), 80), 7);
}

TEST(EmptyLists, BelongToAnEmptyScene) {
  grain::Setup setup{.law = test::thesisLaw(), .dt = 4e-5};
  for (const bool withWheel : {false, true}) {
    if (withWheel) setup.walls = {test::wheel(0.0, 0.0, 0.05, 1.0)};
    for (const int threads : {1, 3}) {
      setup.threads = threads;
      Simulation simulation(setup);
      simulation.advance(8200);
      EXPECT_TRUE(simulation.contacts().empty());
      EXPECT_EQ(simulation.kineticEnergy(), 0.0);
    }
  }
}

TEST(EmptyLists, BelongToOneDiskThatFliesStraight) {
  for (const Precision precision : {Precision::float64, Precision::float32}) {
    grain::Setup setup{.law = test::thesisLaw(), .dt = 0x1p-14, .precision = precision};
    test::addDisk(setup.disks, 0.0, 0.0, 0.5, -0.25, 3.0);
    Simulation simulation(setup);
    simulation.advance(10000);
    EXPECT_EQ(simulation.x(0), 0.5 * 10000 * 0x1p-14);  // steps of 2^-15 m: without rounding
    EXPECT_EQ(simulation.y(0), -0.25 * 10000 * 0x1p-14);
    EXPECT_EQ(simulation.spin(0), 3.0);
    EXPECT_TRUE(simulation.contacts().empty());
  }
}

TEST(EmptyLists, AStepMustBeLongerThanNothing) {
  for (const double dt : {0.0, -1e-5, std::numeric_limits<double>::quiet_NaN()}) {
    grain::Setup setup = test::crowd(2, 1, 4e-5);
    setup.dt = dt;
    EXPECT_THROW(Simulation{std::move(setup)}, std::invalid_argument);
  }
}

}  // namespace
