// Causes of differences between engines in which one thing is planted.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "cases/materials.hpp"
#include "studies/flow/causes.hpp"
#include "studies/flow/interim_analyses.hpp"
#include "studies/lockstep/terms.hpp"
#include "tests/misbehaving/entries.hpp"
#include "tests/studies/quick_cell.hpp"
#include "tests/support/temporary_folder.hpp"

namespace crossgrain {
namespace {

constexpr double noLimit = std::numeric_limits<double>::infinity();

/// A cell that shears for 0.4 s, packings prepared in short.
Case shortCell(std::vector<std::string> changes = {}) {
  changes.insert(changes.begin(), {"preparation.packings=4", "preparation.shrink_time=0.3",
                                   "preparation.rotations=0.1", "averaging.settle_rotations=0.01",
                                   "averaging.rotations=0.05", "looks.count=1"});
  return test::quickCell(changes);
}

EngineEntry inHouseWorker() {
  EngineEntry entry = *findEngine("grain");
  entry.command = test::misbehavingEntry("none", 0).command;
  return entry;
}

/// An engine that declares these conventions, and does otherwise in what it does not declare.
EngineEntry program(std::vector<std::string> words) {
  words.insert(words.begin(), CROSSGRAIN_PLANTED);
  EngineEntry entry;
  entry.name = "program";
  entry.command = [=] { return words; };
  return entry;
}

/// Friction times that, which nobody declares.
NamedTerm friction(double times) {
  return {"mu", times - 1.0, 0.0};
}

class FlowCauses : public testing::Test {
 protected:
  static void SetUpTestSuite() { kept_.emplace(); }
  static void TearDownTestSuite() { kept_.reset(); }

  /// The in-house engine and another one.
  /// @param until  in which no runs are begun, beyond the verdicts' own [s]
  std::vector<PairCauses> causes(const Case& setup, const EngineEntry& peer, double until,
                                 const UndeclaredTerms& undeclared = {},
                                 const std::string& field = {}) {
    RunCommand command;
    command.engines = {"grain", peer.name};
    command.out = kept_->path() / testing::UnitTest::GetInstance()->current_test_info()->name();
    command.quiet = true;
    command.jobs = 2;
    RunStore store(command, "compare", soleCase(setup));
    Campaign campaign(setup, command, {inHouseWorker(), peer}, store);
    campaign.askEngines();
    campaign.preparePackings();
    campaign.timeEngines();
    findings_ = runWithInterims(setup, campaign, command, {}, 1e6);
    const auto found = causesOfPairs(campaign, setup, command, findings_, until, undeclared, field);
    mixtures_ = 0;
    for (const auto& file : std::filesystem::directory_iterator(command.out / "runs"))
      mixtures_ += file.path().string().find("mixture") != std::string::npos;
    return found;
  }

  static void expectSums(const std::vector<EndpointCauses>& all) {
    for (const EndpointCauses& own : all) {
      double sum = *own.interaction.mean + *own.remainder.mean;
      for (const CausePart& part : own.parts) sum += *part.mean;
      EXPECT_NEAR(sum, *own.whole.mean, 1e-9 * std::abs(*own.whole.mean)) << own.endpoint;
    }
  }

