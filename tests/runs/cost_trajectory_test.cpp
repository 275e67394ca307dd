#include "runs/cost/trajectory.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "adapters/grain.hpp"
#include "cases/couette.hpp"
#include "cases/preparation.hpp"
#include "results/cost_fields.hpp"
#include "runs/cost/equivalents.hpp"
#include "runs/cost/limits.hpp"
#include "tests/runs/cost_cases.hpp"

namespace {

using namespace crossgrain;

std::vector<Separation> exponential(double rate, double noise) {
  std::vector<Separation> growing;
  for (int k = 0; k <= 100; ++k)
    growing.push_back({0.01 * k, 1e-10 * std::exp(rate * 0.01 * k + noise * std::sin(7.0 * k))});
  return growing;
}

TEST(CostGrowth, AnExponentialsExponentComesBack) {
  const Growth growth = fitGrowth(exponential(12.0, 0.0), 1e-3);
  EXPECT_NEAR(*growth.exponent, 12.0, 1e-9);
  EXPECT_LT(*growth.standardError, 1e-6);
  const Growth noisy = fitGrowth(exponential(12.0, 0.3), 1e-3);
  EXPECT_NEAR(*noisy.exponent, 12.0, 4.0 * *noisy.standardError);
  EXPECT_GT(*noisy.standardError, 0.01);
  EXPECT_FALSE(fitGrowth(exponential(-1.0, 0.0), 1e-3).exponent);
  EXPECT_FALSE(fitGrowth({}, 1e-3).exponent);
}

TEST(CostGrowth, TheWindowEndsWhereTheReferenceIsOff) {
  // e^(10 (t − 0.1)) from 1e-6 to 1e-3 takes ln(1000)/10 = 0.69 s more; in whole units of 0.05 s.
  const Window window = trajectoryWindow({10.0, 0.1}, 1e-6, 0.1, 1e-3, 0.05, 5.0);
  EXPECT_NEAR(window.length, 0.75, 1e-12);
  EXPECT_NEAR(trajectoryWindow({10.0, 0.1}, 1e-6, 0.1, 1e-3, 0.05, 0.2).length, 0.2, 1e-12);
  EXPECT_NEAR(trajectoryWindow({10.0, 0.1}, 1.0, 0.02, 1e-3, 0.05, 0.2).length, 0.05, 1e-12);
  EXPECT_NEAR(trajectoryWindow({}, 1e-6, 0.1, 1e-3, 0.05, 0.2).length, 0.2, 1e-12);
}

TEST(CostGrowth, APerturbationHasTheSizeAskedForAndIsAlwaysTheSame) {
  Scene scene;
  scene.disks.position.assign(50, Vec2::Zero());
  const Scene one = perturbed(scene, 0.25), other = perturbed(scene, 0.25);
  EXPECT_NEAR(rmsDistance(one.disks.position, scene.disks.position, 0.5), 0.5, 1e-12);
  EXPECT_EQ(one.disks.position, other.disks.position);
}

TEST(CostGrowth, APerturbationHasNoDirection) {
  Scene scene;
  scene.disks.position.assign(400, Vec2::Zero());
  const Scene moved = perturbed(scene, 1.0);
  int above = 0, right = 0;
  for (const Vec2& position : moved.disks.position) {
    above += position.y() > 0.0;
    right += position.x() > 0.0;
  }
  EXPECT_NEAR(above, 200, 40);  // ± 10 each
  EXPECT_NEAR(right, 200, 40);
}

/// A packing that needs no preparation: disks on a lattice between the walls, each moving.
class LatticeInTheCell : public testing::Test {
 protected:
  void SetUp() override {
    Disks disks = diskKinds(setup_.particles);
    disks.position.clear();
    const double spacing = 2.02 * setup_.particles.largeRadius;
    for (int row = -9; row <= 9; ++row)
      for (int column = -9; column <= 9; ++column) {
        const Vec2 at((column + 0.5 * (row & 1)) * spacing, row * 0.87 * spacing);
        const double margin = setup_.particles.largeRadius + setup_.cell.wallRadius;
        if (at.norm() < setup_.cell.innerRadius + margin ||
            at.norm() > setup_.cell.outerRadius - margin)
          continue;
        disks.position.push_back(at);
        disks.velocity.push_back({0.02 * std::sin(3.0 * row + column), 0.02 * std::cos(column)});
      }
    const std::size_t count = disks.position.size();
    disks.velocity.erase(disks.velocity.begin(),
                         disks.velocity.end() - static_cast<std::ptrdiff_t>(count));
    for (auto* list : {&disks.radius, &disks.mass, &disks.inertia, &disks.spin})
      list->resize(count, 0.0);
    packing_.disks = disks;
  }

