#include <gtest/gtest.h>

#include <algorithm>

#include "adapters/grain.hpp"
#include "cases/loader.hpp"
#include "studies/effects/effects.hpp"

namespace {

using namespace crossgrain;

/// quick.toml, where engines may differ in nothing but what is listed.
Case quick(const std::string& mayDiffer) {
  return loadCase(CROSSGRAIN_CASES "/couette/quick.toml", {"run.may_differ=[" + mayDiffer + "]"})
      .front();
}

std::string refusal(const Capabilities& can, const Case& setup, const std::string& name) {
  const auto switches = effectSwitches(setup);
  return switchRefusal(can, setup, *std::ranges::find(switches, name, &EffectSwitch::name));
}

Capabilities everything() {
  return makeGrain()->capabilities();
}

TEST(SwitchRefusal, AnEngineThatCanDoAllSwitchesAll) {
  const Case setup = quick("");
  for (const EffectSwitch& off : effectSwitches(setup))
    EXPECT_EQ(switchRefusal(everything(), setup, off), "") << off.name;
}

TEST(SwitchRefusal, WhatAnEngineLacksItCannotSwitchOff) {
  Capabilities can = everything();
  can.effects[Effect::bottomFriction] = Support::never;
  EXPECT_EQ(refusal(can, quick("\"bottom_friction\""), "bottom_friction"),
            "has no bottom_friction");
  EXPECT_EQ(refusal(can, quick("\"bottom_friction\""), "friction"), "");
}

TEST(SwitchRefusal, WhatAnEngineCannotDoWithoutStays) {
  Capabilities can = everything();
  can.effects[Effect::normalDamping] = Support::always;
  EXPECT_EQ(refusal(can, quick(""), "normal_damping"), "cannot do without normal_damping");
}

TEST(SwitchRefusal, ASimplerLawThatAnEngineLacksIsNone) {
  Capabilities can = everything();
  can.lawOptions["tangential"] = {"none", "spring_dashpot"};
  EXPECT_EQ(refusal(can, quick(""), "tangential_spring"),
            "has tangential = none | spring_dashpot, not viscous");
  EXPECT_EQ(refusal(can, quick(""), "friction"), "");
}

TEST(SwitchRefusal, AnOptionThatAnEngineHasItsOwnWayIsNoSwitch) {
  Capabilities can = everything();
  can.lawOptions["tension"] = {"cut"};  // it runs the case so, as that may differ
  EXPECT_EQ(refusal(can, quick("\"tension\""), "tension_cut"), "has tension = cut, not allow");
}

TEST(SwitchRefusal, OnePrecisionCannotBeSwitched) {
  Capabilities can = everything();
  can.precisions = {Precision::float32};
  EXPECT_EQ(refusal(can, quick(""), "double_precision"), "runs in float only");
}

}  // namespace
