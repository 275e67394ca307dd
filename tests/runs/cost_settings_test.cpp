#include "runs/cost/settings.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "adapters/grain.hpp"
#include "adapters/law_options.hpp"
#include "cases/cost_knobs.hpp"
#include "cases/effect_switch.hpp"
#include "cases/time_step.hpp"
#include "oracle/impact.hpp"
#include "support/bad_input.hpp"
#include "tests/runs/cost_cases.hpp"

namespace {

using namespace crossgrain;

std::vector<CostSetting> settingsOf(CostKind kind, const Case& setup, const Capabilities& can,
                                    const std::string& engine = "grain") {
  return costSettings(setup, kind, engine, can);
}

const CostSetting& find(const std::vector<CostSetting>& settings, const std::string& knob,
                        const std::string& setting) {
  for (const CostSetting& one : settings)
    if (one.knob == knob && one.setting == setting) return one;
  throw std::runtime_error("no " + knob + " " + setting);
}

Capabilities grainCan() {
  return makeGrain()->capabilities();
}

TEST(CostSettings, TheFirstIsTheCaseAsItIs) {
  for (const CostKind kind : costKinds) {
    const auto settings = settingsOf(kind, test::costCase(), grainCan());
    EXPECT_EQ(settings.front().fragment, "");
    EXPECT_EQ(settings.front().setup.resolvedToml, test::costCase().resolvedToml);
  }
}

/// The table of knobs and what their settings are go together.
TEST(CostSettings, EveryKnobHasSettingsInTheKindsOfErrorItMayChange) {
  Case setup = test::costCase();
  for (const CostKnob& knob : costKnobs()) {
    setup.cost.knobs = {std::string(knob.name)};
    for (const CostKind kind : costKinds) {
      const bool may = std::ranges::find(knob.kinds, kind) != knob.kinds.end();
      EXPECT_EQ(settingsOf(kind, setup, grainCan()).size() > 1, may)
          << knob.name << ", " << toString(kind);
    }
  }
}

TEST(CostSettings, AFragmentReadByTheLoaderGivesTheSetting) {
  const Case setup = test::costCase();
  const double contact = contactTime(setup.law, lightestReducedMass(setup));
  const auto pairs = settingsOf(CostKind::collision, setup, grainCan());
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

  const auto averages = settingsOf(CostKind::averages, setup, grainCan());
  EXPECT_EQ(test::costCase(find(averages, "omega", "2 Ω").fragment).cell.omega, 2.0);
  EXPECT_EQ(test::costCase(find(averages, "snapshots", "160 per rotation").fragment)
                .averaging.snapshotsPerRotation,
            160);
  EXPECT_EQ(test::costCase(find(averages, "method", "centre").fragment).averaging.methods.front(),
            "centre");
}

TEST(CostSettings, SofterDisksKeepTheirRestitutionAndStepsPerContact) {
  const Case setup = test::costCase();
  const auto averages = settingsOf(CostKind::averages, setup, grainCan());
  const Case soft = test::costCase(find(averages, "stiffness", "0.25 k_n").fragment);
  const double mass = lightestReducedMass(setup);
  EXPECT_EQ(soft.law.kn, 0.25 * setup.law.kn);
  // η t_c decides e_n, and t_c grows by 1/√0.25.
  EXPECT_NEAR(contactTime(soft.law, mass), 2.0 * contactTime(setup.law, mass), 1e-15);
  EXPECT_NEAR(soft.law.gn * contactTime(soft.law, mass),
              setup.law.gn * contactTime(setup.law, mass), 1e-15);
  EXPECT_NEAR(timeStep(soft), 2.0 * timeStep(setup), 1e-18);
}

TEST(CostSettings, AnEffectsFragmentDoesWhatItsSwitchDoes) {
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
    EXPECT_EQ(read.particles.rotation, off.without.particles.rotation);
  }
}

TEST(CostSettings, AnEngineWithAStepOfItsOwnIsGivenItByItsSetting) {
  Capabilities can = grainCan();
  std::ranges::find(can.settings, "dt", &SettingSpec::name)->defaultValue = 5e-4;
  const Case setup = test::costCase();
  const Case read = test::costCase(stepFragment(setup, "grain", can, 10.0));
  EXPECT_EQ(timeStep(read), timeStep(setup));
  EXPECT_DOUBLE_EQ(std::get<double>(read.engines.at("grain").at("dt")),
                   costContactTime(setup) / 10.0);
}