  Track follow(const std::string& fragment, double time) {
    const Case setup = test::costCase(fragment);
    const auto engine = makeGrain();
    return followPacking(*engine, test::inHouse, setup,
                         couetteScene(setup, packing_, timeStep(setup)), {time});
  }

  static double timeStep(const Case& setup) {
    return setup.run.dt ? *setup.run.dt : costContactTime(setup) / setup.run.stepsPerContact;
  }

  Case setup_ = test::costCase();
  Packing packing_;
};

TEST_F(LatticeInTheCell, SkinChangesTheTimeOnly) {
  const Track tuned = follow("", 0.1);
  for (const char* const skin : {"5e-5", "1e-3", "4e-3"})
    EXPECT_EQ(follow(std::string("[engines.grain]\nskin = ") + skin, 0.1).positions,
              tuned.positions)
        << skin;
}

TEST_F(LatticeInTheCell, ErrorsFallWithTheStep) {
  const double contact = costContactTime(setup_);
  const auto reference = follow("[run]\nsteps_per_contact = 800", 100.0 * contact);
  const auto errorAt = [&](const char* steps) {
    return rmsDistance(follow(std::string("[run]\nsteps_per_contact = ") + steps, 100.0 * contact)
                           .positions.front(),
                       reference.positions.front(), 2.0 * setup_.particles.smallRadius);
  };
  EXPECT_LT(errorAt("100"), 0.5 * errorAt("20"));
  EXPECT_GT(errorAt("100"), 0.0);
}

/// ε_eq of a run with k_n + 1 % is 1 %, and of one at another step less the nearer that is.
TEST_F(LatticeInTheCell, AChangeOfStiffnessIsItsOwnEquivalent) {
  const double diameter = 2.0 * setup_.particles.smallRadius;
  const std::vector<double> times = windowTimes(setup_);
  ASSERT_EQ(times.size(), 3u);  // 1, 5 and 23 t_c of 2.18 ms
  EXPECT_NEAR(times[1], 5.0 * costContactTime(setup_), 1e-12);
  const auto engine = makeGrain();
  const std::vector<FlowState> states = {{{}, packing_}};
  const auto at = [&](double steps, double stiffer) {
    Case setup = setup_;
    setup.run.dt = costContactTime(setup_) / steps;
    setup.law.kn *= 1.0 + stiffer;
    return setup;
  };
  const auto follow = [&](double steps, double stiffer) {
    return followStarts(*engine, test::inHouse, at(steps, stiffer), states, times);
  };
  const auto reference = follow(200, 0.0);
  const Scene scene = couetteScene(setup_, packing_, costContactTime(setup_) / 200);
  const auto responses = windowResponses(*engine, {scene}, times, diameter);
  const auto equivalent = [&](const std::vector<Track>& tracks) {
    return equivalentOf(tracks, reference, responses, diameter);
  };
  EXPECT_EQ(equivalent(reference).value_or(0.0), 0.0);
  EXPECT_NEAR(*equivalent(follow(200, 0.01)), 0.01, 0.002);
  EXPECT_LT(*equivalent(follow(100, 0.0)), *equivalent(follow(20, 0.0)));
}

TEST_F(LatticeInTheCell, APackingThatBlowsUpSaysSo) {
  const auto expectFailure = [&](const std::string& fragment, const std::string& words) {
    try {
      follow(fragment, 0.5);
      FAIL() << "a step of t_c bore the packing";
    } catch (const std::runtime_error& failure) {
      EXPECT_NE(std::string(failure.what()).find(words), std::string::npos) << failure.what();
    }
  };
  // Of an engine that does not see it by itself, and of one that does.
  expectFailure("[run]\ndt = 2e-3\n[engines.grain]\nmax_overlap = 0", beyondLimit);
  expectFailure("[run]\ndt = 2e-3", "overlap by");
}

TEST_F(LatticeInTheCell, SeparationGrowsAndDoesSoAgain) {
  setup_.cost.growthTime = 1.5;
  const auto engine = makeGrain();
  const Case fine = test::costCase("[run]\nsteps_per_contact = 200");
  const Case coarse = test::costCase("[run]\nsteps_per_contact = 100");
  const ChaosStudy study = studyChaos(*engine, test::inHouse, setup_, fine, coarse, packing_);
  EXPECT_GT(study.separations.back().value, 1e3 * setup_.cost.perturbation);
  ASSERT_TRUE(study.growth.exponent);
  EXPECT_GT(*study.growth.exponent, 3.0 * *study.growth.standardError);
  EXPECT_GT(study.window.length, 0.0);
  EXPECT_EQ(jsonOf(study),
            jsonOf(studyChaos(*engine, test::inHouse, setup_, fine, coarse, packing_)));
}

}  // namespace
