// Settings that a study of cost measures, and those that fit into a budget.
#include "studies/cost/settings.hpp"
#include "studies/cost/sizes.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "cases/effect_switch.hpp"
#include "law/law_options.hpp"
#include "oracle/impact.hpp"
#include "support/bad_input.hpp"
#include "tests/studies/quick_cell.hpp"
#include "tests/support/refusal.hpp"

namespace {

using namespace crossgrain;

Capabilities grainCan() {
  return makeGrain()->capabilities();
}

std::vector<CostSetting> settingsOf(CostKind kind, const Case& setup,
                                    const Capabilities& can = grainCan()) {
  return costSettings(setup, kind, "grain", can);
}

const CostSetting& find(const std::vector<CostSetting>& settings, const std::string& knob,
                        const std::string& setting) {
  for (const CostSetting& one : settings)
    if (one.knob == knob && one.setting == setting) return one;
  throw std::runtime_error("no " + knob + " " + setting);
}

TEST(CostSettings, First_IsTheCaseAsItIs) {
  for (const CostKind kind : costKinds) {
    const auto settings = settingsOf(kind, test::costCase());
    EXPECT_EQ(settings.front().fragment, "");
    EXPECT_EQ(settings.front().setup.resolvedToml, test::costCase().resolvedToml);
  }
}

TEST(CostSettings, EveryKnob_HasSettingsInSomeKindOfError) {
  Case setup = test::costCase();
  for (const std::string_view knob : costKnobs) {
    if (knob == "disks" || knob == "threads") continue;  // they change the scene, or who shares it
    setup.cost.knobs = {std::string(knob)};
    EXPECT_TRUE(std::ranges::any_of(costKinds, [&](CostKind kind) {
      return settingsOf(kind, setup).size() > 1;
    })) << knob;
  }
}

TEST(CostSettings, FragmentReadByTheLoader_GivesTheSetting) {
  const Case setup = test::costCase();
  const double contact = contactTime(setup.law, lightestReducedMass(setup));
  const auto pairs = settingsOf(CostKind::collision, setup);
  for (const double steps : {200.0, 100.0, 50.0, 1.2}) {
    const CostSetting& one = find(pairs, "time_step", fmt::format("t_c/{:g}", steps));
    EXPECT_DOUBLE_EQ(timeStep(test::costCase(one.fragment)), contact / steps);
    EXPECT_EQ(one.refusal, "");
  }
  const CostSetting& euler = find(pairs, "integrator", "semi_implicit_euler, t_c/50");
  const Case read = test::costCase(euler.fragment);
  EXPECT_EQ(lawOptionValue(read.law, "integrator"), "semi_implicit_euler");
  EXPECT_DOUBLE_EQ(timeStep(read), contact / 50.0);
  EXPECT_EQ(test::costCase(find(pairs, "precision", "float").fragment).run.precision,
            Precision::float32);
  EXPECT_EQ(lawOptionValue(test::costCase(find(pairs, "tangential", "viscous").fragment).law,
                           "tangential"),
            "viscous");
}

TEST(CostSettings, EffectFragment_SwitchesTheEffectOff) {
  const Case setup = test::costCase();
  const auto switches = effectSwitches(setup);
  ASSERT_GE(switches.size(), 9u);
  for (const EffectSwitch& off : switches) {
    SCOPED_TRACE(off.name);
    ASSERT_NE(off.fragment, "");
    const Case read = test::costCase(off.fragment);
    EXPECT_EQ(effectsOf(read), effectsOf(off.without));
    for (const LawOption& option : lawOptions())
      EXPECT_EQ(option.get(read.law), option.get(off.without.law)) << option.name;
    EXPECT_EQ(read.law.gn, off.without.law.gn);
    EXPECT_EQ(read.law.mu, off.without.law.mu);
    EXPECT_EQ(read.law.kt, off.without.law.kt);
    EXPECT_EQ(read.law.gt, off.without.law.gt);
    EXPECT_EQ(read.run.precision, off.without.run.precision);
    EXPECT_EQ(couetteIn(read).particles.rotation, couetteIn(off.without).particles.rotation);
  }
}

/// The rolling disk's 400 snapshots are 5e-4 s apart, half a contact time.
TEST(CostSettings, StepThatTheCaseRefuses_IsRefusedByItself) {
  Case setup = loadCase(CROSSGRAIN_CASES "/assembly/roll.toml").front();
  setup.cost.averageSteps = {20.0, 1.9};
  const auto settings = settingsOf(CostKind::averages, setup);
  EXPECT_EQ(find(settings, "time_step", "t_c/20").refusal, "");
  const std::string why = find(settings, "time_step", "t_c/1.9").refusal;
  EXPECT_NE(why.find("400 snapshots would be 0.0005 s apart"), std::string::npos) << why;
}

TEST(CostSettings, EngineWithAStepOfItsOwn_GetsItByItsSetting) {
  Capabilities can = grainCan();
  std::ranges::find(can.settings, "dt", &SettingSpec::name)->defaultValue = 5e-4;
  const Case setup = test::costCase();
  const Case read = test::costCase(stepFragment(setup, "grain", can, 10.0));
  EXPECT_EQ(timeStep(read), timeStep(setup));
  EXPECT_DOUBLE_EQ(std::get<double>(read.engines.at("grain").at("dt")),
                   costContactTime(setup) / 10.0);
}

TEST(CostSettings, WhatAnEngineLacks_IsRefusedWithItsReason) {
  Capabilities can = grainCan();
  can.lawOptions["tension"] = {"cut"};
  can.lawOptions["integrator"] = {"position_verlet"};
  can.precisions = {Precision::float64};
  const auto pairs = settingsOf(CostKind::collision, test::costCase(), can);
  EXPECT_NE(find(pairs, "tension", "cut").refusal, "");
  EXPECT_NE(find(pairs, "integrator", "velocity_verlet").refusal, "");
  EXPECT_EQ(find(pairs, "precision", "float").refusal, "runs in double only");
  const auto hertz =
      settingsOf(CostKind::averages, loadCase(CROSSGRAIN_CASES "/cost/hertz.toml").front());
  EXPECT_NE(find(hertz, "tangential", "viscous").refusal.find("law.gt is missing"),
            std::string::npos);
  EXPECT_EQ(find(hertz, "tangential", "coulomb").refusal, "");
  Case rigid = test::costCase();
  rigid.law.normal = NormalLaw::rigid;
  EXPECT_THROW(costContactTime(rigid), BadInput);
}

/// Johnson (1985), Eq. 11.24: T = 2.9432 δ_max/v, and δ_max^(5/2) = 15 m₁₂ v²/(16 E₁₂ √R₁₂).
TEST(CostSettings, HertzLaw_CountsStepsInAnImpactAtTheSpeedOfCollisions) {
  Case setup = loadCase(CROSSGRAIN_CASES "/cost/hertz.toml").front();
  setup.cost.speed = 0.02;
  const Particles& disks = couetteIn(setup).particles;
  const double mass = disks.smallMass / 2.0, radius = disks.smallRadius / 2.0;
  const double modulus = 0.75 * setup.law.kn;  // k_n = 4/3 E₁₂
  const double deepest =
      std::pow(15.0 * mass * 0.02 * 0.02 / (16.0 * modulus * std::sqrt(radius)), 0.4);
  EXPECT_NEAR(costContactTime(setup), 2.9432 * deepest / 0.02, 1e-4 * costContactTime(setup));
  EXPECT_DOUBLE_EQ(timeStep(atSteps(setup, "grain", grainCan(), 100.0)),
                   costContactTime(setup) / 100.0);
}

TEST(CostSettings, EnginesOwnSetting_IsSetAndAMisspeltOneRefused) {
  const auto settings = settingsOf(CostKind::trajectory, test::costCase());
  const CostSetting& skin = find(settings, "skin", "skin = 0.001");
  EXPECT_EQ(std::get<double>(test::costCase(skin.fragment).engines.at("grain").at("skin")), 1e-3);
  Case wrong = test::costCase();
  wrong.cost.settings["grain"]["skim"] = {1.0};
  EXPECT_THROW(settingsOf(CostKind::trajectory, wrong), BadInput);
}

/// Of a rigid engine: ten passes that it declares as iterations, and twenty of something else.
Capabilities rigidCan() {
  Capabilities can = grainCan();
  can.limits.shapes = {ShapeKind::polygon};
  can.settings = {{"passes", 10.0, "-", "", {}, 3.0, 50.0, true, SettingRole::iterations},
                  {"points", 20.0, "-", "", {}, 1.0, 50.0, true}};
  return can;
}

std::vector<std::string> namesOf(const std::vector<CostSetting>& settings) {
  std::vector<std::string> names;
  for (const CostSetting& one : settings) names.push_back(one.setting);
  return names;
}

TEST(CostSettings, RigidBodies_HavePartsOfTheCasesStepAndDeclaredIterations) {
  Case setup = loadCase(CROSSGRAIN_CASES "/convex/slide.toml").front();  // of steps of 1 ms
  setup.cost.rigidSteps = {0.5, 1, 4};
  setup.cost.iterations = {0.1, 0.25, 4, 8};  // 1 and 2.5 are 3, 80 is 50
  const auto settings = settingsOf(CostKind::averages, setup, rigidCan());
  EXPECT_EQ(namesOf(settings),
            (std::vector<std::string>{"the case's own", "2 dt", "dt/4", "float", "passes = 3",
                                      "passes = 3, 2 dt", "passes = 3, dt/4", "passes = 40",
                                      "passes = 40, 2 dt",  // 16 times as many in all at dt/4
                                      "passes = 50", "passes = 50, 2 dt"}));
  const CostSetting& both = find(settings, "passes", "passes = 3, dt/4");
  EXPECT_DOUBLE_EQ(timeStep(both.setup), 2.5e-4);
  EXPECT_EQ(std::get<double>(both.setup.engines.at("grain").at("passes")), 3.0);
  EXPECT_EQ(both.refusal, "");
  EXPECT_FALSE(pointOf("a", both, CostKind::averages, 2.5e-4).stepsPerContact);
}

TEST(CostSettings, IterationsOfTheCase_AreThoseThatItGives) {
  Case setup = loadCase(CROSSGRAIN_CASES "/convex/slide.toml").front();
  setup.cost.rigidSteps = {1, 2};
  setup.cost.knobs = {"settings"};
  setup.cost.settings["grain"] = {{"passes", {5.0}}, {"points", {7.0}}};
  EXPECT_EQ(namesOf(settingsOf(CostKind::averages, setup, rigidCan())),
            (std::vector<std::string>{"the case's own", "passes = 5", "passes = 5, dt/2",
                                      "points = 7"}));
}

/// An engine with a step of its own gets both in one table of the case file.
TEST(CostSettings, IterationsAtTheStepOfAnEngine_AreOneFragment) {
  Case setup = loadCase(CROSSGRAIN_CASES "/convex/slide.toml").front();
  Capabilities can = rigidCan();
  can.settings.push_back({"dt", 5e-4, "s", "", {}});
  const CostSetting one =
      find(settingsOf(CostKind::averages, setup, can), "passes", "passes = 20, dt/4");
  EXPECT_EQ(one.fragment, "[engines.grain]\ndt = 0.00025\npasses = 20\n");
  EXPECT_EQ(one.refusal, "");
}

TEST(CostSettings, RemovedKey_IsRefusedAsSuch) {
  for (const char* const key : {"omega", "stiffness", "methods", "bound_steps", "perturbation"}) {
    const std::string said = test::refusalOf(
        [&] { loadCase(CROSSGRAIN_CASES "/cost/quick.toml", {fmt::format("cost.{}=[1]", key)}); });
    EXPECT_NE(said.find("no more"), std::string::npos) << key << said;
  }
}

TEST(CostSizes, SizesAndWorkers_GiveStrongAndWeakPointsOnce) {
  using Timings = std::vector<PlannedTiming>;
  EXPECT_EQ(plannedTimings({1000, 3000}, {2}, {true, false}),
            (Timings{{1000, 0, 1},
                     {1000, 0, 2},
                     {1000, 1, 1},  // the second engine has no workers
                     {2000, 0, 2},  // 2 · 1000 on two: weak
                     {3000, 0, 1},
                     {3000, 0, 2},
                     {3000, 1, 1}}));  // 6000 are more than asked for
  EXPECT_EQ(plannedTimings({1000, 2000}, {1, 2}, {true}),
            (Timings{{1000, 0, 1}, {1000, 0, 2}, {2000, 0, 1}, {2000, 0, 2}}));
}

TEST(CostSizes, NumberOfCores_GivesWorkersInPowersOfTwo) {
  EXPECT_EQ(usualWorkers(0), (std::vector<int>{1}));
  EXPECT_EQ(usualWorkers(2), (std::vector<int>{1, 2}));
  EXPECT_EQ(usualWorkers(6), (std::vector<int>{1, 2, 4, 6}));
}

TEST(CostSizes, Default_IsTheSceneItselfAndFourTimesIt) {
  Case setup = test::costCase();
  EXPECT_EQ(sizesOf(setup, 246), (std::vector<std::size_t>{246, 984}));
  setup.cost.disks = {3000, 1, 100};  // fewer than its own are its own
  EXPECT_EQ(sizesOf(setup, 246), (std::vector<std::size_t>{246, 3000}));
  setup.cost.knobs = {"time_step"};
  EXPECT_EQ(sizesOf(setup, 246), (std::vector<std::size_t>{246}));
}

}  // namespace