  EndpointFindings findings_;
  int mixtures_ = 0;  ///< runs that were kept
  static inline std::optional<TemporaryFolder> kept_;
};

TEST_F(FlowCauses, OtherFriction_IsNamed_AndPartsAddUp) {
  const auto found = causes(shortCell(), test::misbehavingEntry("slippery", 0), noLimit,
                            {{"slippery", friction(0.02)}}, "azimuthal_velocity");
  ASSERT_EQ(found.size(), 1u);
  const PairCauses& pair = found[0];
  EXPECT_EQ(pair.reason, "");
  ASSERT_EQ(pair.differences.size(), 1u);
  EXPECT_FALSE(pair.differences[0].declared);
  EXPECT_EQ(pair.remainder, "implementation");
  EXPECT_EQ(pair.runs, 4);  // the in-house engine's own stand for the reference
  EXPECT_EQ(mixtures_, 4);
  ASSERT_FALSE(pair.endpoints.empty());
  expectSums(pair.endpoints);
  EXPECT_EQ(pair.profile.size(), 6u);  // rings
  expectSums(pair.profile);
  for (std::size_t k = 0; k < pair.profile.size(); ++k) EXPECT_EQ(pair.profile[k].bin, k);
  bool named = false;
  for (const EndpointCauses& own : pair.endpoints) {
    EXPECT_EQ(own.packings, 4);
    named = named || own.parts[0].isSeen();
    if (own.whole.isSeen()) {  // the rest is chaos, as it begins anew
      EXPECT_GT(std::abs(*own.parts[0].mean), std::abs(*own.remainder.mean)) << own.endpoint;
    }
    const auto row = std::ranges::find(findings_.rows, own.endpoint, &EndpointRow::endpoint);
    EXPECT_NEAR(*own.whole.mean, *row->difference, 1e-9 * std::abs(*row->difference));
    EXPECT_NEAR(*own.whole.low, *row->low, 1e-6 * std::abs(*row->low));
  }
  EXPECT_TRUE(named);
}

/// Conventions hardly matter to so short a flow; friction does.
TEST_F(FlowCauses, OneOfFour_IsTheLargest) {
  const auto found =
      causes(shortCell(),
             program({"declares=1", "spring_before=1", "lagged=1", "cut_tension=1", "mu=0.05"}),
             noLimit, {{"program", friction(0.05)}});
  ASSERT_EQ(found.size(), 1u);
  const PairCauses& pair = found[0];
  ASSERT_EQ(pair.differences.size(), 4u) << pair.reason;
  EXPECT_EQ(pair.mixtures, Mixtures::bothEnds);
  EXPECT_EQ(pair.runs, 36);  // all, each alone and each taken back
  ASSERT_FALSE(pair.endpoints.empty());
  expectSums(pair.endpoints);
  int seen = 0;
  for (const EndpointCauses& own : pair.endpoints) {
    if (!own.whole.isSeen() || !own.parts[3].isSeen()) continue;
    ++seen;
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LT(std::abs(*own.parts[k].mean), std::abs(*own.parts[3].mean)) << own.endpoint;
  }
  EXPECT_GT(seen, 0);
}

TEST_F(FlowCauses, StifferContactsAsDeclared_AreMixedInAll) {
  const auto found =
      causes(shortCell({"engines.none.stiffness=4"}), test::misbehavingEntry("none", 0), noLimit);
  ASSERT_EQ(found.size(), 1u);
  const PairCauses& pair = found[0];
  ASSERT_EQ(pair.differences.size(), 2u) << pair.reason;
  EXPECT_EQ(pair.differences[0].name, "stiffness");
  EXPECT_EQ(pair.differences[1].name, "time step");
  EXPECT_EQ(pair.mixtures, Mixtures::all);
  expectSums(pair.endpoints);
  for (const EndpointCauses& own : pair.endpoints) {
    EXPECT_FALSE(own.remainder.isSeen()) << own.endpoint;
    EXPECT_EQ(*own.interaction.mean, 0.0);
  }
}

TEST_F(FlowCauses, SameEngine_HasNone) {
  EXPECT_TRUE(causes(shortCell(), test::misbehavingEntry("none", 0), noLimit).empty());
  EXPECT_EQ(mixtures_, 0);
}

TEST_F(FlowCauses, NoTime_RunsNothingAndSaysWhatIsMissing) {
  const auto run = [&](double until) {
    return causes(shortCell(), test::misbehavingEntry("slippery", 0), until,
                  {{"slippery", friction(0.02)}});
  };
  const auto none = run(0.0);
  ASSERT_EQ(none.size(), 1u);
  EXPECT_TRUE(none[0].endpoints.empty());
  EXPECT_GT(none[0].missing.value_or(0.0), 0.0);
  EXPECT_EQ(mixtures_, 0);
  EXPECT_EQ(run(noLimit).front().endpoints.size(), findings_.rows.size());
  EXPECT_EQ(mixtures_, 4);
  // Finished runs cost nothing.
  const auto again = run(0.0);
  EXPECT_FALSE(again[0].missing);
  EXPECT_FALSE(again[0].endpoints.empty());
}

TEST(SceneAsRun, HasWhatTheEngineHas) {
  const Case setup = shortCell({"run.may_differ=[\"conventions\", \"rotation\"]"});
  const double dt = timeStep(setup);
  const auto engine = makeGrain();
  Capabilities can = engine->capabilities();
  EffectiveParameters effective;
  effective.dt = dt;
  const auto differences = [&] {
    return differencesOf<2>(
        sceneAsRun<2>(setup, dt, *findEngine("grain"), engine->capabilities(), effective),
        sceneAsRun<2>(setup, dt, program({}), can, effective));
  };
  EXPECT_TRUE(differences().empty());
  can.lawOptions["lever_arm"] = {"contact_point"};
  can.effects[Effect::rotation] = Support::never;
  const auto found = differences();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].words.name, "lever_arm");
  EXPECT_EQ(found[1].words.name, "rotation");
}

