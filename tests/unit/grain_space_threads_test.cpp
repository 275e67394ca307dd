// Spheres on several threads: the bits of one, whatever the law, the walls, the box and the lists.
#include <gtest/gtest.h>

#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/refusal.hpp"
#include "tests/unit/grain_sheared.hpp"

namespace {

using namespace grain;
using Vector = Vec3<double>;
using namespace crossgrain::test;

constexpr double radius = sphereRadius;

/// 108 spheres that fall in a turning drum with two lids.
SpheresSetup drum() {
  SpheresSetup setup;
  setup.law = springLaw();
  place(setup, 6, 3, Vector{-5.0 * radius, -5.0 * radius, 1.1 * radius});
  setup.gravity = {0.0, -9.81, 0.0};
  SpaceWall wall;
  wall.cylinders.push_back({{}, {0.0, 0.0, 1.0}, 8.5 * radius});
  wall.planes.push_back({{}, {0.0, 0.0, 1.0}});
  wall.planes.push_back({{0.0, 0.0, 6.2 * radius}, {0.0, 0.0, -1.0}});
  wall.motion = [](double t) {
    return SpaceWall::State{{}, {}, {0.0, 0.0, 20.0 * t}, {0.0, 0.0, 20.0}};
  };
  setup.walls.push_back(wall);
  return setup;
}

/// @return how many contacts it evaluated on its way
std::uint64_t expectTheSameBits(SpheresSetup setup, std::uint64_t steps,
                                std::initializer_list<int> counts) {
  const std::size_t walls = setup.walls.size();
  Spheres one(setup);
  one.advance(steps);
  const std::vector<double> bits = bitsOf(one, walls);
  for (const int threads : counts) {
    setup.threads = threads;
    Spheres several(setup);
    several.advance(steps);
    EXPECT_TRUE(bitsOf(several, walls) == bits) << threads << " threads";
  }
  EXPECT_GT(one.rebuilds(), 1u);
  return one.contactEvaluations();
}

TEST(SpaceThreads, AnyNumber_GivesTheSameBits) {
  EXPECT_GT(expectTheSameBits(sheared(), 200, {2, 3, 5}), 4000u);
  EXPECT_GT(expectTheSameBits(drum(), 200, {2, 3, 5}), 1000u);
  SpheresSetup few = sheared();
  for (auto* list : {&few.position, &few.velocity, &few.spin}) list->resize(2);
  for (auto* list : {&few.radius, &few.mass, &few.inertia}) list->resize(2);
  expectTheSameBits(few, 100, {2, 4});  // more threads than spheres
}

TEST(SpaceThreads, EveryLawAndIntegrator_GivesTheSameBits) {
  const auto with = [](auto&& change) {
    SpheresSetup setup = sheared();
    change(setup);
    EXPECT_GT(expectTheSameBits(setup, 100, {2}), 1500u);  // other numbers: above
  };
  for (const Integrator integrator : {Integrator::velocityVerlet, Integrator::semiImplicitEuler})
    with([&](auto& s) { s.law.conventions.integrator = integrator; });
  for (const TangentialLaw tangential :
       {TangentialLaw::none, TangentialLaw::coulomb, TangentialLaw::viscous})
    with([&](auto& s) { s.law.tangential = tangential; });
  with([](auto& s) { s.rotation = false; });
  with([](auto& s) { s.law.conventions.tension = Tension::cut; });
  with([](auto& s) {
    s.law.conventions.springTurn = SpringTurn::rescaled;
    s.law.conventions.springTwist = SpringTwist::none;
  });
  with([](auto& s) {  // rolling springs: the general kernel, torques that are not along f_t
    s.law.rolling = RollingLaw::spring;
    s.law.kr = 1e4;
    s.law.gr = 0.05;
    s.law.muR = 0.1;
  });
  with([](auto& s) {  // pairs that pull before and after they touch
    s.law.normal = NormalLaw::hertz;
    s.law.kn = 2e8;
    s.law.kt = 3e8;
    s.law.gn = s.law.gt = 0.2;
    s.law.damper = Damper::critical;
    s.law.cohesion = CohesionLaw::jkr;
    s.law.w = 2.0;
  });
  with([](auto& s) { s.skin = 2e-4; });  // rebuilds all the time
}

TEST(SpaceThreads, RunRestoredOnOtherNumbers_GoesOnToTheBitAcrossARenumbering) {
  for (const bool drums : {false, true}) {
    SpheresSetup setup = drums ? drum() : sheared();
    const std::size_t walls = setup.walls.size();
    Spheres one(setup);
    one.advance(8180);
    std::stringstream saved;
    one.save(saved);
    const std::uint64_t before = one.contactEvaluations();
    one.advance(40);                       // spheres are numbered anew at step 8192
    for (const int threads : {2, 3, 1}) {  // from each to the next
      setup.threads = threads;
      Spheres several(setup);
      several.restore(saved);
      saved = {};
      several.save(saved);
      several.advance(40);
      EXPECT_TRUE(bitsOf(several, walls) == bitsOf(one, walls)) << threads << " threads";
    }
    EXPECT_GT(one.contactEvaluations(), before + 100u);
  }
}

TEST(SpaceThreads, RunThatBeginsUnderWay_GivesTheSameBits) {
  SpheresSetup setup = sheared();
  setup.law.conventions.dampingVelocity = DampingVelocity::lagged;
  Spheres before(setup);
  before.advance(100);
  const auto contacts = before.contacts();
  for (std::size_t i = 0; i < before.size(); ++i) {
    setup.position[i] = before.position(i);
    setup.velocity[i] = before.velocity(i);
    setup.spin[i] = before.spin(i);
  }
  std::vector<double> bits;
  for (const int threads : {1, 3}) {
    setup.threads = threads;
    Spheres begun(setup);
    begun.beginUnderWay(contacts);
    begun.advance(20);
    if (threads == 1) bits = bitsOf(begun, 2);
    EXPECT_TRUE(bitsOf(begun, 2) == bits);
  }
}

TEST(SpaceThreads, WhatGoesWrong_IsPassedOn) {
  const auto why = [](SpheresSetup setup) {
    setup.threads = 3;
    Spheres spheres(setup);
    return crossgrain::test::refusalOf<std::runtime_error>([&] { spheres.advance(2000); });
  };
  SpheresSetup lost = sheared(), deep = sheared(), through = drum();
  lost.velocity[200].x = std::numeric_limits<double>::infinity();
  EXPECT_EQ(why(lost).find("the position of sphere 200 is not finite"), 0u);
  deep.velocity[100] = {0.0, 0.0, 300.0};
  EXPECT_NE(why(deep).find("of the smaller radius"), std::string::npos);
  through.velocity[50] = {0.0, 0.0, 300.0};
  EXPECT_NE(why(through).find("of the smaller radius"), std::string::npos);
}

}  // namespace
