#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "tests/support/refusal.hpp"
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
  setup.bottom = test::thesisBottom<BottomPlate>(2e-3);
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
  for (const TangentialLaw tangential :
       {TangentialLaw::none, TangentialLaw::coulomb, TangentialLaw::spring})
    for (const Integrator integrator :
         {Integrator::positionVerlet, Integrator::velocityVerlet, Integrator::semiImplicitEuler})
      for (const DampingVelocity damping :
           {DampingVelocity::lagged, DampingVelocity::predicted, DampingVelocity::implicit})
        for (const bool rotation : {false, true})
          for (const bool plate : {false, true}) {
            grain::Setup setup = scene();
            setup.law.tangential = tangential;
            setup.law.conventions.dampingVelocity = damping;
            setup.law.conventions.integrator = integrator;
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

/// Error of restoring into a simulation of `setup`; "" where it succeeds.
std::string refusal(grain::Setup setup, const std::string& bytes) {
  Simulation simulation(std::move(setup));
  return test::refusalOf<std::runtime_error>([&] { restore(simulation, bytes); });
}

std::string checkpoint() {
  return saved(test::advanced(scene(), 20));
}

TEST(Checkpoints, CutShortOrForeignAreRefused) {
  const std::string bytes = checkpoint();
  EXPECT_EQ(refusal(scene(), bytes), "");
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{7}, std::size_t{40}, bytes.size() / 2, bytes.size() - 1})
    EXPECT_EQ(refusal(scene(), bytes.substr(0, length)), "checkpoint: cut short") << length;
  EXPECT_EQ(refusal(scene(), std::string(bytes.size(), 'x')), "checkpoint: not one of this engine");
}

TEST(Checkpoints, OfAnotherScene_AreRefused) {
  const std::string bytes = checkpoint();
  EXPECT_EQ(refusal(scene(Precision::float32), bytes), "checkpoint: of another precision");
  using Change = void (*)(grain::Setup&);
  for (const Change change : std::initializer_list<Change>{
           // Other arrays.
           [](auto& s) { s = test::packed(11, 3); }, [](auto& s) { s.bottom.reset(); },
           [](auto& s) { s.rotation = false; },
           [](auto& s) { s.law.tangential = TangentialLaw::none; },
           [](auto& s) { s.walls.pop_back(); },
           // Arrays of the same sizes, yet another future.
           [](auto& s) { s.walls.erase(s.walls.begin()); },  // planes only
           [](auto& s) { s.dt = 2e-5; }, [](auto& s) { s.law.kn *= 2.0; },
           [](auto& s) { s.law.mu = 0.1; },
           [](auto& s) { s.law.conventions.leverArm = LeverArm::contactPoint; },
           [](auto& s) { s.law.tangential = TangentialLaw::spring; },
           [](auto& s) { s.bottom->mu = 1e-3; }, [](auto& s) { s.disks.radius[3] *= 1.01; },
           [](auto& s) { s.disks.mass[3] *= 1.01; },
           [](auto& s) { s.law.conventions.integrator = Integrator::velocityVerlet; }}) {
    grain::Setup setup = scene();
    change(setup);
    EXPECT_EQ(refusal(std::move(setup), bytes), "checkpoint: of another setup");
  }
}

/// Where two simulations have come to, of those of one setup [m].
double apart(const Simulation& one, const Simulation& other) {
  double most = 0.0;
  for (std::size_t i = 0; i < one.movingCount(); ++i)
    most = std::max(most, std::hypot(one.x(i) - other.x(i), one.y(i) - other.y(i)));
  return most;
}

/// Its walls stand still: they are where they were at the beginning.
Setup packedAtRest() {
  Setup setup = test::packed(10, 3);
  setup.walls.pop_back();  // the wheel
  for (Wall& wall : setup.walls) wall = test::standing(wall.planes);
  return setup;
}

/// A run begun from what another one shows: under way, or with relaxed springs.
Simulation begunFrom(const Simulation& seen, Setup setup, bool underWay) {
  for (std::size_t i = 0; i < seen.movingCount(); ++i) {
    setup.disks.x[i] = seen.x(i);
    setup.disks.y[i] = seen.y(i);
    setup.disks.vx[i] = seen.velocityX(i);
    setup.disks.vy[i] = seen.velocityY(i);
    setup.disks.spin[i] = seen.spin(i);
  }
  Simulation begun(std::move(setup));
  if (underWay) begun.beginUnderWay(seen.contacts());
  return begun;
}

/// How far both of them are from a run that goes on, 25 steps later [m].
std::pair<double, double> farFromGoingOn(const Setup& setup) {
  Simulation whole(setup);
  whole.advance(500);
  Simulation warm = begunFrom(whole, setup, true), cold = begunFrom(whole, setup, false);
  for (Simulation* run : {&whole, &warm, &cold}) run->advance(25);
  return {apart(warm, whole), apart(cold, whole)};
}

TEST(BeginUnderWay, GoesOnToRounding) {
  using enum Integrator;
  for (const auto& [integrator, damping] : {std::pair(semiImplicitEuler, DampingVelocity::lagged),
                                            std::pair(positionVerlet, DampingVelocity::lagged),
                                            std::pair(positionVerlet, DampingVelocity::implicit),
                                            std::pair(velocityVerlet, DampingVelocity::lagged)})
    for (const SpringUpdate stretch :
         {SpringUpdate::after, SpringUpdate::before, SpringUpdate::midpoint})
      for (const bool hertz : {false, true})
        for (const bool outside : {false, true}) {
          grain::Setup setup = packedAtRest();
          setup.law.conventions.integrator = integrator;
          setup.law.conventions.dampingVelocity = damping;
          setup.law.conventions.springUpdate = stretch;
          setup.law.conventions.dashpot = outside ? Dashpot::outside : Dashpot::inside;
          setup.law.conventions.history = outside ? History::force : History::displacement;
          if (outside != hertz) {
            setup.law.rolling = RollingLaw::spring;
            setup.law.kr = 0.1 * setup.law.kn;
            setup.law.gr = 0.1 * setup.law.gn;
            setup.law.muR = 0.05;
          }
          if (hertz) {
            setup.law.normal = NormalLaw::hertz;
            setup.law.kn *= 1e3;
            setup.law.kt *= 1e3;
          }
          const auto [warm, cold] = farFromGoingOn(setup);
          EXPECT_LT(warm, 1e-13) << static_cast<int>(integrator) << static_cast<int>(damping)
                                 << static_cast<int>(stretch) << hertz << outside;
          EXPECT_GT(cold, 1e-8);
        }
}

/// Predicted velocities need the forces of a step before, which no contact shows any more.
TEST(BeginUnderWay, PredictedDamping_GoesOnNearly) {
  const auto [warm, cold] = farFromGoingOn(packedAtRest());
  EXPECT_LT(warm, 1e-2 * cold);
}

TEST(BeginUnderWay, AfterAStep_Throws) {
  Simulation run(test::packed(6, 3));
  run.step();
  EXPECT_THROW(run.beginUnderWay({}), std::logic_error);
}

}  // namespace
