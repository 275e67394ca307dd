#include <gtest/gtest.h>

#include <algorithm>

#include "studies/effects/effects.hpp"
#include "tests/studies/quick_cell.hpp"

namespace {

using namespace crossgrain;

/// The quick cell, where engines may differ in nothing but what is listed.
Case strictCell(const std::string& mayDiffer) {
  return test::quickCell({"run.may_differ=[" + mayDiffer + "]"});
}

TEST(SwitchRefusal, EngineThatCanDoAll_SwitchesEveryEffect) {
  const Case setup = strictCell("");
  for (const EffectSwitch& off : effectSwitches(setup))
    EXPECT_EQ(switchRefusal(makeGrain()->capabilities(), setup, off), "") << off.name;
}

TEST(SwitchRefusal, EngineThatLacksOrAlwaysHasAnEffect_SaysWhy) {
  struct Row {
    void (*change)(Capabilities&);
    const char *mayDiffer, *effect, *refusal;
  };
  for (const Row& row : {
           Row{[](Capabilities& can) { can.effects[Effect::bottomFriction] = Support::never; },
               "\"bottom_friction\"", "bottom_friction", "has no bottom_friction"},
           Row{[](Capabilities& can) { can.effects[Effect::bottomFriction] = Support::never; },
               "\"bottom_friction\"", "friction", ""},
           Row{[](Capabilities& can) { can.effects[Effect::normalDamping] = Support::always; }, "",
               "normal_damping", "cannot do without normal_damping"},
           // A simpler law that it lacks.
           Row{[](Capabilities& can) {
                 can.lawOptions["tangential"] = {"none", "spring_dashpot"};
               },
               "", "tangential_spring", "has tangential = none | spring_dashpot, not viscous"},
           Row{[](Capabilities& can) {
                 can.lawOptions["tangential"] = {"none", "spring_dashpot"};
               },
               "", "friction", ""},
           // It runs the case so, as that may differ.
           Row{[](Capabilities& can) { can.lawOptions["tension"] = {"cut"}; }, "\"tension\"",
               "tension_cut", "has tension = cut, not allow"},
           Row{[](Capabilities& can) { can.precisions = {Precision::float32}; }, "",
               "double_precision", "runs in float only"},
       }) {
    const Case setup = strictCell(row.mayDiffer);
    Capabilities can = makeGrain()->capabilities();
    row.change(can);
    const auto switches = effectSwitches(setup);
    EXPECT_EQ(
        switchRefusal(can, setup, *std::ranges::find(switches, row.effect, &EffectSwitch::name)),
        row.refusal);
  }
}

}  // namespace
