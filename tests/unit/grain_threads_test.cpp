#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "engines/grain/thread_team.hpp"
#include "tests/unit/grain_packed.hpp"

namespace {

using namespace grain;
namespace test = crossgrain::test;

TEST(ThreadTeam, DoesEveryPartOnceInEveryRound) {
  for (const std::size_t parts : {1u, 2u, 3u, 5u}) {
    ThreadTeam team(parts);
    std::vector<int> done(parts, 0);
    for (int round = 0; round < 100; ++round) {
      team.run([&](std::size_t part) { ++done[part]; });
      ASSERT_EQ(done, std::vector<int>(parts, round + 1));  // all are done when run() returns
    }
  }
}

TEST(ThreadTeam, ThrowsWhatTheLowestPartThrewAndGoesOn) {
  ThreadTeam team(4);
  for (int round = 0; round < 20; ++round) {
    try {
      team.run([](std::size_t part) {
        if (part == 0 || part == 2) return;
        throw std::runtime_error("part " + std::to_string(part));
      });
      FAIL() << "no exception";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "part 1");
    }
    std::atomic<int> done = 0;
    team.run([&](std::size_t) { ++done; });
    EXPECT_EQ(done, 4);
  }
}

double ticks = 0.0;  ///< of a clock that goes by steps [s]

/// @return by how many threads a step is done once both ways have been tried: by two a step takes
/// `shared` on that clock, by one 2
std::size_t threadsChosen(double shared) {
  ThreadTeam team(2, [] { return ticks; });
  std::size_t chosen = 0;
  for (int step = 0; step < 130; ++step)
    team.step([&] {
      std::array<std::thread::id, 2> by;
      team.run([&](std::size_t part) { by[part] = std::this_thread::get_id(); });
      EXPECT_EQ(by[0], std::this_thread::get_id());
      chosen = by[0] == by[1] ? 1 : 2;
      ticks += chosen == 2 ? shared : 2.0;
    });
  return chosen;
}

TEST(ThreadTeam, SharesStepsOutWhereThatTakesLessTime) {
  EXPECT_EQ(threadsChosen(1.2), 2u);
  EXPECT_EQ(threadsChosen(2.5), 1u);
}

TEST(ThreadTeam, EndsATryThatHasTakenLongerThanWhatItKeepsTo) {
  for (const double shared : {2.5, 200.0}) {
    ThreadTeam team(2, [] { return ticks; });
    int together = 0;
    for (int step = 0; step < 64 * 200; ++step)
      team.step([&] {
        std::array<std::thread::id, 2> by;
        team.run([&](std::size_t part) { by[part] = std::this_thread::get_id(); });
        const bool alone = by[0] == by[1];
        if (step >= 128) together += alone ? 0 : 1;
        ticks += alone ? 2.0 : shared;
      });
    // 64 steps by one take 128 s: 52 by two are longer, or one in which the processors were taken.
    EXPECT_EQ(together, (shared < 100.0 ? 52 : 1) * 6);
  }
}

class Threads : public testing::TestWithParam<Precision> {
 protected:
  grain::Setup scene(int side, int threads) const {
    grain::Setup setup = test::packed(side, 8);
    setup.precision = GetParam();
    setup.threads = threads;
    return setup;
  }
};

INSTANTIATE_TEST_SUITE_P(Precisions, Threads,
                         testing::Values(Precision::float64, Precision::float32));

TEST_P(Threads, AnyNumber_GivesTheSameBits) {
  grain::Setup pair = test::collidingPair(0.1, 0.3, 5.0, 4e-5);  // fewer disks than threads
  pair.precision = GetParam();
  struct Run {
    grain::Setup setup;
    std::uint64_t steps;
    std::size_t contacts;
    std::vector<int> threads;
  };
  for (const Run& run : {Run{scene(20, 1), 80, 100, {2, 3, 5}}, Run{scene(75, 1), 60, 2000, {2}},
                         Run{pair, 50, 1, {4}}}) {
    const auto reference = test::advanced(run.setup, run.steps);
    EXPECT_GE(reference.contacts().size(), run.contacts);
    for (const int threads : run.threads) {
      grain::Setup setup = run.setup;
      setup.threads = threads;
      EXPECT_EQ(test::difference(test::advanced(setup, run.steps), reference), "") << threads;
    }
  }
}

TEST_P(Threads, OfAnyNumberGiveTheSameBitsAcrossARenumbering) {
  Simulation reference(scene(10, 1));
  reference.advance(8180);
  std::stringstream saved;
  reference.save(saved);
  reference.advance(40);  // disks are renumbered at step 8192
  for (const int threads : {2, 3, 5}) {
    SCOPED_TRACE(threads);
    Simulation simulation(scene(10, threads));
    saved.seekg(0);
    simulation.restore(saved);
    simulation.advance(40);
    EXPECT_EQ(test::difference(simulation, reference), "");
  }
}

TEST_P(Threads, GiveTheSameBitsForEveryLawAndIntegrator) {
  for (const TangentialLaw tangential :
       {TangentialLaw::none, TangentialLaw::viscous, TangentialLaw::spring})
    for (const Integrator integrator :
         {Integrator::positionVerlet, Integrator::velocityVerlet, Integrator::semiImplicitEuler})
      for (const bool rotation : {false, true}) {
        const auto run = [&](int threads) {
          grain::Setup setup = scene(8, threads);
          setup.law.tangential = tangential;
          setup.law.conventions.integrator = integrator;
          setup.rotation = rotation;
          return test::advanced(std::move(setup), 15);
        };
        EXPECT_EQ(test::difference(run(2), run(1)), "");
      }
}

TEST_P(Threads, KeepTheMomentumOfALargeScene) {
  grain::Setup setup = scene(75, 2);
  setup.walls.clear();
  const std::vector<double> masses = setup.disks.mass;
  Simulation simulation(std::move(setup));
  struct Sum {
    double x = 0.0, y = 0.0, magnitude = 0.0;
  };
  const auto momentum = [&] {
    Sum sum;
    for (std::size_t i = 0; i < masses.size(); ++i) {
      sum.x += masses[i] * simulation.velocityX(i);
      sum.y += masses[i] * simulation.velocityY(i);
      sum.magnitude += masses[i] * std::hypot(simulation.velocityX(i), simulation.velocityY(i));
    }
    return sum;
  };
  const Sum before = momentum();
  simulation.advance(100);
  const Sum after = momentum();
  // Each disk's velocity is rounded once a step: 100 roundings of random sign, ten times one.
  const double epsilon = GetParam() == Precision::float64 ? 0x1p-53 : 0x1p-24;
  EXPECT_NEAR(after.x, before.x, 10.0 * epsilon * after.magnitude);
  EXPECT_NEAR(after.y, before.y, 10.0 * epsilon * after.magnitude);
}

TEST_P(Threads, PassOnWhatGoesWrong) {
  grain::Setup setup = scene(10, 3);
  setup.disks.vx[40] = std::numeric_limits<double>::infinity();
  Simulation simulation(std::move(setup));
  EXPECT_THROW(simulation.step(), std::runtime_error);
}

}  // namespace
