// What lockstep works out of separations, by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "runs/lockstep/rules.hpp"
#include "runs/lockstep/separation.hpp"
#include "runs/lockstep/terms.hpp"
#include "runs/lockstep/window.hpp"

namespace {

using namespace crossgrain;

TEST(EquivalentChange, IsProportionalWhereResponsesAre) {
  // 1e-6, 1e-4 and 1e-2 of k_n move 1e-9, 1e-7 and 1e-5.
  const std::vector<double> responses = {1e-9, 1e-7, 1e-5};
  EXPECT_NEAR(*equivalentChange(3e-8, responses) / 3e-5, 1.0, 1e-12);
  EXPECT_NEAR(*equivalentChange(1e-9, responses) / 1e-6, 1.0, 1e-12);
  EXPECT_NEAR(*equivalentChange(1e-12, responses) / 1e-9, 1.0, 1e-12);
  EXPECT_NEAR(*equivalentChange(1e-3, responses) / 1.0, 1.0, 1e-12);
  EXPECT_EQ(*equivalentChange(0.0, responses), 0.0);
}

/// A contact that is made a step later parts two runs as far, whatever the change that did it.
TEST(EquivalentChange, AnEventThatTheSmallestChangeBringsAboutSaysNothingOfTheLaw) {
  EXPECT_LE(*equivalentChange(5.8e-6, {5.83e-6, 9.9e-6, 8e-4}), 1e-6);
  // A larger change may miss it: it counts for no less than the smaller one.
  EXPECT_LE(*equivalentChange(5e-6, {5.83e-6, 1e-7, 8e-4}), 1e-6);
}

TEST(EquivalentChange, IsUnknownWhereNothingMoves) {
  EXPECT_FALSE(equivalentChange(1e-12, {0.0, 0.0, 0.0}));
  EXPECT_FALSE(equivalentChange(1e-12, {0.0, 0.0, lockstepRounding}));
  EXPECT_FALSE(equivalentChange(1e-12, {}));
}

TEST(AsTerm, FindsTheAmountOfAConstantAndWhatItLeaves) {
  const MirrorChange kn{"kn", true, {}};
  const std::vector<double> response = {1.0, 2.0, 2.0};
  const NamedTerm exact = asTerm(kn, {-3.0, -6.0, -6.0}, response);
  EXPECT_NEAR(*exact.amount, -3.0 * termChange, 1e-15);
  EXPECT_NEAR(exact.unexplained, 0.0, 1e-12);
  // (2, 4, 4) + 6·(0, 1, −1)/√2 beside it: of √(36 + 36) what is across is 6.
  const double across = 6.0 / std::sqrt(2.0);
  const NamedTerm half = asTerm(kn, {2.0, 4.0 + across, 4.0 - across}, response);
  EXPECT_NEAR(*half.amount, 2.0 * termChange, 1e-15);
  EXPECT_NEAR(half.unexplained, 1.0 / std::sqrt(2.0), 1e-12);
}

TEST(AsTerm, TakesAConventionAsItIs) {
  const MirrorChange tension{"tension = cut", false, {}};
  EXPECT_NEAR(asTerm(tension, {1.0, 2.0}, {1.0, 2.0}).unexplained, 0.0, 1e-15);
  EXPECT_NEAR(asTerm(tension, {2.0, 4.0}, {1.0, 2.0}).unexplained, 0.5, 1e-15);
  EXPECT_FALSE(asTerm(tension, {1.0, 2.0}, {1.0, 2.0}).amount);
  EXPECT_EQ(asTerm(tension, {1.0, 2.0}, {0.0, 0.0}).unexplained, 1.0);
}

TEST(BestTerm, IsNamedOnlyWhereItLeavesLessThanHalf) {
  EXPECT_FALSE(bestTerm({}));
  EXPECT_FALSE(bestTerm({{"kn", 0.1, 0.7}, {"mu", 0.1, termUnexplained}}));
  EXPECT_EQ(bestTerm({{"kn", 0.1, 0.4}, {"mu", 0.1, 0.01}, {"gn", 0.1, 0.3}})->name, "mu");
}

TEST(LockstepSteps, HoldTheFirstStepAndTheTimesThatAreTold) {
  const double dt = 4e-5;
  const auto steps = lockstepSteps(dt);
  EXPECT_EQ(steps.front(), 1u);
  EXPECT_EQ(steps.back(), 2500u);
  EXPECT_TRUE(std::ranges::is_sorted(steps));
  for (const auto& [time, step] : {std::pair{1e-3, 25u}, {10e-3, 250u}, {50e-3, 1250u}})
    EXPECT_EQ(steps[frameAt(steps, dt, time)], step);
}

/// A step longer than the first time told still leaves every time a frame.
TEST(LockstepSteps, OfAVeryLongStepAreAtLeastOne) {
  EXPECT_EQ(lockstepSteps(0.04), (std::vector<std::uint64_t>{1, 2, 3}));
}

/// Three disks in a row and a wall disk with id 3; d = 2.
struct Row {
  std::vector<Vec2> places = {{0.0, 0.0}, {2.0, 0.0}, {4.0, 0.0}};
  Contacts contacts;

