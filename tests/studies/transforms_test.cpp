// A case in other units, places and numbers: how constants scale, and that the in-house engine does
// the same to the bit where nothing is rounded.
#include "studies/stability/transforms.hpp"

#include <gtest/gtest.h>

#include <limits>

#include <cmath>
#include <set>

#include "adapters/grain.hpp"
#include "stability/transform.hpp"
#include "studies/conformance/conformance_scenes.hpp"
#include "studies/lockstep/window.hpp"

namespace {

using namespace crossgrain;
using conformance::busyScene;
using conformance::fullLaw;

/// Laws with constants of every dimension.
std::vector<ContactLaw> lawsOfEveryDimension() {
  ContactLaw hertz = fullLaw();
  hertz.normal = NormalLaw::hertz;
  hertz.kn = 1.5e4;
  hertz.kt = 1.0e4;
  hertz.damper = Damper::viscoelastic;
  hertz.gn = hertz.gt = 1e-4;
  ContactLaw tsuji = hertz;
  tsuji.damper = Damper::critical;
  tsuji.gn = tsuji.gt = 0.4;
  ContactLaw polynomial = fullLaw();
  polynomial.normal = NormalLaw::polynomial;
  polynomial.kn = 1e6;
  polynomial.kn3 = 1e10;
  ContactLaw rigid = fullLaw();
  rigid.normal = NormalLaw::rigid;
  rigid.en = 0.8;
  rigid.et0 = 0.3;
  return {fullLaw(), hertz, tsuji, polynomial, rigid};
}

/// Where disks are after some steps, taken back, and their spins.
LockstepFrame endOf(const Scene& scene, const Transform& change, std::uint64_t steps) {
  const std::unique_ptr<Engine> grain = makeGrain();
  const Scene other = transformed(scene, change);
  grain->load(other, {});
  LockstepFrame frame = follow(*grain, other.dt, {steps}).front();
  frame.position = placesBack(change, frame.position);
  frame.spin = spinsBack(change, frame.spin);
  return frame;
}

/// A scene with everything in it that has a dimension.
Scene everything(const ContactLaw& law) {
  Scene scene = busyScene(law);
  scene.gravity = {0.3, -9.81};
  if (law.soft()) scene.bottom = BottomPlate{2.0, 10.0, 0.01, 0.1, 9.81, true};
  WallBody paddle;
  paddle.name = "paddle";
  paddle.centre = {0.0, -0.2};
  paddle.planes = {{{0.0, -0.2}, {0.0, 1.0}}};
  paddle.motion.kind = Motion::Kind::oscillating;
  paddle.motion.amplitude = {0.001, 0.002};
  paddle.motion.frequency = 300.0;
  scene.bodies.push_back(paddle);
  return scene;
}

constexpr std::uint64_t steps = 400;

TEST(Transforms, OtherUnits_HaveTheSameBits) {
  for (const ContactLaw& law : lawsOfEveryDimension()) {
    SCOPED_TRACE(static_cast<int>(law.normal) * 10 + static_cast<int>(law.damper));
    const Scene scene = everything(law);
    const LockstepFrame original = endOf(scene, {}, steps);
    EXPECT_NE(original.position, scene.disks.position);
    for (const Units& units : {Units{0x1p-10, 1, 1}, Units{1, 0x1p-10, 1}, Units{1, 1, 0x1p10},
                               Units{0x1p4, 0x1p6, 0x1p-8}}) {
      const LockstepFrame told = endOf(scene, {.units = units}, steps);
      EXPECT_EQ(told.position, original.position);
      EXPECT_EQ(told.spin, original.spin);
    }
  }
}

/// Forgetting to scale any one constant must show: else the test above has nothing to say of it.
TEST(Transforms, ConstantNotScaled_IsSeen) {
  const Units units{0x1p-10, 0x1p-10, 0x1p10};
  const auto differs = [&](const ContactLaw& law, void (*forget)(Scene&, const Scene&)) {
    const Scene scene = everything(law);
    Scene other = inUnits(scene, units);
    forget(other, scene);
    const std::unique_ptr<Engine> grain = makeGrain();
    grain->load(other, {{"max_overlap", 0.0}});
    const auto told = placesBack({.units = units}, follow(*grain, other.dt, {steps})[0].position);
    return told != endOf(scene, {}, steps).position;
  };
  using Forget = void (*)(Scene&, const Scene&);
  const ContactLaw linear = fullLaw(), hertz = lawsOfEveryDimension()[1],
                   polynomial = lawsOfEveryDimension()[3];
  EXPECT_FALSE(differs(linear, [](Scene&, const Scene&) {}));
  for (const Forget forget :
       {Forget([](Scene&to, const Scene&of) { to.law.kn = of.law.kn; }),
        Forget([](Scene&to, const Scene&of) { to.law.gn = of.law.gn; }),
        Forget([](Scene&to, const Scene&of) { to.law.kt = of.law.kt; }),
        Forget([](Scene&to, const Scene&of) { to.law.gt = of.law.gt; }),
        Forget([](Scene&to, const Scene&of) { to.gravity = of.gravity; }),
        Forget([](Scene&to, const Scene&of) { to.bottom->kb = of.bottom->kb; }),
        Forget([](Scene&to, const Scene&of) { to.bottom->gb = of.bottom->gb; }),
        Forget([](Scene&to, const Scene&of) { to.bottom->gravity = of.bottom->gravity; }),
        Forget([](Scene&to, const Scene&of) { to.disks.inertia = of.disks.inertia; })})
    EXPECT_TRUE(differs(linear, forget));
  EXPECT_TRUE(differs(polynomial, [](Scene& to, const Scene& of) { to.law.kn3 = of.law.kn3; }));
  EXPECT_TRUE(differs(hertz, [](Scene& to, const Scene& of) { to.law.gn = of.law.gn; }));
}

TEST(Transforms, TurnedMirroredRenumbered_AreTheSameToRounding) {
  const Scene scene = everything(fullLaw());
  const LockstepFrame original = endOf(scene, {}, steps);
  for (const CaseTransform& transform : caseTransforms(scene.disks.size())) {
    SCOPED_TRACE(transform.name);
    const LockstepFrame told = endOf(scene, transform.change, steps);
    for (std::size_t i = 0; i < original.position.size(); ++i) {
      // 400 steps of 10⁻¹⁶ that a few contacts magnify
      EXPECT_LT((told.position[i] - original.position[i]).norm(), 1e-11 * scene.disks.radius[i]);
      EXPECT_NEAR(told.spin[i], original.spin[i], 1e-9 * (1.0 + std::abs(original.spin[i])));
    }
  }
}

TEST(Transforms, ShuffledOrder_IsAPermutation) {
  const std::vector<std::size_t> order = shuffledOrder(100, transformSeed);
  EXPECT_EQ(std::set<std::size_t>(order.begin(), order.end()).size(), 100u);
  EXPECT_EQ(order, shuffledOrder(100, transformSeed));
  int kept = 0;
  for (std::size_t k = 0; k + 1 < order.size(); ++k) kept += order[k] + 1 == order[k + 1];
  EXPECT_LT(kept, 10);
  EXPECT_TRUE(shuffledOrder(0, 1).empty());
  for (std::uint64_t seed = 1; seed < 20; ++seed)  // half of all shuffles of two change nothing
    EXPECT_EQ(shuffledOrder(2, seed), (std::vector<std::size_t>{1, 0}));
}

/// Lengths twice as long, masses three times as large, times five times as long.
constexpr Units units{.length = 2.0, .mass = 3.0, .time = 5.0};

TEST(SettingUnits, EachUnit_HasItsFactor) {
  const std::pair<const char*, double> expected[] = {
      {"", 1.0},           {"-", 1.0},           {"rad", 1.0},      {"smallest radius", 1.0},
      {"m", 2.0},          {"kg", 3.0},          {"s", 5.0},        {"m/s", 2.0 / 5},
      {"m/s²", 2.0 / 25},  {"1/s", 1.0 / 5},     {"/s", 1.0 / 5},   {"Hz", 1.0 / 5},
      {"rad/s", 1.0 / 5},  {"N", 3.0 * 2 / 25},  {"N/m", 3.0 / 25}, {"kg/s", 3.0 / 5},
      {"J", 3.0 * 4 / 25}, {"Pa", 3.0 / 2 / 25}, {"1/m", 1.0 / 2},  {"kg/m³", 3.0 / 8}};
  for (const auto& [unit, factor] : expected)
    EXPECT_DOUBLE_EQ(factorOf(unit, units).value_or(0.0), factor) << unit;
  EXPECT_FALSE(factorOf("furlong", units));
}

TEST(SettingUnits, DefaultsAndZero_AreScaled) {
  const std::vector<SettingSpec> specs = {{"skin", 0.5, "m", "", {}},
                                          {"none", 0.0, "furlong", "", {}},
                                          {"share", 0.25, "-", "", {}},
                                          {"name", std::string("a"), "m", "", {}},
                                          {"speed", 1.0, "m/s", "", {}}};
  const Settings expected = {{"skin", 1.0}, {"speed", 10.0 * 2 / 5}};
  EXPECT_EQ(inUnits({{"speed", 10.0}}, specs, units), expected);
  EXPECT_EQ(inUnits({{"speed", 10.0}}, specs, {}), (Settings{{"speed", 10.0}}));
  EXPECT_TRUE(inUnits({}, specs, {}).empty());
  EXPECT_THROW(inUnits({{"none", 1.0}}, specs, units), UnsupportedScene);
}

/// Hours, so that the test's own time is none.
constexpr double hours = 3600.0;

TEST(TimeBudget, Budget_IsSharedEquallyAmongTheRest) {
  TimeBudget budget(40.0 * hours, 4, 1);
  const TimeShare first = budget.next();
  EXPECT_NO_THROW(first.require(9.9 * hours));
  EXPECT_THROW(first.require(10.1 * hours), OutOfTime);
  // The first took nothing of its part: three have it.
  const TimeShare second = budget.next();
  EXPECT_NO_THROW(second.require(13.2 * hours));
  EXPECT_THROW(second.require(13.4 * hours), OutOfTime);
  budget.next();
  EXPECT_NO_THROW(budget.next().require(39.9 * hours));
}

TEST(TimeBudget, SeveralJobs_HaveTheTimeOfAll) {
  TimeBudget budget(40.0 * hours, 4, 2);
  const TimeShare first = budget.next();
  EXPECT_NO_THROW(first.require(19.9 * hours));
  EXPECT_THROW(first.require(20.1 * hours), OutOfTime);
  TimeBudget few(40.0 * hours, 1, 8);
  EXPECT_THROW(few.next().require(40.1 * hours), OutOfTime);
}

TEST(TimeBudget, InfiniteOrNone_RunsAllOrNothing) {
  TimeBudget infinite(std::numeric_limits<double>::infinity(), 1, 1), none(0.0, 1, 1);
  EXPECT_NO_THROW(infinite.next().require(1e300));
  EXPECT_THROW(none.next().require(0.0), OutOfTime);
}

}  // namespace
