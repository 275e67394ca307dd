#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "averaging/global.hpp"
#include "averaging/statistics.hpp"
#include "averaging/wall_balance.hpp"
#include "cases/couette.hpp"
#include "studies/flow/run.hpp"
#include "tests/studies/quick_cell.hpp"

namespace {

using namespace crossgrain;

/// The quick cell without a bottom plate, six tenths of a rotation after half a one of preparation.
/// How a small cell flows is chaotic, and stresses in one packing vary by a factor of ten: what is
/// tested holds at every instant, or of several packings together.
class ShearedCell : public testing::Test {
 protected:
  static constexpr int packings = 4, blocks = 12, snapshotsPerBlock = 20;

  struct Block {
    std::vector<Profile> profiles;
    double torque;       ///< that drives the wheel [N m]
    double pressure;     ///< on the outer ring [N/m²]
    double along, hoop;  ///< WallBalance [N/m²]
  };

  static void SetUpTestSuite() {
    setup_ = test::quickCell({"bottom.mu=0.0", "preparation.rotations=0.5", "preparation.seed=3"});
    for (int packing = 0; packing < packings; ++packing) shear(packing);
  }

  static void shear(int index) {
    const double dt = timeStep(setup_);
    const auto engine = makeGrain();
    const Packing packing = preparePacking(setup_, index, dt, *engine, [](double) {});
    const Scene scene = couetteScene(setup_, packing, dt);
    engine->load(scene, {});
    const double rotation = rotationTime(setup_);
    int k = 0;
    for (int block = 0; block < blocks; ++block) {
      ProfileAccumulator accumulator(ringsOf(setup_), {WeightMethod::slicing}, scene);
      std::vector<double> torque, pressure, along, hoop;
      for (int s = 0; s < snapshotsPerBlock; ++s) {
        engine->advance((0.1 + 0.5 * ++k / (blocks * snapshotsPerBlock)) * rotation);
        const Snapshot now = engine->snapshot(ContactReport::instant);
        accumulator.add(now);
        torque.push_back(*drivingTorque(scene, now, wheelName));
        pressure.push_back(*radialPressure(scene, now, ringName, couetteIn(setup_).cell.outerRadius,
                                           couetteIn(setup_).cell.height));
        const WallBalance wall = *outerWallBalance(ringsOf(setup_), scene, now);
        along.push_back(wall.alongBranches);
        hoop.push_back(wall.hoopTerm);
      }
      blocks_.push_back(
          {accumulator.profiles(), meanOf(torque), meanOf(pressure), meanOf(along), meanOf(hoop)});
    }
  }

  static double meanOf(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  }

  static double valueIn(const Block& block, const std::string& field, int ring) {
    return *std::ranges::find(block.profiles, field, &Profile::field)
                ->mean[static_cast<std::size_t>(ring)];
  }

  /// Mean of a field in a ring over all packings.
  static double mean(const std::string& field, int ring) {
    std::vector<double> values;
    for (const Block& block : blocks_) values.push_back(valueIn(block, field, ring));
    return meanOf(values);
  }

  static inline Case setup_;
  static inline std::vector<Block> blocks_;
};

TEST_F(ShearedCell, EveryRing_CarriesTheWheelsTorque) {
  // Without bottom friction (σ_φr + m v_r v_φ/V)·2πr²h = T at every ring, but for what spins up the
  // disks within it: a difference that averages out however much the torque itself varies.
  const Rings rings = ringsOf(setup_);
  double wheel = 0.0;
  for (const Block& block : blocks_) wheel += std::abs(block.torque) / (packings * blocks);
  for (int ring = 0; ring < rings.count(); ++ring) {
    const double r = rings.centre(ring);
    const double factor = 2.0 * std::numbers::pi * r * r * rings.height();
    // With the disks' couples, which are a few per cent of it, and without.
    for (const double couples : {0.0, 1.0}) {
      std::vector<double> differences;
      for (const Block& block : blocks_)
        differences.push_back((valueIn(block, "stress_pr", ring) +
                               valueIn(block, "dynamic_stress_rp", ring) +
                               couples * valueIn(block, "couple_stress_zr", ring) / r) *
                                  factor -
                              block.torque);
      const MeanEstimate difference = estimateMean(differences);
      // Three bars, and 4 % = (d/r)² at the wheel: σ ∝ r⁻² bends over a ring and over a disk.
      EXPECT_NEAR(difference.mean, 0.0, 3.0 * *difference.standardError + 0.04 * wheel)
          << "ring " << ring + 1;
      // Bars so wide that anything fits would prove nothing.
      EXPECT_LT(*difference.standardError, 0.15 * wheel) << "ring " << ring + 1;
    }
  }
}

TEST_F(ShearedCell, OutermostRing_HasThePressureOfTheWall) {
  // Along branches σ̄_rr = P R_o/r_m − hoop term, but for what accelerates, which averages out.
  const Rings rings = ringsOf(setup_);
  const int outermost = rings.count() - 1;
  const double nearer = rings.outerRadius() / rings.centre(outermost);
  std::vector<double> differences;
  double wall = 0.0, along = 0.0;
  for (const Block& block : blocks_) {
    differences.push_back(block.along - (block.pressure * nearer - block.hoop));
    wall += block.pressure / (packings * blocks);
    along += block.along / (packings * blocks);
  }
  const MeanEstimate difference = estimateMean(differences);
  EXPECT_NEAR(difference.mean, 0.0, 3.0 * *difference.standardError + 0.003 * wall);
  EXPECT_LT(*difference.standardError, 0.01 * wall);
  // Slicing spreads the stress of the disks at the wall over their area: up to 6 % more in the
  // ring.
  EXPECT_GT(mean("stress_rr", outermost), along);
  EXPECT_LT(mean("stress_rr", outermost), 1.06 * along);
}

TEST_F(ShearedCell, Shear_LiesInABandAtTheWheel) {
  const double rim = couetteIn(setup_).cell.omega * couetteIn(setup_).cell.innerRadius;
  EXPECT_GT(mean("azimuthal_velocity", 0), 0.15 * rim);
  EXPECT_LT(mean("azimuthal_velocity", 0), rim);
  EXPECT_LT(mean("azimuthal_velocity", 2), 0.4 * mean("azimuthal_velocity", 0));
  // The first layer rolls backwards on the wheel (claim C8), at Ω D/d = 8 rad/s at most.
  EXPECT_LT(mean("spin", 0), -0.5);
}

TEST_F(ShearedCell, FabricTrace_IsVolumeFractionTimesCoordination) {
  // Also of time means, since C is the mean weighted with volume.
  for (const Block& block : blocks_)
    for (int ring = 0; ring < 6; ++ring) {
      const double trace = valueIn(block, "fabric_trace", ring);
      EXPECT_NEAR(trace,
                  valueIn(block, "volume_fraction", ring) * valueIn(block, "coordination", ring),
                  1e-12 * trace);
    }
}

}  // namespace
