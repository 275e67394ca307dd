// Rolling resistance and cohesion of engines that are right but for one planted thing: lockstep
// names it, and identify finds conventions and constants without asking.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "law/law_options.hpp"
#include "studies/causes/changes.hpp"
#include "studies/lockstep/identify.hpp"
#include "studies/lockstep/late_windows.hpp"
#include "studies/lockstep/lockstep.hpp"
#include "studies/lockstep/rules.hpp"
#include "studies/lockstep/terms.hpp"
#include "tests/studies/planted_engine.hpp"
#include "tests/studies/planted_program.hpp"
#include "tests/studies/quick_cell.hpp"

namespace {

using namespace crossgrain;

/// The quick cell under one more part of the law.
class ResistingCell : public testing::Test {
 protected:
  static Identification identified(const test::QuickFlow& flow,
                                   std::function<void(ContactLaw&)> fault) {
    test::PlantedEngine engine([fault = std::move(fault)](Scene& scene) { fault(scene.law); });
    return identify(engine, test::inHouse, flow.setup, flow.states, flow.dt, [](double) {});
  }
  static LockstepRow row(const test::QuickFlow& flow, std::function<void(ContactLaw&)> fault) {
    test::PlantedEngine engine([fault = std::move(fault)](Scene& scene) { fault(scene.law); });
    return holdAgainstMirror(engine, test::inHouse, flow.setup, flow.states, flow.dt,
                             [](double) {});
  }

  /// A constant off by 10⁻⁴ is named by lockstep, one off by 2 % found by identify.
  static void expectConstant(const test::QuickFlow& flow, double ContactLaw::*constant,
                             const std::string& name) {
    const LockstepRow off = row(flow, [=](ContactLaw& law) { law.*constant *= 1.0 + 1e-4; });
    ASSERT_TRUE(off.term) << name;
    EXPECT_EQ(off.term->name, name);
    EXPECT_NEAR(*off.term->amount, 1e-4, 2e-6) << name;
    const Identification found = identified(flow, [=](ContactLaw& law) { law.*constant *= 1.02; });
    ASSERT_EQ(found.constants.size(), 1u) << name;
    EXPECT_EQ(found.constants.front().name, name);
    EXPECT_NEAR(found.constants.front().change, 0.02, 1e-4);
    EXPECT_LT(found.left, 1e-6) << name;
  }

  /// Each other value of every option of that part, as long as the constants mean the same, is
  /// found, or one that does here as it does. @returns how many are found and alike
  static std::pair<int, int> expectOptions(const test::QuickFlow& flow, LawPart part) {
    std::pair<int, int> counts;
    for (const LawOption& option : lawOptions()) {
      const std::string name(option.name);
      if (option.part != part || !mattersTo(flow.setup.law, name)) continue;
      for (const std::string_view value : option.values) {
        if (value == lawOptionValue(flow.setup.law, name)) continue;
        if (!constantsServe(flow.setup.law, name, value)) continue;
        const Identification seen =
            identified(flow, [&](ContactLaw& law) { setLawOption(law, name, value); });
        EXPECT_LT(seen.left, lockstepRounding) << name << " = " << value;
        const auto found = std::ranges::find(seen.options, name, &FoundOption::name);
        if (found == seen.options.end()) continue;  // it has no bearing on that law
        EXPECT_TRUE(std::ranges::count(found->values, value)) << name << " = " << value;
        (found->values.size() == 1 ? counts.first : counts.second) += 1;
      }
    }
    return counts;
  }
};

TEST_F(ResistingCell, RollingSpring_ConstantsAndConventionsAreFound) {
  const test::QuickFlow flow(3, {"preparation.rotations=0.2", "law.rolling=spring", "law.kr=26.7",
                                 "law.gr=0.015", "law.mu_r=0.1", "run.may_differ=conventions"});
  for (const auto& [constant, name] :
       {std::pair(&ContactLaw::kr, "kr"), {&ContactLaw::gr, "gr"}, {&ContactLaw::muR, "mu_r"}})
    expectConstant(flow, constant, name);
  // Contacts that slip at once under µ_r stick under 1.037 µ_r: nothing of first order.
  const LockstepRow large = row(flow, [](ContactLaw& law) { law.muR *= 1.037; });
  ASSERT_TRUE(large.term);
  EXPECT_EQ(large.term->name, "mu_r");
  EXPECT_NEAR(*large.term->amount, 0.037, 0.004);
  const auto [found, alike] = expectOptions(flow, LawPart::rolling);
  EXPECT_GE(found, 6);
  EXPECT_LE(alike, 2);
  test::expectDeclaredOrNamed(flow, {{"roll_length=2", "rolling_length = twice_effective"},
                                     {"roll_dashpot_outside=1", "rolling_dashpot = outside"},
                                     {"roll_spring_only=1", "rolling_reset = spring_only"},
                                     {"spring_before=1", "spring_update = before"}});
  const Identification without =
      identified(flow, [](ContactLaw& law) { law.rolling = RollingLaw::none; });
  EXPECT_EQ(without.missing, std::vector<std::string>{"rolling_resistance"});
  EXPECT_LT(without.left, lockstepRounding);
}

TEST_F(ResistingCell, CohesionByArea_ConstantsAndConventionsAreFound) {
  const test::QuickFlow flow(3, {"preparation.rotations=0.2", "law.cohesion=area", "law.kc=3000"});
  expectConstant(flow, &ContactLaw::kc, "kc");
  // Two areas, |f_n| and f_n without its dashpot; without a pull-off f_n + 2 F_po is f_n.
  const auto [found, alike] = expectOptions(flow, LawPart::cohesion);
  EXPECT_EQ(found, 4);
  EXPECT_EQ(alike, 2);
  const LockstepRow without = row(flow, [](ContactLaw& law) { law.cohesion = CohesionLaw::none; });
  ASSERT_TRUE(without.term);
  EXPECT_EQ(without.term->name, "without cohesion");
}

/// Springs, torques and the bonds that contacts have are taken over in the middle of a run: what
/// follows is the same to rounding.
TEST(MiddleOfARun, RollingSprings_GoOn) {
  // The plate's springs, which no engine reports, and predicted velocities do not go on to the bit.
  // A spring that slips is begun as one that slips, so its bound must be the law's: of another
  // length, and none where there is no load. Constants are a quarter and half where L is twice R₁₂.
  const std::vector<std::vector<std::string>> laws = {
      {"law.kr=26.7", "law.gr=0.015", "law.mu_r=0.1"},
      {"law.kr=6.7", "law.gr=0.004", "law.mu_r=0.05", "law.rolling_length=mean_radius"},
      {"law.kr=26.7", "law.gr=0.015", "law.mu_r=0.1", "law.tension=cut",
       "law.rolling_load=while_compressed"}};
  for (const std::vector<std::string>& law : laws) {
    std::vector<std::string> changes = {
        "preparation.rotations=0.2",          "averaging.settle_rotations=0.02",
        "averaging.rotations=0.05",           "bottom.mu=0",
        "law.integrator=semi_implicit_euler", "law.rolling=spring"};
    changes.insert(changes.end(), law.begin(), law.end());
    const test::QuickFlow flow(1, changes);
    const auto engine = makeGrain();
    const LateWindows late = followLate(*engine, test::inHouse, flow.setup, flow.packings.front(),
                                        0, flow.dt, 4, [](double) {});
    EXPECT_EQ(late.failure, "") << law.back();
    ASSERT_FALSE(late.equivalents.empty()) << law.back();
    EXPECT_LT(late.equivalents.front().change, 1e-6) << law.back();
  }
}

}  // namespace
