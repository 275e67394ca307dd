#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>

#include "tests/unit/grain_scenes.hpp"

namespace {

using grain::Neighbours;

struct Points {
  std::vector<double> x, y, radius;
};

Points randomPoints(std::size_t count, double extent) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> place(-extent, extent), size(0.5, 1.5);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    points.x.push_back(place(random));
    points.y.push_back(place(random));
    points.radius.push_back(size(random));
  }
  return points;
}

TEST(Neighbours, AreThosePairsThatASearchOverAllPairsFinds) {
  const Points p = randomPoints(400, 20.0);
  const std::size_t moving = 300;  // the rest belong to walls
  const double skin = 0.3;
  Neighbours neighbours(moving, skin);
  neighbours.rebuild(p.x, p.y, p.radius);

  std::set<std::pair<std::size_t, std::size_t>> listed, wanted;
  for (std::size_t i = 0; i < moving; ++i)
    for (std::size_t k = neighbours.rowBegin(i); k < neighbours.rowEnd(i); ++k)
      listed.emplace(i, neighbours.partner(k));
  for (std::size_t i = 0; i < moving; ++i)
    for (std::size_t j = i + 1; j < p.x.size(); ++j)
      if (std::hypot(p.x[i] - p.x[j], p.y[i] - p.y[j]) < p.radius[i] + p.radius[j] + skin)
        wanted.emplace(i, j);
  EXPECT_EQ(listed, wanted);
  EXPECT_EQ(neighbours.pairCount(), wanted.size());
}

TEST(Neighbours, SpringsOfListedPairsSurviveARebuild) {
  Points p = randomPoints(200, 15.0);
  Neighbours neighbours(200, 0.3);
  neighbours.rebuild(p.x, p.y, p.radius);
  const auto mark = [](std::size_t i, std::int32_t j) { return static_cast<double>(1000 * i) + j; };
  for (std::size_t i = 0; i < 200; ++i)
    for (std::size_t k = neighbours.rowBegin(i); k < neighbours.rowEnd(i); ++k)
      neighbours.spring(k) = mark(i, neighbours.partner(k));

  std::set<double> before;
  for (std::size_t k = 0; k < neighbours.pairCount(); ++k) before.insert(neighbours.spring(k));
  for (std::size_t i = 0; i < 200; i += 3) p.x[i] += 0.4;  // some pairs part, some meet
  neighbours.rebuild(p.x, p.y, p.radius);
  std::size_t kept = 0, fresh = 0;
  for (std::size_t i = 0; i < 200; ++i)
    for (std::size_t k = neighbours.rowBegin(i); k < neighbours.rowEnd(i); ++k) {
      const double wanted = mark(i, neighbours.partner(k));
      if (before.contains(wanted)) {
        EXPECT_EQ(neighbours.spring(k), wanted);
        ++kept;
      } else {
        EXPECT_EQ(neighbours.spring(k), 0.0);
        ++fresh;
      }
    }
  EXPECT_GT(kept, 100u);
  EXPECT_GT(fresh, 10u);
}

TEST(Neighbours, AreOutdatedOnceADiskUsedUpHalfTheSkin) {
  Points p = randomPoints(50, 10.0);
  Neighbours neighbours(50, 0.3);
  EXPECT_TRUE(neighbours.outdated(p.x, p.y));
  neighbours.rebuild(p.x, p.y, p.radius);
  EXPECT_FALSE(neighbours.outdated(p.x, p.y));
  p.y[17] += 0.149;
  EXPECT_FALSE(neighbours.outdated(p.x, p.y));
  p.y[17] += 0.002;
  EXPECT_TRUE(neighbours.outdated(p.x, p.y));
}

TEST(Neighbours, ADiskThatIsNotFiniteIsNamed) {
  Points p = randomPoints(50, 10.0);
  Neighbours neighbours(50, 0.3);
  neighbours.rebuild(p.x, p.y, p.radius);
  p.y[17] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(neighbours.outdated(p.x, p.y));
  try {
    neighbours.rebuild(p.x, p.y, p.radius);
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "the position of disk 17 is not finite");
  }
}

TEST(Neighbours, ADiskFarAwayDoesNotBlowUpTheGrid) {
  Points p = randomPoints(50, 10.0);
  p.x[0] = 1e9;
  Neighbours neighbours(50, 0.3);
  neighbours.rebuild(p.x, p.y, p.radius);
  EXPECT_GT(neighbours.pairCount(), 0u);
  EXPECT_EQ(neighbours.rowBegin(0), neighbours.rowEnd(0));
}

TEST(Neighbours, TheSkinChangesTimeOnly) {
  const auto run = [](double skin) {
    grain::Setup setup = test::crowd(8, 9, 4e-5);
    setup.skin = skin;
    grain::Simulation simulation(std::move(setup));
    for (int step = 0; step < 1000; ++step) simulation.step();
    return simulation;
  };
  const auto thin = run(0.02 * test::radius), thick = run(1.5 * test::radius);
  EXPECT_GT(thin.neighbourRebuilds(), 2 * thick.neighbourRebuilds());
  for (std::size_t i = 0; i < thin.movingCount(); ++i) {
    EXPECT_EQ(thin.x()[i], thick.x()[i]);
    EXPECT_EQ(thin.spin(i), thick.spin(i));
  }
}

}  // namespace
