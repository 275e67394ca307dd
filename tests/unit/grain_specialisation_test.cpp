#include <gtest/gtest.h>

#include <array>
#include <iterator>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "engines/grain/kernels.hpp"
#include "tests/unit/grain_packed.hpp"
#include "tests/unit/grain_sheared.hpp"

// Kernels in which a scene's effects are compiled in, against the one that decides at run time, in
// the plane and in space.

namespace {

using namespace grain;
namespace test = crossgrain::test;

constexpr int steps = 150;

enum class Plate { none, sliding, spinning };
enum class Damping { none, lagged, predicted };  // implicit damping has no kernel of its own

struct Share {
  std::size_t contacts = 0, sliding = 0, pulling = 0, planes = 0;
};

/// Counts contacts by kind, so that "the same" is not "nothing on both sides".
void count(const Simulation& s, Share& share) {
  for (const Contact& c : s.contacts()) {
    ++share.contacts;
    share.sliding += c.sliding;
    share.pulling += c.normalForce < 0.0;
    share.planes += static_cast<std::size_t>(c.j) >= s.diskCount();
  }
}

Setup scene(TangentialLaw tangential, bool cut, Damping dashpot, bool rotation, Plate plate,
            bool gravity) {
  grain::Setup setup = test::packed(9, 21);
  setup.law.tangential = tangential;
  setup.law.conventions.tension = cut ? Tension::cut : Tension::allow;
  if (dashpot == Damping::none) setup.law.gn = 0.0;
  setup.law.conventions.dampingVelocity =
      dashpot == Damping::lagged ? DampingVelocity::lagged : DampingVelocity::predicted;
  setup.rotation = rotation;
  if (plate != Plate::none)
    setup.bottom = test::thesisBottom<BottomPlate>(0.02, plate == Plate::spinning);
  if (gravity) setup.gravityY = -9.81;
  return setup;
}

using Kind = std::tuple<TangentialLaw, Integrator, Precision>;

class Specialised : public testing::TestWithParam<Kind> {};

TEST_P(Specialised, GivesTheBitsOfTheGeneralKernel) {
  const auto [tangential, integrator, precision] = GetParam();
  Share share;
  for (const bool cut : {false, true})
    for (const Damping dashpot : {Damping::none, Damping::lagged, Damping::predicted})
      for (const bool rotation : {false, true})
        for (const Plate plate : {Plate::none, Plate::sliding, Plate::spinning})
          for (const bool gravity : {false, true}) {
            if (tangential == TangentialLaw::none && !rotation)
              continue;  // nothing turns either way
            grain::Setup setup = scene(tangential, cut, dashpot, rotation, plate, gravity);
            setup.law.conventions.integrator = integrator;
            setup.precision = precision;
            grain::Setup general = setup;
            general.generalKernels = true;
            const auto special = test::advanced(setup, steps);
            const auto reference = test::advanced(general, steps);
            EXPECT_EQ(test::difference(special, reference), "")
                << "cut " << cut << ", dashpot " << static_cast<int>(dashpot) << ", rotation "
                << rotation << ", plate " << static_cast<int>(plate) << ", gravity " << gravity;
            EXPECT_EQ(special.rotates(), rotation && tangential != TangentialLaw::none);
            count(special, share);
          }
  EXPECT_GT(share.contacts, 1000u);
  EXPECT_GT(share.planes, 50u);
  EXPECT_GT(share.pulling, 0u);
  EXPECT_EQ(share.sliding > 0, tangential != TangentialLaw::none);
  EXPECT_EQ(share.sliding < share.contacts, tangential != TangentialLaw::coulomb);
}

INSTANTIATE_TEST_SUITE_P(
    Kernels, Specialised,
    testing::Combine(testing::Values(TangentialLaw::none, TangentialLaw::coulomb,
                                     TangentialLaw::viscous, TangentialLaw::spring,
                                     TangentialLaw::springDashpot),
                     testing::Values(Integrator::positionVerlet, Integrator::velocityVerlet,
                                     Integrator::semiImplicitEuler),
                     testing::Values(Precision::float64, Precision::float32)));

/// A law whose kernels are compiled, but for what a scene decides.
struct Special {
  std::string name;
  ContactLaw law;
  bool rotation = true;
};

void setConventions(ContactLaw& law, const Conventions& conventions) {
  law.conventions.history = conventions.history;
  if (conventions.signedBound) law.conventions.coulombBound = CoulombBound::signedForce;
  law.conventions.leverArm = conventions.lever;
  law.conventions.planeArm = conventions.planeLever;
  law.conventions.springUpdate = conventions.stretch;
  if (conventions.dashpotOutsideBound) law.conventions.dashpot = Dashpot::outside;
  if (conventions.resetSpringOnly) law.conventions.springReset = SpringReset::springOnly;
}

/// A spring against rolling as stiff as that along the tangent, a pull of a twentieth of the
/// elastic force of bodies of that radius.
ContactLaw withRollingAndCohesion(ContactLaw law, RollingLaw rolling, bool cohesion,
                                  double radius) {
  law.rolling = rolling;
  law.kr = law.kt;
  law.gr = law.gt;
  law.muR = rolling == RollingLaw::viscousByLoad ? 1e-3 : 0.1;
  if (!cohesion) return law;
  law.cohesion = CohesionLaw::area;
  law.kc = 0.05 * law.kn / (M_PI * radius);
  return law;
}

/// Each set of conventions × each effect left out × tension and bound; of whole laws also how they
/// resist rolling and cohere, with each option that is a number.
std::vector<Special> specialLaws(const ContactLaw& common, double radius) {
  std::vector<Special> laws;
  const auto name = [](auto... parts) { return ((std::to_string(parts) + " ") + ...); };
  for (std::size_t set = 0; set < std::size(conventionSets); ++set) {
    ContactLaw whole = common;
    setConventions(whole, conventionSets[set].conventions);
    for (int tangential = 0; tangential < 5; ++tangential)
      for (const bool damps : {true, false})
        for (const bool turns : {true, false}) {
          ContactLaw law = whole;
          law.tangential = static_cast<TangentialLaw>(tangential);
          if (!damps) law.gn = 0.0;
          const bool all = law.tangential == TangentialLaw::springDashpot && damps && turns;
          if (!all && !conventionSets[set].everyEffect) continue;
          for (const bool cut : {false, true})
            for (const CoulombBound bound : {CoulombBound::compression, CoulombBound::magnitude}) {
              law.conventions.tension = cut ? Tension::cut : Tension::allow;
              law.conventions.coulombBound = bound;
              laws.push_back(
                  {"effects " + name(set, tangential, damps, turns, cut, int(bound)), law, turns});
            }
        }
    for (int rolling = 0; rolling < 5; ++rolling)
      for (const bool cohesion : {false, true}) {
        const ContactLaw law =
            withRollingAndCohesion(whole, static_cast<RollingLaw>(rolling), cohesion, radius);
        const auto with = [&](const std::string& what, auto&& change) {
          laws.push_back({what + " " + name(set, rolling, cohesion), law});
          change(laws.back().law);
        };
        with("whole", [](ContactLaw&) {});
        with("undamped", [](ContactLaw& l) { l.gn = 0.0; });
        with("no dashpot", [](ContactLaw& l) { l.tangential = TangentialLaw::spring; });
        with("cut", [](ContactLaw& l) { l.conventions.tension = Tension::cut; });
        for (int k = 1; rolling > 0 && k < 4; ++k) {
          with("length", [k](ContactLaw& l) {
            l.conventions.rollingLength = static_cast<RollingLength>(k);
            l.conventions.rollingStiffness = static_cast<RollingStiffness>(k % 3);
            if (k % 3 == 2) l.kr *= 1e-5;  // in N m
          });
          with("load", [k](ContactLaw& l) {
            l.conventions.rollingLoad = static_cast<RollingLoad>(k);
            l.conventions.rollingDashpot = k % 2 == 1 ? Dashpot::outside : Dashpot::inside;
            l.conventions.rollingReset = k > 1 ? SpringReset::springOnly : SpringReset::total;
          });
        }
        if (rolling > 0)
          with("critical", [](ContactLaw& l) {
            l.conventions.rollingDamper = RollingDamper::critical;
            l.gr = 0.1;
          });
        for (int area = 0; cohesion && area < 3; ++area)
          for (int load = 0; load < 5; ++load)
            with("area " + name(area, load), [=](ContactLaw& l) {
              l.conventions.cohesionArea = static_cast<CohesionArea>(area);
              l.conventions.cohesionLoad = static_cast<CohesionLoad>(load);
            });
      }
  }
  return laws;
}

/// Some mirrors have none, and processors without AVX2 those of whole laws alone.
bool hasKernels(std::size_t variant) {
  return conventionSets[variant / effectVariants].everyEffect && instructionSets().size() > 1;
}

TEST(Specialisation, EveryLawInThePlane_GivesTheBitsOfTheGeneralKernel) {
  const auto kernels = grain::kernels<double>();
  for (const Special& special : specialLaws(test::thesisLaw(), test::smallRadius)) {
    SCOPED_TRACE(special.name);
    grain::Setup setup = test::packed(7, 21);
    setup.law = special.law;
    setup.law.conventions.dampingVelocity = DampingVelocity::lagged;
    setup.rotation = special.rotation;
    const auto variant = contactVariant(generalLaw<double>(setup.law, setup.dt, special.rotation));
    ASSERT_TRUE(variant);
    if (hasKernels(*variant)) {
      const ContactEffects effects = contactEffects(*variant);
      EXPECT_NE(kernelOf(kernels.contacts, *variant), nullptr);
      if (effects.rolling == Rolls::none && !effects.cohesion) {
        EXPECT_NE(kernelOf(kernels.planes, *variant), nullptr);
      }
    }
    for (const Precision precision : {Precision::float64, Precision::float32}) {
      setup.precision = precision;
      grain::Setup general = setup;
      general.generalKernels = true;
      EXPECT_EQ(test::difference(test::advanced(setup, 60), test::advanced(general, 60)), "");
    }
  }
}

/// Contacts that were seen.
struct Met {
  std::size_t contacts = 0, sliding = 0, walls = 0;  ///< walls: planes and cylinders
};

Met expectBitsOfTheGeneralKernel(SpheresSetup setup) {
  Spheres special(setup);
  setup.generalKernels = true;
  Spheres general(setup);
  Met met;
  for (int piece = 0; piece < 6; ++piece) {
    special.advance(10);
    general.advance(10);
    for (const SpaceContact& contact : special.contacts()) {
      ++met.contacts;
      met.sliding += contact.sliding;
      met.walls += static_cast<std::size_t>(contact.j) >= special.size() + special.wallSpheres();
    }
    EXPECT_TRUE(test::bitsOf(special, setup.walls.size()) ==
                test::bitsOf(general, setup.walls.size()))
        << piece;
  }
  return met;
}

/// Of two materials, in turn, and walls of the second.
void mix(SpheresSetup& setup) {
  ContactLaw other = setup.law;
  for (double* constant : {&other.kn, &other.gn, &other.kt, &other.gt, &other.kr, &other.kc})
    *constant *= 0.7;
  other.mu *= 0.5;
  setup.materials = Materials{std::vector<std::int32_t>(setup.radius.size()),
                              std::vector<std::int32_t>(setup.walls.size(), 1),
                              2,
                              {setup.law, other, other, other}};
  for (std::size_t i = 0; i < setup.radius.size(); i += 2) setup.materials->ofDisk[i] = 1;
}

/// A plane that slides under the lowest spheres, and a cylinder about its axis that turns.
void enclose(SpheresSetup& setup) {
  grain::SpaceWall floor, shell;
  floor.planes.push_back({{0.0, 0.0, 1.1 * test::sphereRadius}, {0.0, 0.0, 1.0}});
  floor.motion = [](double t) {
    return grain::SpaceWall::State{{0.3 * t, 0.0, 0.0}, {0.3, 0.0, 0.0}};
  };
  const double half = 0.5 * setup.box->length.x;
  shell.cylinders.push_back({{half, half, 0.0}, {0.0, 0.0, 1.0}, 1.45 * half});
  shell.motion = [half](double t) {
    return grain::SpaceWall::State{{half, half, 0.0}, {}, {0.0, 0.0, 20.0 * t}, {0.0, 0.0, 20.0}};
  };
  setup.walls.push_back(floor);
  setup.walls.push_back(shell);
}

TEST(Specialisation, EveryLawInSpace_GivesTheBitsOfTheGeneralKernel) {
  const auto kernels = grain::kernels<double>().space;
  for (const Special& special : specialLaws(test::springLaw(), test::sphereRadius))
    for (const auto& [enclosed, mixed] :
         {std::pair(false, false), std::pair(true, false), std::pair(true, true)}) {
      SCOPED_TRACE(std::string(special.name) + (enclosed ? ", enclosed" : "") +
                   (mixed ? ", mixed" : ""));
      SpheresSetup setup = test::pressed(special.law);
      setup.law.conventions.dampingVelocity = DampingVelocity::lagged;
      setup.rotation = special.rotation;
      if (enclosed) enclose(setup);
      if (mixed) mix(setup);
      const auto variant =
          contactVariant(generalLaw<double>(setup.law, setup.dt, special.rotation));
      ASSERT_TRUE(variant);
      EXPECT_EQ(kernelOf(kernels.pairs.own, *variant) != nullptr, hasKernels(*variant));
      EXPECT_EQ(kernelOf(kernels.materialPairs.own, *variant) != nullptr, hasKernels(*variant));
      EXPECT_EQ(kernelOf(kernels.planes.own, *variant) != nullptr, hasKernels(*variant));
      const Met met = expectBitsOfTheGeneralKernel(setup);
      EXPECT_GT(met.contacts, 200u);
      EXPECT_EQ(met.walls > 50u, enclosed);
      if (setup.law.tangential != TangentialLaw::springDashpot) continue;
      EXPECT_GT(met.sliding, 0u);
      EXPECT_LT(met.sliding, met.contacts);
    }
}

TEST(Specialisation, MirrorsInSpace_GiveTheBitsOfTheGeneralKernel) {
  SpheresSetup setup = test::pressed();
  setup.law.conventions.springTurn = SpringTurn::rescaled;
  setup.law.conventions.springTwist = SpringTwist::none;
  for (const bool mixed : {false, true}) {
    if (mixed) {
      setup.materials = Materials{std::vector<std::int32_t>(setup.radius.size(), 0),
                                  {0, 1},
                                  2,
                                  std::vector<ContactLaw>(4, setup.law)};
      setup.materials->laws[3].mu = 0.1;
    }
    EXPECT_GT(expectBitsOfTheGeneralKernel(setup).contacts, 200u);
  }
}

TEST(Specialisation, ConventionsWithoutKernelsOfTheirOwnRunTheGeneralOnes) {
  ContactLaw law = test::thesisLaw();
  const auto variant = [&] { return contactVariant(generalLaw<double>(law, 1e-5, true)); };
  EXPECT_TRUE(variant());
  law.conventions.springUpdate = SpringUpdate::midpoint;
  EXPECT_EQ(variant(), std::nullopt);
  law = test::thesisLaw();
  law.normal = NormalLaw::hertz;
  EXPECT_EQ(variant(), std::nullopt);
  law.normal = NormalLaw::linear;
  const auto usual = variant();
  // A plane's lever says nothing where levers are radii.
  law.conventions.planeArm = PlaneArm::middle;
  EXPECT_EQ(variant(), usual);
  law.conventions.coulombBound = CoulombBound::signedForce;
  EXPECT_EQ(variant(), std::nullopt);
}

TEST(Specialisation, EffectsChangeTheRun) {
  // Else the comparison above could not tell one kernel from another.
  const auto run = [](grain::Setup setup) { return test::stateOf(test::advanced(setup, steps)); };
  using enum Plate;
  constexpr auto spring = TangentialLaw::spring, springDashpot = TangentialLaw::springDashpot;
  const auto predicted = Damping::predicted;
  const auto full = run(scene(springDashpot, false, predicted, true, spinning, true));
  for (const grain::Setup& less :
       {scene(spring, false, predicted, true, spinning, true),
        scene(springDashpot, true, predicted, true, spinning, true),
        scene(springDashpot, false, Damping::lagged, true, spinning, true),
        scene(springDashpot, false, Damping::none, true, spinning, true),
        scene(springDashpot, false, predicted, false, spinning, true),
        scene(springDashpot, false, predicted, true, sliding, true),
        scene(springDashpot, false, predicted, true, Plate::none, true),
        scene(springDashpot, false, predicted, true, spinning, false)})
    EXPECT_NE(run(less), full);
}

}  // namespace
