#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <set>

#include "engines/grain/pair_lists.hpp"
#include "tests/support/refusal.hpp"
#include "tests/unit/grain_scenes.hpp"

namespace {

using namespace grain;
namespace test = crossgrain::test;

using Pair = std::pair<std::int32_t, std::int32_t>;

constexpr double fixedSkin = 0.3;

/// Disks of radius 0.5 to 1.5 at random, the first `moving` of which move.
class Neighbours : public testing::TestWithParam<std::size_t> {
 protected:
  void scatter(std::size_t count, double extent, std::size_t moving) {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> place(-extent, extent), size(0.5, 1.5);
    for (std::size_t i = 0; i < count; ++i) {
      position.push_back({place(random), place(random)});
      radius.push_back(size(random));
    }
    travel.assign(count, 1e-3);
    const double anyOverlap = std::numeric_limits<double>::infinity();
    lists.emplace(moving, GetParam(), PairSprings{true, false}, Skin(fixedSkin, 0.5), anyOverlap);
    lists->rebuild(places(), travel, team);
  }

  Places places() const { return {position, radius, {}}; }
  void update() { lists->update(places(), travel, 1, team); }
  double gap(std::size_t i, std::size_t j) const {
    return std::hypot(position[i].x - position[j].x, position[i].y - position[j].y) - radius[i] -
           radius[j];
  }

  /// Calls visit(list) for each list of each part.
  template <class Visit>
  void forLists(Visit&& visit) {
    for (std::size_t part = 0; part < lists->parts(); ++part)
      for (const Sort sort : {Sort::inside, Sort::across, Sort::walls})
        visit(lists->list(part, sort));
  }

  std::multiset<Pair> nearPairs() {
    std::multiset<Pair> found;
    forLists([&](auto& list) {
      for (std::size_t k = 0; k < list.count; ++k) found.emplace(list.i[k], list.j[k]);
    });
    return found;
  }

  std::multiset<Pair> farPairs() {
    std::multiset<Pair> found;
    forLists([&](auto& list) {
      for (std::size_t k = 0; k < list.farI.size(); ++k) found.emplace(list.farI[k], list.farJ[k]);
    });
    return found;
  }

  /// Pairs i < j, i moving, for which wanted(i, j) is true.
  template <class Wanted>
  std::multiset<Pair> searchAll(std::size_t moving, Wanted&& wanted) const {
    std::multiset<Pair> found;
    for (std::size_t i = 0; i < moving; ++i)
      for (std::size_t j = i + 1; j < position.size(); ++j)
        if (wanted(i, j)) found.emplace(i, j);
    return found;
  }

  std::vector<Vec<double>> position;
  std::vector<double> radius, travel;
  ThreadTeam team{GetParam()};
  std::optional<PairLists<double>> lists;
};

INSTANTIATE_TEST_SUITE_P(Parts, Neighbours, testing::Values(1, 3));

TEST_P(Neighbours, AreThosePairsThatASearchOverAllPairsFinds) {
  scatter(400, 20.0, 300);  // the last 100 belong to walls
  const auto allowance = lists->allowances();
  EXPECT_EQ(farPairs(), searchAll(300, [&](auto i, auto j) { return gap(i, j) < fixedSkin; }));
  EXPECT_EQ(nearPairs(), searchAll(300, [&](auto i, auto j) {
              return gap(i, j) < allowance[i] + allowance[j];
            }));
  EXPECT_EQ(lists->counts().near, nearPairs().size());
  EXPECT_EQ(lists->counts().far, farPairs().size());
  EXPECT_LT(lists->counts().near, lists->counts().far);
}

TEST_P(Neighbours, SpringsFollowTheirDisksWhenTheseAreRenumbered) {
  scatter(200, 15.0, 150);
  std::map<Pair, double> before;
  forLists([&](auto& list) {
    for (std::size_t k = 0; k < list.count; ++k)
      before[{list.i[k], list.j[k]}] = list.spring[k] = static_cast<double>(before.size()) + 0.5;
  });
  // Backwards: every pair of moving disks changes its order.
  std::vector<std::int32_t> newNumber(150);
  for (std::int32_t i = 0; i < 150; ++i) newNumber[static_cast<std::size_t>(i)] = 149 - i;
  std::reverse(position.begin(), position.begin() + 150);
  std::reverse(radius.begin(), radius.begin() + 150);
  lists->renumber(newNumber, places(), travel, team);
  std::size_t kept = 0;
  forLists([&](auto& list) {
    for (std::size_t k = 0; k < list.count; ++k) {
      Pair old(149 - list.i[k], list.j[k] < 150 ? 149 - list.j[k] : list.j[k]);
      if (old.second < old.first) std::swap(old.first, old.second);
      EXPECT_EQ(list.spring[k], before.at(old));
      ++kept;
    }
  });
  EXPECT_EQ(kept, before.size());
  EXPECT_GT(kept, 100u);
}

TEST_P(Neighbours, AreCollectedAnewOnceADiskUsedUpHalfTheSkin) {
  scatter(50, 10.0, 50);
  const std::size_t rebuilds = lists->skin().rebuilds();
  travel.assign(50, 0.0);  // leaves the least allowance, 1e-4 of the smallest radius
  position[17].y += 0.5 * fixedSkin - 2e-4;
  update();
  EXPECT_EQ(lists->skin().rebuilds(), rebuilds);
  position[17].y += 2e-4;
  update();
  EXPECT_EQ(lists->skin().rebuilds(), rebuilds + 1);
}

TEST_P(Neighbours, ADiskFarAwayDoesNotBlowUpTheGrid) {
  scatter(50, 10.0, 50);
  position[0].x = 1e9;
  update();
  EXPECT_EQ(farPairs(), searchAll(50, [&](auto i, auto j) { return gap(i, j) < fixedSkin; }));
  EXPECT_GT(farPairs().size(), 0u);
}

TEST(NeighboursOfASimulation, ADiskThatIsNotFiniteIsNamedByItsNumber) {
  grain::Setup setup = test::crowd(8, 9, 4e-5);
  setup.disks.vx[17] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(test::refusalOf<std::runtime_error>([&] { test::advanced(setup, 2); }),
            "the position of disk 17 is not finite");
}

}  // namespace