TEST(Differences, PlatesUnderDisks_DifferInWhatIsOtherwise) {
  Scene from;
  from.bottom = BottomPlate{0.4, 100.0, 0.5, 0.0};
  Scene to = from;
  to.bottom->mu = 0.5;
  to.bottom->spin = false;
  const auto names = [&] {
    std::vector<CauseName> words;
    for (const auto& one : differencesOf<2>(from, to)) words.push_back(one.words);
    return words;
  };
  EXPECT_EQ(names(), (std::vector<CauseName>{{"bottom_spin_friction", "there", "missing"},
                                             {"plate mu", "0.4", "0.5"}}));
  Scene taken = from;
  for (const auto& one : differencesOf<2>(from, to)) one.take(taken);
  EXPECT_EQ(taken.bottom, to.bottom);
  to.bottom.reset();
  EXPECT_EQ(names(), (std::vector<CauseName>{{"bottom_friction", "there", "missing"}}));
  std::swap(from, to);
  EXPECT_EQ(names(), (std::vector<CauseName>{{"bottom_friction", "missing", "there"}}));
}

TEST(SceneAsRun, RigidContacts_HaveMeansOverPairsAndTheirStep) {
  const Case setup = shortCell({"run.may_differ=[\"normal\"]"});
  const double dt = timeStep(setup);
  const auto engine = makeGrain();
  EffectiveParameters soft, rigid;
  soft.dt = dt;
  rigid.dt = 10.0 * dt;
  rigid.pairs = {{.pair = "a with a", .mu = 0.4, .en = 0.5, .et0 = 0.1},
                 {.pair = "a with wall", .mu = 0.4, .en = 0.7, .et0 = 0.3}};
  Capabilities can = engine->capabilities();
  can.lawOptions = {{"normal", {"rigid"}}};
  const Scene own = sceneAsRun<2>(setup, dt, program({}), can, rigid);
  EXPECT_EQ(own.law.normal, NormalLaw::rigid);
  EXPECT_DOUBLE_EQ(own.law.en, 0.6);
  EXPECT_DOUBLE_EQ(own.law.et0, 0.2);
  EXPECT_DOUBLE_EQ(own.law.mu, 0.4);
  const Scene from = sceneAsRun<2>(setup, dt, *findEngine("grain"), engine->capabilities(), soft);
  const auto found = differencesOf<2>(from, own);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].words.name, "normal");
  Scene taken = from;
  found[0].take(taken);
  EXPECT_EQ(taken.dt, 10.0 * dt);
  EXPECT_EQ(std::ranges::find(found, "time step", [](const auto& one) { return one.words.name; }),
            found.end());
  rigid.pairs.clear();
  EXPECT_THROW(sceneAsRun<2>(setup, dt, program({}), can, rigid), UnsupportedScene);
}

}  // namespace
}  // namespace crossgrain
