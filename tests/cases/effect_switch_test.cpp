#include "cases/effect_switch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "cases/couette.hpp"
#include "cases/loader.hpp"
#include "tests/cases_loader/files.hpp"

namespace crossgrain {
namespace {

/// Table 4.1 of Lätzel (2003) in a small cell: every effect that a case can have.
Case thesisCase(const std::vector<std::string>& changes = {}) {
  const auto file = std::filesystem::path(testing::TempDir()) / "every_effect.toml";
  std::ofstream(file) << test::soundCase
                      << "[bottom]\nmu = 2e-5\nkb = 267.1\ngb = 0.15\ntau_m = 1e-4\n";
  return loadCase(file, changes).front();
}

std::vector<std::string> namesOf(const Case& setup) {
  std::vector<std::string> names;
  for (const EffectSwitch& one : effectSwitches(setup)) names.push_back(one.name);
  return names;
}

const Case& off(const std::vector<EffectSwitch>& switches, const std::string& name) {
  return std::ranges::find(switches, name, &EffectSwitch::name)->without;
}

/// The switch that takes an effect away; absent where the case does not have it.
std::optional<EffectSwitch> without(const Case& setup, Effect effect) {
  for (EffectSwitch& one : effectSwitches(setup))
    if (one.effect == effect) return std::move(one);
  return std::nullopt;
}

TEST(EffectSwitch, Switches_OfTheCase_NotMovingWalls) {
  EXPECT_EQ(namesOf(thesisCase()),
            (std::vector<std::string>{"normal_damping", "friction", "tangential_spring",
                                      "tangential_damping", "rotation", "bottom_friction",
                                      "bottom_spin_friction", "tension_cut", "double_precision"}));
  const Case bare = thesisCase({"law.tangential=none", "law.mu=0", "law.kt=0", "law.gt=0",
                                "law.gn=0", "bottom.mu=0", "run.precision=float"});
  EXPECT_FALSE(bare.bottom);
  EXPECT_TRUE(namesOf(bare).empty());
  EXPECT_TRUE(effectsOf(bare).contains(Effect::movingWalls));
  EXPECT_FALSE(without(bare, Effect::movingWalls));
  EXPECT_FALSE(without(bare, Effect::rotation));
}

TEST(EffectSwitch, Without_LacksTheEffectAndItsDependents) {
  const Case base = thesisCase();
  const Effects all = effectsOf(base);
  using enum Effect;
  const std::map<Effect, Effects> gone = {
      {normalDamping, {normalDamping}},
      {friction, {friction, tangentialSpring, tangentialDamping, rotation, bottomSpinFriction}},
      {tangentialSpring, {tangentialSpring}},
      {tangentialDamping, {tangentialDamping}},
      {rotation, {rotation, bottomSpinFriction}},
      {bottomFriction, {bottomFriction, bottomSpinFriction}},
      {bottomSpinFriction, {bottomSpinFriction}}};
  for (const auto& [effect, expected] : gone) {
    const auto one = without(base, effect);
    ASSERT_TRUE(one) << toString(effect);
    EXPECT_FALSE(one->what.empty());
    Effects missing;
    std::ranges::set_difference(all, effectsOf(one->without),
                                std::inserter(missing, missing.end()));
    EXPECT_EQ(missing, expected) << toString(effect);
    EXPECT_TRUE(std::ranges::includes(all, effectsOf(one->without))) << toString(effect);
  }
}

TEST(EffectSwitch, RollingCohesionAndMaterials_AreSwitchedOneByOne) {
  const auto file = std::filesystem::path(testing::TempDir()) / "more_effects.toml";
  std::ofstream(file)
      << test::withLine(test::withLine(test::soundCase, 16,
                                       "omega = 1.0\nwheel_material = \"steel\"\nring_material = "
                                       "\"steel\""),
                        9,
                        "tangential = \"spring_dashpot\"\nrolling = \"spring\"\nmu_r = 0.1\n"
                        "kr_factor = 3.0\ngr = 1e-3\ncohesion = \"area\"\nkc = 1e4")
      << "small_material = \"glass\"\nlarge_material = \"glass\"\n[[law.pairs]]\n"
         "between = [\"glass\", \"steel\"]\nkn = 500.0\ngn = 0.2\nmu = 0.1\nkt = 200.0\n"
         "gt = 0.1\nmu_r = 0.3\nkc = 2e4\n";
  const Case base = loadCase(file).front();
  const Effects all = effectsOf(base);
  using enum Effect;
  for (const Effect effect : {normalDamping, friction, tangentialSpring, tangentialDamping,
                              rotation, rollingResistance, cohesion, pairMaterials}) {
    const auto one = without(base, effect);
    ASSERT_TRUE(one) << toString(effect);
    EXPECT_TRUE(all.contains(effect));
    EXPECT_FALSE(effectsOf(one->without).contains(effect)) << toString(effect);
    EXPECT_EQ(one->without.materials.has_value(), effect != pairMaterials) << toString(effect);
    EXPECT_EQ(loadCase(file, {}, one->fragment).front().resolvedToml, one->without.resolvedToml);
  }
  EXPECT_EQ(without(base, cohesion)->without.materials->law(0, 1).muR, 0.3);
  EXPECT_EQ(without(base, pairMaterials)->without.law, base.law);
}

TEST(EffectSwitch, Without_KeepsOtherConstants) {
  const Case base = thesisCase();
  const auto switches = effectSwitches(base);
  const ContactLaw& viscous = off(switches, "tangential_spring").law;
  EXPECT_EQ(viscous.tangential, TangentialLaw::viscous);
  EXPECT_EQ(viscous.kt, 0.0);
  EXPECT_EQ(viscous.gt, base.law.gt);
  EXPECT_EQ(viscous.mu, base.law.mu);
  const ContactLaw& spring = off(switches, "tangential_damping").law;
  EXPECT_EQ(spring.tangential, TangentialLaw::spring);
  EXPECT_EQ(spring.kt, base.law.kt);
  EXPECT_EQ(spring.gn, base.law.gn);
  const ContactLaw& undamped = off(switches, "normal_damping").law;
  EXPECT_EQ(undamped.gn, 0.0);
  EXPECT_EQ(undamped.kn, base.law.kn);
  EXPECT_EQ(undamped.tangential, base.law.tangential);
  const Case& cut = off(switches, "tension_cut");
  EXPECT_EQ(cut.law.conventions.tension, Tension::cut);
  EXPECT_EQ(effectsOf(cut), effectsOf(base));
  EXPECT_EQ(off(switches, "double_precision").run.precision, Precision::float32);
  EXPECT_EQ(off(switches, "bottom_spin_friction").bottom->mu, base.bottom->mu);
  EXPECT_FALSE(couetteIn(off(switches, "rotation")).particles.rotation);
  for (const auto& [left, effect] :
       {std::pair(thesisCase({"law.tangential=spring", "law.gt=0"}), Effect::tangentialSpring),
        std::pair(thesisCase({"law.tangential=viscous", "law.kt=0"}), Effect::tangentialDamping)})
    EXPECT_EQ(without(left, effect)->without.law.tangential, TangentialLaw::coulomb);
}

TEST(EffectSwitch, Fragment_MakesTheSameCase) {
  const auto file = std::filesystem::path(testing::TempDir()) / "every_effect.toml";
  for (const EffectSwitch& one : effectSwitches(thesisCase()))
    EXPECT_EQ(loadCase(file, {}, one.fragment).front().resolvedToml, one.without.resolvedToml)
        << one.name;
}

TEST(EffectSwitch, NoRotation_DropsSpins) {
  const Case base = thesisCase();
  Packing packing;
  packing.disks.radius = packing.disks.mass = packing.disks.inertia = {1.0};
  packing.disks.position = packing.disks.velocity = {Vec2::Zero()};
  packing.disks.spin = {7.0};
  EXPECT_EQ(couetteScene(base, packing, 1e-5).disks.spin, std::vector<double>{7.0});
  const auto blocked = without(base, Effect::rotation);
  EXPECT_EQ(couetteScene(blocked->without, packing, 1e-5).disks.spin, std::vector<double>{0.0});
}

}  // namespace
}  // namespace crossgrain
