// Engines that are right but for one planted thing, held against their mirrors.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "adapters/grain.hpp"
#include "adapters/registry.hpp"
#include "cases/loader.hpp"
#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "runs/lockstep/comparison.hpp"
#include "runs/lockstep/rules.hpp"
#include "tests/runs/planted_engine.hpp"

namespace {

using namespace crossgrain;

/// The quick cell, one packing, made once for all tests.
class Lockstep : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    setup_ = new Case(loadCase(CROSSGRAIN_CASES "/couette/quick.toml", {}).front());
    dt_ = timeStep(*setup_);
    const auto engine = makeGrain();
    const auto nobody = [](double) {};
    packings_ = new std::vector{packingOf(*setup_, 0, dt_, *engine, nobody)};
    states_ = new std::vector(statesAlongTheFlow(*setup_, *packings_, dt_, 4, nobody));
  }
  static void TearDownTestSuite() {
    delete setup_;
    delete packings_;
    delete states_;
  }

  static LockstepRow rowOf(std::function<void(Scene&)> fault) {
    test::PlantedEngine engine(std::move(fault));
    const EngineEntry entry{"planted", "", makeGrain, {}, {}, ""};
    return holdAgainstMirror(engine, entry, *setup_, *states_, dt_, [](double) {});
  }

  static inline Case* setup_ = nullptr;
  static inline std::vector<Packing>* packings_ = nullptr;
  static inline std::vector<FlowState>* states_ = nullptr;
  static inline double dt_ = 0.0;
};

TEST_F(Lockstep, StatesLieInEqualPartsOfTheFlowAndAreTheSameEachTime) {
  ASSERT_EQ(states_->size(), 4u);
  const double part = startSteps * dt_ / 4.0;
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_GE((*states_)[k].start.time, part * static_cast<double>(k) - dt_);
    EXPECT_LE((*states_)[k].start.time, part * static_cast<double>(k + 1) + dt_);
    EXPECT_NE((*states_)[k].packing.hash, packings_->front().hash);
  }
  EXPECT_GT((*states_)[3].start.wheelAngle, (*states_)[0].start.wheelAngle);
  const auto again = statesAlongTheFlow(*setup_, *packings_, dt_, 4, [](double) {});
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(again[k].packing.hash, (*states_)[k].packing.hash);
}

TEST_F(Lockstep, WithoutAFaultNothingParts) {
  const LockstepRow row = rowOf([](Scene&) {});
  EXPECT_EQ(row.verdict, LockstepVerdict::sameToRounding);
  EXPECT_EQ(row.starts, 4u);
  EXPECT_EQ(row.track.back(), 0.0);
  EXPECT_EQ(row.forces->normal, 0.0);
  EXPECT_FALSE(row.first);
  EXPECT_FALSE(row.term);
  const ContactKinds& kinds = row.kinds;
  for (const std::size_t count :
       {kinds.sticking, kinds.sliding, kinds.made, kinds.opened, kinds.wall})
    EXPECT_GT(count, 0u);
}

struct Fault {
  const char* what;
  std::function<void(Scene&)> plant;
  const char* term;
  std::optional<double> amount;
};

/// Each is found, put down to the term that is off, and its amount told: to first order, so that of
/// a part x of a constant a part of the order of x of the amount itself may be wrong.
TEST_F(Lockstep, NamesWhatIsOff) {
  const auto times = [](double ContactLaw::*constant, double factor) {
    return [=](Scene& scene) { scene.law.*constant *= factor; };
  };
  const std::vector<Fault> faults = {
      {"k_n + 1e-4", times(&ContactLaw::kn, 1.0001), "kn", 1e-4},
      {"k_n - 1e-4", times(&ContactLaw::kn, 0.9999), "kn", -1e-4},
      {"mu + 1e-4", times(&ContactLaw::mu, 1.0001), "mu", 1e-4},
      {"mu - 1e-4", times(&ContactLaw::mu, 0.9999), "mu", -1e-4},
      {"half of gamma_t", times(&ContactLaw::gt, 0.5), "gt", -0.5},
      {"tension cut",
       [](Scene& scene) { scene.law.conventions.tension = Tension::cut; },
       "tension = cut",
       {}},
      {"dashpot outside the bound",
       [](Scene& scene) { scene.law.conventions.dashpot = Dashpot::outside; },
       "dashpot = outside",
       {}},
      {"spheres' inertia",
       [](Scene& scene) {
         for (double& inertia : scene.disks.inertia) inertia *= 0.8;
       },
       "inertia", -0.2},
      {"plate + 10 %", [](Scene& scene) { scene.bottom->mu *= 1.1; }, "plate mu", 0.1},
      {"no plate", [](Scene& scene) { scene.bottom.reset(); }, "without bottom_friction", {}}};
  for (const Fault& fault : faults) {
    const LockstepRow row = rowOf(fault.plant);
    ASSERT_TRUE(row.first) << fault.what;
    EXPECT_NE(row.verdict, LockstepVerdict::sameToRounding) << fault.what;
    ASSERT_TRUE(row.term) << fault.what;
    EXPECT_EQ(row.term->name, fault.term) << fault.what << " leaves " << row.term->unexplained;
    if (fault.amount) {
      EXPECT_NEAR(*row.term->amount / *fault.amount, 1.0, 0.01 + std::abs(*fault.amount))
          << fault.what;
    }
  }
}

TEST_F(Lockstep, TellsByHowMuch) {
  const auto kn = [](double by) { return [by](Scene& scene) { scene.law.kn *= 1.0 + by; }; };
  const LockstepRow little = rowOf(kn(3e-5)), more = rowOf(kn(0.03));
  EXPECT_EQ(little.verdict, LockstepVerdict::sameLaw);
  EXPECT_EQ(more.verdict, LockstepVerdict::differs);
  // At the first time told no contact has been made or broken at another step yet.
  EXPECT_NEAR(*little.separations.front().equivalent / 3e-5, 1.0, 0.1);
  EXPECT_NEAR(*more.separations.front().equivalent / 0.03, 1.0, 0.1);
}

TEST_F(Lockstep, FindsAContactThatIsNotThere) {
  // One disk of the first start is a little smaller, so that it lets go of what it touched.
  const LockstepRow row = rowOf([](Scene& scene) { scene.disks.radius[7] *= 0.99; });
  EXPECT_NE(row.verdict, LockstepVerdict::sameToRounding);
  ASSERT_TRUE(row.forces);
  EXPECT_GT(row.forces->missing, 0u);
}

/// A dashpot of the wrong sign drives what it touches until it is stopped: that is a failure, told.
TEST_F(Lockstep, AnEngineThatBlowsUpFails) {
  const LockstepRow row = rowOf([](Scene& scene) { scene.law.gt *= -1.0; });
  EXPECT_EQ(row.verdict, LockstepVerdict::notMeasured);
  EXPECT_NE(row.failure.find("overlap"), std::string::npos) << row.failure;
  EXPECT_EQ(row.reason, row.failure);
}

/// An engine that dies is told, with what it did until then.
TEST_F(Lockstep, KeepsWhatAnEngineDidBeforeItFailed) {
  int loads = 0;
  const LockstepRow row = rowOf([&](Scene&) {
    if (++loads == 3) throw EngineFailure("gone");
  });
  EXPECT_EQ(row.starts, 2u);
  EXPECT_EQ(row.failure, "gone");
  EXPECT_EQ(row.verdict, LockstepVerdict::sameToRounding);
}

}  // namespace