TEST(CostSettings, WhatAnEngineLacksIsThereWithItsReason) {
  Capabilities can = grainCan();
  can.lawOptions["tension"] = {"cut"};
  can.lawOptions["integrator"] = {"position_verlet"};
  can.precisions = {Precision::float64};
  const auto pairs = settingsOf(CostKind::collision, test::costCase(), can);
  EXPECT_NE(find(pairs, "tension", "cut").refusal, "");
  EXPECT_NE(find(pairs, "integrator", "velocity_verlet").refusal, "");
  EXPECT_EQ(find(pairs, "precision", "float").refusal, "runs in double only");
}

TEST(CostSettings, AveragesUnderOtherIntegratorsAreBoundedOnly) {
  const Case setup = test::costCase();
  const auto settings = settingsOf(CostKind::averages, setup, grainCan());
  for (const double n : {setup.cost.averageSteps.front(), setup.cost.boundSteps.front()}) {
    const CostSetting& euler =
        find(settings, "integrator", fmt::format("semi_implicit_euler, t_c/{:g}", n));
    EXPECT_TRUE(euler.windowsOnly);
    EXPECT_EQ(euler.refusal, "");
    EXPECT_EQ(lawOptionValue(euler.setup.law, "integrator"), "semi_implicit_euler");
    EXPECT_DOUBLE_EQ(timeStep(euler.setup), costContactTime(setup) / n);
  }
  EXPECT_FALSE(find(settings, "time_step", fmt::format("t_c/{:g}", setup.cost.averageSteps.front()))
                   .windowsOnly);
}

/// Johnson (1985), Eq. 11.24: T = 2.9432 δ_max/v, and δ_max^(5/2) = 15 m₁₂ v²/(16 E₁₂ √R₁₂).
TEST(CostSettings, StepsOfHertzLawAreCountedInAnImpactAtTheSpeedOfTheCollisions) {
  Case setup = loadCase(CROSSGRAIN_CASES "/cost/hertz.toml").front();
  setup.cost.speed = 0.02;
  const Particles& disks = setup.particles;
  const double mass = disks.smallMass / 2.0, radius = disks.smallRadius / 2.0;
  const double modulus = 0.75 * setup.law.kn;  // k_n = 4/3 E₁₂
  const double deepest =
      std::pow(15.0 * mass * 0.02 * 0.02 / (16.0 * modulus * std::sqrt(radius)), 0.4);
  EXPECT_NEAR(costContactTime(setup), 2.9432 * deepest / 0.02, 1e-4 * costContactTime(setup));
  const Case fine = caseWith(setup, stepFragment(setup, "grain", grainCan(), 100.0));
  EXPECT_DOUBLE_EQ(timeStep(fine), costContactTime(setup) / 100.0);
}

TEST(CostSettings, ALawThatTheCaseHasNoConstantsForIsRefused) {
  const Case setup = loadCase(CROSSGRAIN_CASES "/cost/hertz.toml").front();
  const auto settings = settingsOf(CostKind::averages, setup, grainCan());
  EXPECT_NE(find(settings, "tangential", "viscous").refusal.find("law.gt is missing"),
            std::string::npos);
  EXPECT_EQ(find(settings, "tangential", "coulomb").refusal, "");
}

TEST(CostSettings, SofterBodiesHaveTheSameRestitution) {
  const Case setup = loadCase(CROSSGRAIN_CASES "/cost/hertz.toml").front();
  const auto settings = settingsOf(CostKind::averages, setup, grainCan());
  const Case& soft = find(settings, "stiffness", "0.25 k_n").setup;
  EXPECT_DOUBLE_EQ(soft.law.kn, 0.25 * setup.law.kn);
  EXPECT_DOUBLE_EQ(soft.law.kt, 0.25 * setup.law.kt);
  EXPECT_EQ(soft.law.gn, setup.law.gn);  // of critical damping
}

TEST(CostSettings, AnEnginesOwnSettingsAreThoseOfTheCase) {
  const auto settings = settingsOf(CostKind::trajectory, test::costCase(), grainCan());
  const CostSetting& skin = find(settings, "skin", "skin = 0.001");
  EXPECT_EQ(std::get<double>(test::costCase(skin.fragment).engines.at("grain").at("skin")), 1e-3);
  Case wrong = test::costCase();
  wrong.cost.settings["grain"]["skim"] = {1.0};
  EXPECT_THROW(settingsOf(CostKind::trajectory, wrong, grainCan()), BadInput);
}

TEST(CostSettings, RigidDisksHaveNoTimeToCountStepsIn) {
  Case setup = test::costCase();
  setup.law.normal = NormalLaw::rigid;
  EXPECT_THROW(costContactTime(setup), BadInput);
}

}  // namespace
