// Numbers that lockstep computes from differences in motion, by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "studies/causes/closest_law.hpp"
#include "studies/lockstep/account.hpp"
#include "studies/lockstep/rules.hpp"
#include "studies/lockstep/separation.hpp"
#include "studies/lockstep/terms.hpp"
#include "studies/lockstep/window.hpp"

namespace {

using namespace crossgrain;

/// Responses of three disks to referencePerturbations, ±1e-4 and ±1e-3: a rate for each disk.
std::vector<double> inProportion(const std::vector<double>& rates = {1e-3, 1e-3, 1e-3}) {
  std::vector<double> responses;
  for (const double change : referencePerturbations)
    for (const double rate : rates) responses.push_back(std::abs(change) * rate);
  return responses;
}
std::vector<double> all(double apart) {
  return {apart, apart, apart};
}

TEST(EquivalentChange, Separation_OverTheResponseToAUnitOfChange) {
  EXPECT_NEAR(*equivalentChange(all(3e-8), inProportion()) / 3e-5, 1.0, 1e-12);
  EXPECT_NEAR(*equivalentChange(all(1e-12), inProportion()) / 1e-9, 1.0, 1e-12);
  EXPECT_NEAR(*equivalentChange(all(2e-4), inProportion()) / 0.2, 1.0, 1e-12);
  EXPECT_EQ(*equivalentChange(all(0.0), inProportion()), 0.0);
  // Root mean squares: one disk of three, 3e-6 over 1e-3·√3.
  EXPECT_NEAR(*equivalentChange({3e-6, 0.0, 0.0}, inProportion()) / 3e-3 * std::sqrt(3.0), 1.0,
              1e-12);
}

/// A contact that is made a step later parts two runs as far, whatever the change that did it.
TEST(EquivalentChange, DiskPartedByAnEvent_IsLeftOut) {
  std::vector<double> responses = inProportion();
  responses[0] = 5.83e-6;  // of +1e-4, the first disk
  EXPECT_NEAR(*equivalentChange({5.8e-6, 3e-8, 3e-8}, responses) / 3e-5, 1.0, 1e-12);
  // A difference larger than any event makes counts.
  EXPECT_GT(*equivalentChange({1e-4, 3e-8, 3e-8}, responses), 0.05);
  responses[1] = 5.83e-6;  // and the second: of three less than half is in proportion
  EXPECT_FALSE(equivalentChange(all(3e-8), responses));
}

/// Two runs that chaos has parted are a disk's size apart, however little they differed.
TEST(EquivalentChange, SaturatedResponse_IsNotRead) {
  EXPECT_FALSE(equivalentChange(all(0.5), std::vector<double>(12, 0.3)));
  EXPECT_FALSE(equivalentChange(all(0.5), inProportion(all(1e3 * largestResponse))));
  EXPECT_TRUE(equivalentChange(all(0.5), inProportion(all(0.9e3 * largestResponse))));
}

TEST(EquivalentChange, NothingMoves_IsUnknown) {
  EXPECT_FALSE(equivalentChange(all(1e-12), inProportion(all(0.0))));
  EXPECT_FALSE(equivalentChange(all(1e-12), inProportion(all(0.9e3 * lockstepRounding))));
  EXPECT_FALSE(equivalentChange({}, {}));
  // A disk that nothing moves says what it does otherwise all the same.
  EXPECT_GT(*equivalentChange({0.0, 0.0, 1e-4}, inProportion({1e-3, 1e-3, 0.0})), 0.05);
}

/// So many starts that could be read, of which so many are beyond the rule; of these `alone` at two
/// disks that touch nothing else.
LockstepRow judged(std::size_t read, std::size_t beyond, std::size_t unread = 0,
                   std::size_t alone = 0) {
  LockstepRow row{.starts = read + unread, .track = {1e-6}};
  row.kinds.sticking = 1;
  for (std::size_t k = 0; k < read; ++k)
    row.readings.push_back({k < beyond ? 0.01 : 1e-5, 0.01, k < beyond});
  row.readings.resize(row.starts);
  judge(row, true, alone);
  return row;
}

TEST(LockstepVerdict, StartsBeyondTheRule_DecideByTheirShare) {
  EXPECT_EQ(judged(4, 0).verdict, Equivalence::sameLaw);
  EXPECT_NEAR(*judged(16, 0).shareHigh, 1.0 - std::pow(0.05, 1.0 / 16.0), 1e-9);
  EXPECT_EQ(judged(16, 2).verdict, Equivalence::undecided);
  EXPECT_EQ(judged(4, 1).verdict, Equivalence::undecided);
  EXPECT_EQ(judged(1, 1).verdict, Equivalence::undecided);
  EXPECT_EQ(judged(4, 2).verdict, Equivalence::differs);
  EXPECT_EQ(judged(16, 3).verdict, Equivalence::differs);
  EXPECT_EQ(judged(64, 6).verdict, Equivalence::undecided);
  EXPECT_EQ(judged(64, 7).verdict, Equivalence::differs);
  // One start in two hundred is what chance may do, and that it is no more is shown.
  EXPECT_EQ(judged(200, 1).verdict, Equivalence::sameLaw);
}

/// A right engine's stray start never outweighs the others, however many there are.
TEST(LockstepVerdict, ShareWithinChance_IsNeverADifference) {
  for (std::size_t read = 1; read <= 1024; read *= 2)
    EXPECT_NE(
        judged(read, static_cast<std::size_t>(strayShare * static_cast<double>(read))).verdict,
        Equivalence::differs)
        << read;
}

/// Which of several impacts of one step comes first no law says: but one start does not show that a
/// difference is of that kind, and more starts do not turn it.
TEST(LockstepVerdict, SeveralAtOnce_UnlessAShareOfStartsPartsAtTwoDisksAlone) {
  EXPECT_TRUE(judged(64, 20, 0, 0).severalAtOnce);
  EXPECT_TRUE(judged(64, 20, 0, 6).severalAtOnce);
  EXPECT_FALSE(judged(64, 20, 0, 7).severalAtOnce);
  EXPECT_FALSE(judged(4, 4, 0, 4).severalAtOnce);
  EXPECT_FALSE(judged(64, 0).severalAtOnce);
  EXPECT_FALSE(judged(64, 6).severalAtOnce);  // undecided
}

TEST(LockstepVerdict, TooFewStartsRead_IsUndecided) {
  const LockstepRow row = judged(3, 0, 13);
  EXPECT_EQ(row.verdict, Equivalence::undecided);
  EXPECT_NE(row.reason.find("3 of 16"), std::string::npos) << row.reason;
  EXPECT_EQ(judged(4, 0, 12).verdict, Equivalence::sameLaw);
  EXPECT_EQ(judged(0, 0, 16).verdict, Equivalence::undecided);
  LockstepRow still;  // nothing touches
  still.starts = 4;
  still.track = {0.0};
  still.readings.resize(4);
  judge(still, false, 0);
  EXPECT_EQ(still.verdict, Equivalence::undecided);
  EXPECT_NE(still.reason.find("nothing touches"), std::string::npos) << still.reason;
}

TEST(LockstepVerdict, MedianOfStarts_HasItsInterval) {
  LockstepRow row = judged(16, 0);
  for (std::size_t k = 0; k < 16; ++k)
    row.readings[k].equivalent = 1e-6 * static_cast<double>(k + 1);
  row.read = row.beyond = 0;
  judge(row, true, 0);
  EXPECT_NEAR(*row.equivalent / 8.5e-6, 1.0, 1e-12);
  EXPECT_NEAR(*row.equivalentLow / 4e-6, 1.0, 1e-12);  // of 16 the 4th and the 13th: 97.9 %
  EXPECT_NEAR(*row.equivalentHigh / 13e-6, 1.0, 1e-12);
}

TEST(AsTerm, Response_GivesTheAmountAndWhatItLeaves) {
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
  // A convention is taken as it is.
  const MirrorChange tension{"tension = cut", false, {}};
  EXPECT_NEAR(asTerm(tension, {1.0, 2.0}, {1.0, 2.0}).unexplained, 0.0, 1e-15);
  EXPECT_NEAR(asTerm(tension, {2.0, 4.0}, {1.0, 2.0}).unexplained, 0.5, 1e-15);
  EXPECT_FALSE(asTerm(tension, {1.0, 2.0}, {1.0, 2.0}).amount);
  EXPECT_EQ(asTerm(tension, {1.0, 2.0}, {0.0, 0.0}).unexplained, 1.0);
}

TEST(BestTerm, TermThatLeavesMuch_IsNotNamed) {
  EXPECT_FALSE(bestTerm({}));
  EXPECT_FALSE(bestTerm({{"kn", 0.1, 0.7}, {"mu", 0.1, termUnexplained}}));
  EXPECT_FALSE(bestTerm({{"integrator = velocity_verlet", {}, 0.46}}));
  EXPECT_EQ(bestTerm({{"kn", 0.1, 0.15}, {"mu", 0.1, 0.01}, {"gn", 0.1, 0.1}})->name, "mu");
}

TEST(LockstepSteps, Steps_HoldTheFirstAndTheTimesReported) {
  const double dt = 4e-5;
  const auto steps = lockstepSteps(dt);
  EXPECT_EQ(steps.front(), 1u);
  EXPECT_EQ(steps.back(), 2500u);
  EXPECT_TRUE(std::ranges::is_sorted(steps));
  for (const auto& [time, step] : {std::pair{1e-3, 25u}, {10e-3, 250u}, {50e-3, 1250u}})
    EXPECT_EQ(steps[frameAt(steps, dt, time)], step);
  // A step longer than the first time reported still leaves every time a frame.
  EXPECT_EQ(lockstepSteps(0.04), (std::vector<std::uint64_t>{1, 2, 3}));
}

/// Three disks in a row and a wall disk with id 3; d = 2.
struct DiskRow {
  std::vector<Vec2> places = {{0.0, 0.0}, {2.0, 0.0}, {4.0, 0.0}};
  Contacts contacts;

