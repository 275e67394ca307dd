#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "tests/unit/grain_packed.hpp"

namespace {

using namespace grain;
namespace test = crossgrain::test;

constexpr double weight = test::thesis.kn * 1e-7;  // presses an overlap of 1e-7 m [N]

/// A disk that its weight holds against one partner at the place (x, y), to the right of it.
grain::Setup pressed(double x, double y, double gap, Precision precision) {
  grain::Setup setup;
  setup.law = test::thesisLaw();
  setup.precision = precision;
  setup.dt = 4e-5;
  setup.gravityX = -weight / test::smallMass;
  test::addDisk(setup.disks, x + gap + test::smallRadius, y, 0.0, 0.0, 0.0);
  return setup;
}

/// How many diameters from the origin.
class FarFromTheOrigin : public testing::TestWithParam<std::tuple<double, Precision>> {
 protected:
  double far() const { return 2.0 * test::smallRadius * std::get<0>(GetParam()); }
  Precision precision() const { return std::get<1>(GetParam()); }

  /// Single: local coordinates below 2^-7 m are rounded by ρ = 2.3e-10 m, and so are distance and
  /// reach. A disk that creeps by less than ρ a step stays where it is, held by its dashpot:
  /// k_n Δδ = γ_n ρ/dt, so Δδ = 13 ρ = 3e-9 m. Together less than 5 % of 1e-7 m.
  /// Double: 740 m are rounded by 6e-14 m, and this is the same 14 times.
  double tolerance() const { return precision() == Precision::float32 ? 5e-9 : 1e-12; }
};

INSTANTIATE_TEST_SUITE_P(Diameters, FarFromTheOrigin,
                         testing::Combine(testing::Values(3.0, 1e3, 0.97e5),
                                          testing::Values(Precision::float64, Precision::float32)));

TEST_P(FarFromTheOrigin, AnOverlapComesToRestWhereItsForceIsTheWeight) {
  const double x = far(), y = -0.7 * far();
  Wall plane = test::standing({{x, y, 1.0, 0.0}}), disk = test::standing({});
  disk.diskX = {x - test::smallRadius};
  disk.diskY = {y};
  disk.diskRadius = {test::smallRadius};
  for (const Wall& wall : {disk, plane}) {
    auto setup = pressed(x, y, 1e-5, precision());  // falls 0.01 mm, then settles
    setup.walls = {wall};
    const Simulation simulation = test::advanced(std::move(setup), 10000);
    ASSERT_EQ(simulation.contacts().size(), 1u);
    const Contact& contact = simulation.contacts()[0];
    EXPECT_NEAR(contact.overlap, 1e-7, tolerance());
    EXPECT_NEAR(contact.normalForce, weight, test::thesis.kn * tolerance());
  }
}

TEST_P(FarFromTheOrigin, ADiskStartsThereAndFliesThere) {
  // 3 m in 10 000 steps, past a renumbering, which gives it a new origin.
  auto setup = pressed(far(), 0.0, 0.0, precision());
  setup.dt = 1e-3;
  setup.gravityX = 0.0;
  setup.disks.x[0] = far() - 3.0;
  setup.disks.vx[0] = 0.3;
  const Simulation simulation = test::advanced(setup, 10000);
  // A step's way is added to coordinates that grow to 2.5 m before the new origin, rounded by up to
  // 1.2e-7 m each time; the step itself, 3e-4 m, by 1.5e-11 m.
  const double rounding = precision() == Precision::float32 ? 1.2e-7 : 6e-14;
  EXPECT_NEAR(simulation.x(0), far(), 10000 * rounding);
  auto& born = setup.disks;
  born.x[0] = far();
  EXPECT_NEAR(Simulation(setup).x(0), far(), precision() == Precision::float32 ? 3e-10 : 0.0);
}

struct Totals {
  double px = 0.0, py = 0.0, energy = 0.0, momenta = 0.0;
};

Totals totals(const Simulation& s, const std::vector<double>& masses) {
  Totals t;
  for (std::size_t i = 0; i < s.movingCount(); ++i) {
    t.px += masses[i] * s.velocityX(i);
    t.py += masses[i] * s.velocityY(i);
    t.momenta += masses[i] * std::hypot(s.velocityX(i), s.velocityY(i));
  }
  t.energy = s.kineticEnergy() + s.elasticEnergy();
  return t;
}

TEST(SinglePrecision, KeepsMomentumAndEnergyOfACollidingCrowd) {
  const auto setup = [](Precision precision) {
    auto crowd = test::crowd(12, 7, 4e-5);
    crowd.precision = precision;
    return crowd;
  };
  const auto masses = setup(Precision::float64).disks.mass;
  Simulation single(setup(Precision::float32)), reference(setup(Precision::float64));
  const Totals before = totals(single, masses);
  constexpr int steps = 400;
  single.advance(steps);
  reference.advance(steps);
  const Totals after = totals(single, masses), wanted = totals(reference, masses);
  ASSERT_GT(single.contactEvaluations(), 5000u);
  ASSERT_LT(wanted.energy, 0.8 * totals(Simulation(setup(Precision::float64)), masses).energy);
  // Momentum: each velocity is rounded by 2^-24 in each of 400 steps, at random.
  const double rounding = 0x1p-24 * std::sqrt(steps * 144.0) * before.momenta / 144.0;
  EXPECT_NEAR(after.px, before.px, 10.0 * rounding);
  EXPECT_NEAR(after.py, before.py, 10.0 * rounding);
  // Energy: overlaps of some 1e-4 m are rounded by 1e-9 m, so forces by 1e-5, at random over tens
  // of steps in contact.
  EXPECT_NEAR(after.energy, wanted.energy, 1e-5 * wanted.energy);
}

TEST(SinglePrecision, FollowsDoubleThroughTheFirstStepsOfAPacking) {
  auto setup = test::packed(12, 4);
  Simulation reference(setup);
  setup.precision = Precision::float32;
  Simulation single(setup);
  single.advance(50);
  reference.advance(50);
  for (std::size_t i = 0; i < single.movingCount(); ++i) {
    // Coordinates below 2^-6 m are rounded by 1e-9 m in each step; the mean of 50 is sqrt(50) of
    // that, and contacts pass it on.
    EXPECT_NEAR(single.x(i), reference.x(i), 5e-8);
    EXPECT_NEAR(single.y(i), reference.y(i), 5e-8);
  }
}

TEST(SinglePrecision, TellsTheOverlapsThatItsForcesCameFrom) {
  auto setup = test::packed(12, 4);
  setup.precision = Precision::float32;
  setup.law.tangential = TangentialLaw::none;
  setup.law.gn = 0.0;
  const Simulation simulation = test::advanced(setup, 100);
  ASSERT_GT(simulation.contacts().size(), 80u);
  for (const Contact& contact : simulation.contacts()) {
    const bool plane = static_cast<std::size_t>(contact.j) >= simulation.diskCount();
    EXPECT_FLOAT_EQ(static_cast<float>(contact.normalForce),
                    static_cast<float>(test::thesis.kn) * static_cast<float>(contact.overlap))
        << (plane ? "plane" : "pair");
  }
}

}  // namespace
