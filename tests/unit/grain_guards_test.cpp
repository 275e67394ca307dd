#include <gtest/gtest.h>

#include "tests/support/refusal.hpp"
#include "tests/unit/grain_packed.hpp"

// Errors that end a run: disks that overlap too much.

namespace {

using namespace grain;
namespace test = crossgrain::test;

/// Two disks too soft for the speed they meet with, or one against a plane, that fly through.
grain::Setup tunnelling() {
  grain::Setup setup = test::collidingPair(4.0, 0.0, 0.0, 4e-5);
  setup.law.kn = 1.0;
  setup.law.gn = 0.0;
  return setup;
}

/// Error that ends the run.
/// @param time  gets when [s]
std::string endOf(const grain::Setup& setup, int steps, double* time = nullptr) {
  Simulation simulation(setup);
  return test::refusalOf<std::runtime_error>([&] {
    for (int k = 0; k < steps; ++k) {
      simulation.step();
      if (time != nullptr) *time = simulation.time();
    }
  });
}

constexpr int through = 100;  // 16 mm of approach, two diameters

TEST(OverlapGuard, NamesTheTwo_HowDeep_AndWhen) {
  const grain::Setup pair = tunnelling();
  grain::Setup plane = pair;
  test::putOnPlane(plane);
  grain::Setup wallDisk = plane;
  Wall& wall = wallDisk.walls.front();
  wall.planes.clear();
  wall.diskX = {1.0, -test::smallRadius};  // the first far away
  wall.diskY = {0.0, 0.0};
  wall.diskRadius = {test::smallRadius, test::smallRadius};
  for (auto [setup, named] : {std::pair(pair, "disk 0 and disk 1 overlap by 0.00"),
                              std::pair(plane, "disk 0 and plane 0 overlap by 0.00"),
                              std::pair(wallDisk, "disk 0 and wall disk 1 overlap by 0.00")})
    for (const Precision precision : {Precision::float64, Precision::float32}) {
      setup.precision = precision;
      double last = 0.0;
      const std::string why = endOf(setup, through, &last);
      EXPECT_EQ(why.rfind(named, 0), 0u) << why;
      for (const char* part : {"of the smaller radius", "; the limit is 1", "t = 0.00"})
        EXPECT_NE(why.find(part), std::string::npos) << why;
      // One is in the other after one radius of approach, 23 steps, 46 alone, or earlier by what
      // they brake; lists are looked at when a disk has come a quarter of the skin (0.3 radii)
      // further.
      const double alone = setup.disks.size() == 1 ? 2.0 : 1.0;
      EXPECT_GE(last, alone * 23 * setup.dt);
      EXPECT_LE(last, alone * 29 * setup.dt);
    }
}

TEST(OverlapGuard, CanBeSetAndSwitchedOff) {
  grain::Setup setup = tunnelling();
  setup.maxOverlap = 0.0;
  EXPECT_EQ(endOf(setup, through), "");
  setup.maxOverlap = 1.9;
  EXPECT_NE(endOf(setup, through).find("the limit is 1.9"), std::string::npos);
  double early = 0.0, late = 0.0;
  setup.maxOverlap = 0.5;
  endOf(setup, through, &early);
  setup.maxOverlap = 1.5;
  endOf(setup, through, &late);
  EXPECT_LT(early, late);
}

TEST(OverlapGuard, LooksAtTheStart) {
  grain::Setup setup{.law = test::thesisLaw(), .dt = 4e-5};
  test::addDisk(setup.disks, 0.0, 0.0, 0.0, 0.0, 0.0);
  test::addDisk(setup.disks, 0.9 * test::smallRadius, 0.0, 0.0, 0.0, 0.0);
  EXPECT_THROW(Simulation{setup}, std::runtime_error);
  setup.disks.x[1] = 1.1 * test::smallRadius;
  EXPECT_NO_THROW(Simulation{setup});
}

TEST(OverlapGuard, LetsADensePackingBe) {
  EXPECT_EQ(endOf(test::packed(12, 3), 2000), "");
}

TEST(CoincidentCentres, AreAnErrorAndNotARunOnWithoutANumber) {
  for (const Precision precision : {Precision::float64, Precision::float32}) {
    grain::Setup setup{.law = test::thesisLaw(), .dt = 4e-5, .precision = precision};
    for (int k = 0; k < 2; ++k) test::addDisk(setup.disks, 0.1, 0.2, 0.0, 0.0, 0.0);
    for (const double maxOverlap : {1.0, 0.0}) {
      setup.maxOverlap = maxOverlap;
      const std::string why =
          test::refusalOf<std::runtime_error>([&] { const Simulation simulation(setup); });
      EXPECT_TRUE(why.starts_with("disk 0 and disk 1 overlap by 0.0074 m")) << why;
      test::expectSays(why, {"at (0.1, 0.2) m, t = 0 s"});
    }
  }
}

}  // namespace