  DiskRow& with(int i, int j, double normal, double tangential = 0.0, bool slides = false) {
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

TEST(Farthest, Distance_IsInDiameters) {
  DiskRow one, other;
  other.places[1].x() += 0.5;
  other.places[2].y() -= 1.0;
  const Farthest worst = farthest(one.at(0.0), other.at(0.0), 2.0);
  EXPECT_EQ(worst.disk, 2u);
  EXPECT_DOUBLE_EQ(worst.distance, 0.5);
}

TEST(KindsVisited, Contacts_CountOnceAKind) {
  const auto before = DiskRow().with(0, 1, 1.0).with(2, 3, 1.0, 0.5, true).at(0.1);
  const auto after = DiskRow().with(1, 2, 1.0).with(2, 3, 1.0, 0.5, true).at(0.2);
  const ContactKinds kinds = kindsVisited<2>({before, after, after}, 3);
  EXPECT_EQ(kinds.sticking, 2u);
  EXPECT_EQ(kinds.sliding, 1u);
  EXPECT_EQ(kinds.made, 1u);
  EXPECT_EQ(kinds.opened, 1u);
  EXPECT_EQ(kinds.wall, 1u);
}

TEST(ForcesOfFirstStep, Differences_AreInTheMirrorsLargestForce) {
  LockstepWindow window;
  window.mirror = {DiskRow().with(0, 1, 4.0, 1.0).with(1, 2, 2.0).with(0, 2, 1.0).at(0.1)};
  window.engine = {DiskRow().with(0, 1, 4.4, 0.8).with(2, 3, 1.0).with(0, 3, 1.0).at(0.1)};
  const auto forces = forcesOfFirstStep(window);
  ASSERT_TRUE(forces);
  EXPECT_EQ(forces->contacts, 3u);
  EXPECT_EQ(forces->missing, 2u);
  EXPECT_EQ(forces->extra, 2u);
  EXPECT_DOUBLE_EQ(forces->normal, 0.5);  // the one that is missing: 2 of 4
  EXPECT_NEAR(forces->tangential, 0.05, 1e-15);
  window.engine.front().contacts.reset();
  EXPECT_FALSE(forcesOfFirstStep(window));
}

TEST(FirstExceedance, ContactWithTheLargestDifference_IsNamed) {
  LockstepWindow window;
  window.mirror = {DiskRow().with(0, 1, 1.0).at(0.1),
                   DiskRow().with(0, 1, 1.0).with(1, 3, 2.0, 0.4, true).at(0.2)};
  DiskRow theirs = DiskRow().with(0, 1, 1.0).with(1, 3, 1.0, 0.4, true);
  window.engine = {DiskRow().with(0, 1, 1.0).at(0.1), theirs.at(0.2)};
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

TEST(FirstExceedance, ContactThatLasts_IsNeitherNewNorOpening) {
  LockstepWindow window;
  const auto met = DiskRow().with(0, 1, 1.0);
  window.mirror = {DiskRow(met).at(0.1), DiskRow(met).at(0.2)};
  window.engine = {DiskRow(met).at(0.1), DiskRow().with(0, 1, 2.0).at(0.2)};
  window.engine[1].position[0].x() += 1e-6;
  const auto first = firstExceedance(window, 2.0, {1e-10, 1e-10}, 3);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->contact, "sticking");
}

/// Impulses show in the positions of the next step, when the disks that met have parted.
TEST(FirstExceedance, ContactsOfTheStepBefore_Count) {
  LockstepWindow window;
  const auto met = DiskRow().with(0, 1, 1.0).with(1, 2, 1.0).at(0.1);
  window.mirror = {met, DiskRow().at(0.2)};
  window.engine = {met, DiskRow().at(0.2)};
  window.engine[1].position[0].x() += 1e-6;
  const auto first = firstExceedance(window, 2.0, {1e-10, 1e-10}, 3);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->contact, "opening");
  EXPECT_EQ(first->touching, 2u);
}

}  // namespace
