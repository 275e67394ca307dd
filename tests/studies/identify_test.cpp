// Identification of an engine's law from its motion, without its declaration.
#include "studies/lockstep/identify.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "adapters/grain.hpp"
#include "adapters/registry.hpp"
#include "law/law_options.hpp"
#include "studies/lockstep/rules.hpp"
#include "tests/studies/planted_engine.hpp"
#include "tests/studies/quick_cell.hpp"

namespace {

using namespace crossgrain;

class Identify : public testing::Test {
 protected:
  static void SetUpTestSuite() { flow_ = new test::QuickFlow(3); }
  static void TearDownTestSuite() { delete flow_; }

  static Identification of(Engine& engine, const EngineEntry& entry) {
    return identify(engine, entry, flow_->setup, flow_->states, flow_->dt, [](double) {});
  }
  static Identification of(std::function<void(Scene&)> fault) {
    test::PlantedEngine engine(std::move(fault));
    return of(engine, test::inHouse);
  }
  static const FoundOption* optionOf(const Identification& found, const std::string& name) {
    const auto option = std::ranges::find(found.options, name, &FoundOption::name);
    return option == found.options.end() ? nullptr : &*option;
  }

  static inline test::QuickFlow* flow_ = nullptr;
};

TEST_F(Identify, CasesOwnLaw_IsFound) {
  const Identification found = of([](Scene&) {});
  EXPECT_EQ(outcomeOf(found).status, exitPassed);
  EXPECT_EQ(found.before, 0.0);
  EXPECT_EQ(found.left, 0.0);
  EXPECT_TRUE(found.constants.empty());
  for (const FoundOption& option : found.options)
    EXPECT_EQ(option.values.front(), lawOptionValue(flow_->setup.law, option.name)) << option.name;
}

/// Every other value of every option that has a bearing on the law is found, or told as one that
/// does here as the case's own does.
TEST_F(Identify, OneConvention_IsFoundOrOneAlike) {
  const Capabilities can = makeGrain()->capabilities();
  int found = 0, alike = 0;
  for (const LawOption& option : lawOptions()) {
    const std::string name(option.name);
    if (!mattersTo(flow_->setup.law, name) || name == "normal" || name == "damper" ||
        name == "tangential")
      continue;
    for (const std::string& value : can.lawOptions.at(name)) {
      if (value == lawOptionValue(flow_->setup.law, name)) continue;
      const Identification seen = of([&](Scene& scene) { setLawOption(scene.law, name, value); });
      EXPECT_LT(seen.left, lockstepRounding) << name << " = " << value;
      const FoundOption* const told = optionOf(seen, name);
      if (!told) continue;  // it has no bearing on that law
      EXPECT_TRUE(std::ranges::count(told->values, value)) << name << " = " << value;
      (told->values.size() == 1 ? found : alike) += 1;
    }
  }
  EXPECT_GE(found, 12);
  EXPECT_LE(alike, found / 2);
}

TEST_F(Identify, SeveralDifferences_AreFoundAtOnce) {
  const Identification found = of([](Scene& scene) {
    scene.law.conventions.tension = Tension::cut;
    scene.law.conventions.leverArm = LeverArm::overlapMiddle;
    scene.law.conventions.integrator = Integrator::semiImplicitEuler;
    scene.law.mu *= 1.02;
    scene.bottom.reset();
  });
  EXPECT_EQ(outcomeOf(found).status, exitFailed);
  EXPECT_LT(found.left, 1e-6);
  EXPECT_EQ(optionOf(found, "tension")->values.front(), "cut");
  EXPECT_EQ(optionOf(found, "lever_arm")->values.front(), "overlap_middle");
  EXPECT_EQ(optionOf(found, "integrator")->values.front(), "semi_implicit_euler");
  EXPECT_EQ(found.missing, (std::vector<std::string>{"bottom_friction", "bottom_spin_friction"}));
  EXPECT_EQ(found.declaredMissing, found.missing);  // as it told when it had loaded the scene
  ASSERT_EQ(found.constants.size(), 1u);
  EXPECT_EQ(found.constants.front().name, "mu");
  EXPECT_NEAR(found.constants.front().change, 0.02, 1e-4);
}

/// Half a step before, or of this instant: the velocity that dashpots see stretches springs of a
/// law that has none, too.
TEST(IdentifyUndamped, VelocityThatStretchesSprings_IsFound) {
  const test::QuickFlow flow(
      3, {"preparation.rotations=0.2", "law.gn=0", "law.gt=0", "law.tangential=spring",
          "law.rolling=spring", "law.kr=26.7", "law.mu_r=0.1"});
  test::PlantedEngine engine([](Scene& scene) {
    scene.law.conventions.dampingVelocity = DampingVelocity::lagged;
    scene.law.conventions.springUpdate = SpringUpdate::before;
  });
  const Identification found =
      identify(engine, test::inHouse, flow.setup, flow.states, flow.dt, [](double) {});
  EXPECT_LT(found.left, lockstepRounding);
  const auto seen = std::ranges::find(found.options, "damping_velocity", &FoundOption::name);
  ASSERT_NE(seen, found.options.end());
  EXPECT_EQ(seen->values.front(), "lagged");
}

/// 25 times as stiff, in steps of a fifth: that is no small change of anything.
TEST_F(Identify, LawWithoutAMirror_IsNotCloseEnough) {
  const EngineEntry* const stiff = findEngine("grain-stiff");
  ASSERT_TRUE(stiff);
  const auto engine = stiff->make();
  const Identification found = of(*engine, *stiff);
  EXPECT_FALSE(found.closeEnough());
  EXPECT_EQ(outcomeOf(found).status, exitFailed);
}

/// Every mirror of soft engines here, and the engine that can be asked in this process.
TEST_F(Identify, MirrorsAndPeers_DoAsTheyDeclare) {
  int asked = 0;
  for (const EngineEntry& entry : engineRegistry()) {
    if (!entry.make) continue;
    const auto engine = entry.make();
    const Capabilities can = engine->capabilities();
    const auto normal = can.lawOptions.find("normal");
    if (normal == can.lawOptions.end() || !std::ranges::count(normal->second, "linear")) continue;
    if (entry.name == "grain-stiff") continue;  // another stiffness is its purpose
    const Identification found = of(*engine, entry);
    for (const FoundOption& option : found.options)
      EXPECT_FALSE(option.contradicts())
          << entry.name << ": " << option.name << " is " << option.values.front() << ", declared "
          << option.declared.front();
    EXPECT_EQ(found.missing, found.declaredMissing) << entry.name;
    EXPECT_TRUE(found.constants.empty()) << entry.name;
    EXPECT_LT(found.left, lockstepRounding) << entry.name;
    ++asked;
  }
  EXPECT_GE(asked, 4);
}

}  // namespace
