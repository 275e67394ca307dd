#include <gtest/gtest.h>

#include <sstream>
#include <tuple>

#include "tests/unit/grain_packed.hpp"

namespace {

using namespace grain;
namespace test = crossgrain::test;

std::string saved(const Simulation& simulation) {
  std::ostringstream out;
  simulation.save(out);
  return out.str();
}

void restore(Simulation& simulation, const std::string& bytes) {
  std::istringstream in(bytes);
  simulation.restore(in);
}

grain::Setup scene(Precision precision = Precision::float64) {
  grain::Setup setup = test::packed(10, 3);
  setup.precision = precision;
  setup.bottom = test::thesisBottom<Bottom>(2e-3);
  return setup;
}

class Checkpoint : public testing::TestWithParam<std::tuple<Precision, std::uint64_t>> {};

// At the start, between rebuilds, and one step before, at and after disks are renumbered.
INSTANTIATE_TEST_SUITE_P(Moments, Checkpoint,
                         testing::Combine(testing::Values(Precision::float64, Precision::float32),
                                          testing::Values(0, 1, 37, 500, 8191, 8192, 8193, 9000)));

TEST_P(Checkpoint, ARestoredRunGoesOnToTheBit) {
  const auto [precision, moment] = GetParam();
  Simulation whole(scene(precision));
  whole.advance(moment);
  const std::string bytes = saved(whole);

  Simulation fresh(scene(precision)), busy(scene(precision));
  busy.advance(333);  // was somewhere else before
  for (Simulation* restored : {&fresh, &busy}) {
    restore(*restored, bytes);
    EXPECT_EQ(test::difference(*restored, whole), "") << "as restored";
  }
  whole.advance(300);
  for (Simulation* restored : {&fresh, &busy}) {
    restored->advance(300);
    EXPECT_EQ(test::difference(*restored, whole), "");
  }
  whole.advance(8200);  // across a renumbering
  fresh.advance(8200);
  EXPECT_EQ(test::difference(fresh, whole), "");
}

TEST(Checkpoints, OfEveryLawAndIntegratorGoOnToTheBit) {
  for (const Tangential tangential : {Tangential::none, Tangential::coulomb, Tangential::spring})
    for (const Integrator integrator :
         {Integrator::positionVerlet, Integrator::velocityVerlet, Integrator::semiImplicitEuler})
      for (const Damping damping : {Damping::lagged, Damping::predicted, Damping::implicit})
        for (const bool rotation : {false, true})
          for (const bool plate : {false, true}) {
            grain::Setup setup = scene();
            setup.law.tangential = tangential;
            setup.law.damping = damping;
            setup.integrator = integrator;
            setup.rotation = rotation;
            if (!plate) setup.bottom.reset();
            Simulation whole(setup), resumed(setup);
            whole.advance(70);
            restore(resumed, saved(whole));
            whole.advance(70);
            resumed.advance(70);
            EXPECT_EQ(test::difference(resumed, whole), "");
          }
}

TEST(Checkpoints, MayBeTakenWithOtherSkinsAndThreads) {
  grain::Setup other = scene();
  other.skin = 0.7 * test::smallRadius;
  other.threads = 2;
  Simulation whole(scene()), resumed(other);
  whole.advance(250);
  restore(resumed, saved(whole));
  whole.advance(100);
  resumed.advance(100);
  EXPECT_EQ(test::difference(resumed, whole), "");
}

TEST(Checkpoints, DoNotChangeTheRunTheyAreTakenFrom) {
  Simulation saving(scene()), alone(scene());
  for (int k = 0; k < 40; ++k) {
    saved(saving);
    saving.advance(10);
  }
  alone.advance(400);
  EXPECT_EQ(test::difference(saving, alone), "");
}

/// What restoring into a simulation of `setup` says; "" where it is content.
std::string refusal(grain::Setup setup, const std::string& bytes) {
  Simulation simulation(std::move(setup));
  try {
    restore(simulation, bytes);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

std::string checkpoint() {
  Simulation simulation(scene());
  simulation.advance(20);
  return saved(simulation);
}

TEST(Checkpoints, CutShortOrForeignAreRefused) {
  const std::string bytes = checkpoint();
  EXPECT_EQ(refusal(scene(), bytes), "");
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{7}, std::size_t{40}, bytes.size() / 2, bytes.size() - 1})
    EXPECT_EQ(refusal(scene(), bytes.substr(0, length)), "checkpoint: cut short") << length;
  EXPECT_EQ(refusal(scene(), std::string(bytes.size(), 'x')), "checkpoint: not one of this engine");
}

TEST(Checkpoints, OfASceneWithOtherArraysAreRefused) {
  const std::string bytes = checkpoint();
  EXPECT_EQ(refusal(scene(Precision::float32), bytes), "checkpoint: of another precision");
  const auto without = [&](auto&& change) {
    grain::Setup setup = scene();
    change(setup);
    return refusal(std::move(setup), bytes);
  };
  const char* another = "checkpoint: of another setup";
  EXPECT_EQ(without([](auto& s) { s = test::packed(11, 3); }), another);
  EXPECT_EQ(without([](auto& s) { s.bottom.reset(); }), another);
  EXPECT_EQ(without([](auto& s) { s.rotation = false; }), another);
  EXPECT_EQ(without([](auto& s) { s.law.tangential = Tangential::none; }), another);
  EXPECT_EQ(without([](auto& s) { s.walls.pop_back(); }), another);
}

// Arrays of the same sizes, yet another future.
TEST(Checkpoints, OfASceneWithOtherConstantsAreRefused) {
  const std::string bytes = checkpoint();
  const auto changed = [&](auto&& change) {
    grain::Setup setup = scene();
    change(setup);
    return refusal(std::move(setup), bytes);
  };
  const char* another = "checkpoint: of another setup";
  EXPECT_EQ(changed([](auto& s) { s.walls.erase(s.walls.begin()); }), another);  // planes only
  EXPECT_EQ(changed([](auto& s) { s.dt = 2e-5; }), another);
  EXPECT_EQ(changed([](auto& s) { s.law.kn *= 2.0; }), another);
  EXPECT_EQ(changed([](auto& s) { s.law.mu = 0.1; }), another);
  EXPECT_EQ(changed([](auto& s) { s.law.lever = Lever::contactPoint; }), another);
  EXPECT_EQ(changed([](auto& s) { s.law.tangential = Tangential::spring; }), another);
  EXPECT_EQ(changed([](auto& s) { s.bottom->mu = 1e-3; }), another);
  EXPECT_EQ(changed([](auto& s) { s.disks.radius[3] *= 1.01; }), another);
  EXPECT_EQ(changed([](auto& s) { s.disks.mass[3] *= 1.01; }), another);
  EXPECT_EQ(changed([](auto& s) { s.integrator = Integrator::velocityVerlet; }), another);
}

}  // namespace
