#include <gtest/gtest.h>

#include <iterator>
#include <optional>
#include <tuple>

#include "engines/grain/law_types.hpp"
#include "tests/unit/grain_packed.hpp"

// Kernels in which a scene's effects are compiled in, against the one that decides at run time.

namespace {

using namespace grain;
namespace test = crossgrain::test;

constexpr int steps = 150;

enum class Plate { none, sliding, spinning };
enum class Dashpot { none, lagged, predicted };  // implicit damping has no kernel of its own

struct Share {
  std::size_t contacts = 0, sliding = 0, pulling = 0, planes = 0;
};

/// What there is to see, so that "the same" is not "nothing on both sides".
void count(const Simulation& s, Share& share) {
  for (const Contact& c : s.contacts()) {
    ++share.contacts;
    share.sliding += c.sliding;
    share.pulling += c.normalForce < 0.0;
    share.planes += static_cast<std::size_t>(c.j) >= s.diskCount();
  }
}

Setup scene(Tangential tangential, bool cut, Dashpot dashpot, bool rotation, Plate plate,
            bool gravity) {
  grain::Setup setup = test::packed(9, 21);
  setup.law.tangential = tangential;
  setup.law.cutTension = cut;
  if (dashpot == Dashpot::none) setup.law.gn = 0.0;
  setup.law.damping = dashpot == Dashpot::lagged ? Damping::lagged : Damping::predicted;
  setup.rotation = rotation;
  if (plate != Plate::none)
    setup.bottom = test::thesisBottom<Bottom>(0.02, plate == Plate::spinning);
  if (gravity) setup.gravityY = -9.81;
  return setup;
}

using Kind = std::tuple<Tangential, Integrator, Precision>;

class Specialised : public testing::TestWithParam<Kind> {};

TEST_P(Specialised, GivesTheBitsOfTheGeneralKernel) {
  const auto [tangential, integrator, precision] = GetParam();
  Share share;
  for (const bool cut : {false, true})
    for (const Dashpot dashpot : {Dashpot::none, Dashpot::lagged, Dashpot::predicted})
      for (const bool rotation : {false, true})
        for (const Plate plate : {Plate::none, Plate::sliding, Plate::spinning})
          for (const bool gravity : {false, true}) {
            if (tangential == Tangential::none && !rotation) continue;  // nothing turns either way
            grain::Setup setup = scene(tangential, cut, dashpot, rotation, plate, gravity);
            setup.integrator = integrator;
            setup.precision = precision;
            grain::Setup general = setup;
            general.generalKernels = true;
            const auto special = test::advanced(setup, steps);
            const auto reference = test::advanced(general, steps);
            EXPECT_EQ(test::difference(special, reference), "")
                << "cut " << cut << ", dashpot " << static_cast<int>(dashpot) << ", rotation "
                << rotation << ", plate " << static_cast<int>(plate) << ", gravity " << gravity;
            EXPECT_EQ(special.rotates(), rotation && tangential != Tangential::none);
            count(special, share);
          }
  EXPECT_GT(share.contacts, 1000u);
  EXPECT_GT(share.planes, 50u);
  EXPECT_GT(share.pulling, 0u);
  EXPECT_EQ(share.sliding > 0, tangential != Tangential::none);
  EXPECT_EQ(share.sliding < share.contacts, tangential != Tangential::coulomb);
}

INSTANTIATE_TEST_SUITE_P(
    Kernels, Specialised,
    testing::Combine(testing::Values(Tangential::none, Tangential::coulomb, Tangential::viscous,
                                     Tangential::spring, Tangential::springDashpot),
                     testing::Values(Integrator::positionVerlet, Integrator::velocityVerlet,
                                     Integrator::semiImplicitEuler),
                     testing::Values(Precision::float64, Precision::float32)));

/// The law with those conventions, the scene as in the thesis' cell.
grain::Setup underConventions(const Conventions& conventions, bool cut, Precision precision) {
  grain::Setup setup =
      scene(Tangential::springDashpot, cut, Dashpot::lagged, true, Plate::spinning, false);
  setup.precision = precision;
  setup.law.history = conventions.history;
  setup.law.bound = conventions.bound;
  setup.law.lever = conventions.lever;
  setup.law.velocityLever = conventions.velocityLever;
  setup.law.planeLever = conventions.planeLever;
  setup.law.stretch = conventions.stretch;
  setup.law.dashpotOutsideBound = conventions.dashpotOutsideBound;
  setup.law.resetSpringOnly = conventions.resetSpringOnly;
  return setup;
}

TEST(Specialisation, ConventionsOfOtherEnginesGiveTheBitsOfTheGeneralKernel) {
  for (std::size_t set = 0; set < std::size(conventionSets); ++set)
    for (const bool cut : {false, true})
      for (const Precision precision : {Precision::float64, Precision::float32}) {
        grain::Setup setup = underConventions(conventionSets[set], cut, precision);
        ASSERT_EQ(conventionSet(generalLaw<double>(setup.law, setup.dt, true)), set);
        grain::Setup general = setup;
        general.generalKernels = true;
        const auto special = test::advanced(setup, steps);
        const auto reference = test::advanced(general, steps);
        EXPECT_EQ(test::difference(special, reference), "") << "set " << set << ", cut " << cut;
      }
}

TEST(Specialisation, ConventionsWithoutKernelsOfTheirOwnRunTheGeneralOnes) {
  Law law = underConventions(conventionSets[1], true, Precision::float64).law;
  law.stretch = Stretch::midpoint;
  EXPECT_EQ(conventionSet(generalLaw<double>(law, 1e-5, true)), std::nullopt);
  law = underConventions(conventionSets[0], true, Precision::float64).law;
  law.normal = Normal::hertz;
  EXPECT_EQ(conventionSet(generalLaw<double>(law, 1e-5, true)), std::nullopt);
  // A plane's lever says nothing where levers are radii.
  law.normal = Normal::linear;
  law.planeLever = PlaneLever::middle;
  EXPECT_EQ(conventionSet(generalLaw<double>(law, 1e-5, true)), 0u);
}

TEST(Specialisation, EffectsChangeTheRun) {
  // Else the comparison above could not tell one kernel from another.
  const auto run = [](grain::Setup setup) { return test::stateOf(test::advanced(setup, steps)); };
  using enum Plate;
  constexpr auto spring = Tangential::spring, springDashpot = Tangential::springDashpot;
  const auto predicted = Dashpot::predicted;
  const auto full = run(scene(springDashpot, false, predicted, true, spinning, true));
  for (const grain::Setup& less :
       {scene(spring, false, predicted, true, spinning, true),
        scene(springDashpot, true, predicted, true, spinning, true),
        scene(springDashpot, false, Dashpot::lagged, true, spinning, true),
        scene(springDashpot, false, Dashpot::none, true, spinning, true),
        scene(springDashpot, false, predicted, false, spinning, true),
        scene(springDashpot, false, predicted, true, sliding, true),
        scene(springDashpot, false, predicted, true, Plate::none, true),
        scene(springDashpot, false, predicted, true, spinning, false)})
    EXPECT_NE(run(less), full);
}

}  // namespace