  Row& with(int i, int j, double normal, double tangential = 0.0, bool slides = false) {
    contacts.i.push_back(i);
    contacts.j.push_back(j);
    contacts.normal.emplace_back(-1.0, 0.0);
    contacts.overlap.push_back(0.01);
    contacts.normalForce.push_back(normal);
    contacts.tangentialForce.push_back(tangential);
    contacts.sliding.push_back(slides);
    return *this;
  }
  LockstepFrame at(double time) const { return {time, time, places, {}, contacts}; }
};

TEST(Farthest, IsInDiameters) {
  Row one, other;
  other.places[1].x() += 0.5;
  other.places[2].y() -= 1.0;
  const Farthest worst = farthest(one.at(0.0), other.at(0.0), 2.0);
  EXPECT_EQ(worst.disk, 2u);
  EXPECT_DOUBLE_EQ(worst.distance, 0.5);
}

TEST(KindsVisited, CountEachContactOnceAKind) {
  const auto before = Row().with(0, 1, 1.0).with(2, 3, 1.0, 0.5, true).at(0.1);
  const auto after = Row().with(1, 2, 1.0).with(2, 3, 1.0, 0.5, true).at(0.2);
  const ContactKinds kinds = kindsVisited({before, after, after}, 3);
  EXPECT_EQ(kinds.sticking, 2u);
  EXPECT_EQ(kinds.sliding, 1u);
  EXPECT_EQ(kinds.made, 1u);
  EXPECT_EQ(kinds.opened, 1u);
  EXPECT_EQ(kinds.wall, 1u);
}

TEST(ForcesOfFirstStep, AreInTheLargestNormalForceOfTheMirror) {
  LockstepWindow window;
  window.mirror = {Row().with(0, 1, 4.0, 1.0).with(1, 2, 2.0).at(0.1)};
  window.engine = {Row().with(0, 1, 4.4, 0.8).with(2, 3, 1.0).at(0.1)};
  const auto forces = forcesOfFirstStep(window);
  ASSERT_TRUE(forces);
  EXPECT_EQ(forces->contacts, 2u);
  EXPECT_EQ(forces->missing, 1u);
  EXPECT_EQ(forces->extra, 1u);
  EXPECT_DOUBLE_EQ(forces->normal, 0.5);  // the one that is missing: 2 of 4
  EXPECT_NEAR(forces->tangential, 0.05, 1e-15);
  window.engine.front().contacts.reset();
  EXPECT_FALSE(forcesOfFirstStep(window));
}

TEST(FirstExceedance, NamesTheContactWhoseForcesDifferMost) {
  LockstepWindow window;
  window.mirror = {Row().with(0, 1, 1.0).at(0.1),
                   Row().with(0, 1, 1.0).with(1, 3, 2.0, 0.4, true).at(0.2)};
  Row theirs = Row().with(0, 1, 1.0).with(1, 3, 1.0, 0.4, true);
  window.engine = {Row().with(0, 1, 1.0).at(0.1), theirs.at(0.2)};
  EXPECT_FALSE(firstExceedance(window, 2.0, {1e-10, 1e-10}, 3));
  window.engine[1].position[1].x() += 1e-6;
  const auto first = firstExceedance(window, 2.0, {1e-10, 1e-10}, 3);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->after, 0.1);
  EXPECT_EQ(first->until, 0.2);
  EXPECT_EQ(first->disk, 1u);
  EXPECT_EQ(first->partner, std::optional<std::size_t>(3));
  EXPECT_EQ(first->contact, "new, sliding, wall");
  EXPECT_EQ(first->touching, 2u);
  EXPECT_FALSE(firstExceedance(window, 2.0, {1e-10, 1e-6}, 3));
}

}  // namespace
