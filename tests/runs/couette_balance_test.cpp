#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "adapters/grain.hpp"
#include "averaging/fits.hpp"
#include "averaging/global.hpp"
#include "averaging/statistics.hpp"
#include "cases/couette.hpp"
#include "cases/loader.hpp"
#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "runs/couette_run.hpp"

namespace {

using namespace crossgrain;

/// The quick cell without a bottom plate, half a rotation after half a rotation of preparation.
class ShearedCell : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    setup_ = loadCase(std::filesystem::path(CROSSGRAIN_CASES) / "couette/quick.toml",
                      {"bottom.mu=0.0", "preparation.rotations=0.5", "preparation.seed=3"})
                 .front();
    const double dt = timeStep(setup_);
    const auto engine = makeGrain();
    const Packing packing = preparePacking(setup_, 0, dt, *engine, [](double) {});
    const Scene scene = couetteScene(setup_, packing, dt);
    engine->load(scene, {});
    ProfileAccumulator accumulator(ringsOf(setup_), {WeightMethod::slicing}, scene);
    const double rotation = rotationTime(setup_);
    engine->advance(0.1 * rotation);
    for (int k = 1; k <= 200; ++k) {
      engine->advance((0.1 + 0.5 * k / 200.0) * rotation);
      const Snapshot now = engine->snapshot(ContactReport::instant);
      accumulator.add(now);
      torque_.push_back(*drivingTorque(scene, now, wheelName));
      pressure_.push_back(
          *radialPressure(scene, now, ringName, setup_.cell.outerRadius, setup_.cell.height));
    }
    profiles_ = accumulator.profiles();
  }

  static const Profile& profile(const std::string& field) {
    return *std::ranges::find(profiles_, field, &Profile::field);
  }

  static inline Case setup_;
  static inline std::vector<Profile> profiles_;
  static inline std::vector<double> torque_, pressure_;
};

TEST_F(ShearedCell, EveryRingCarriesTheWheelsTorque) {
  // Steady state, no bottom friction: (σ_φr + m v_r v_φ/V)·2πr²h = T at every ring.
  const Rings rings = ringsOf(setup_);
  const MeanEstimate wheel = estimateMean(torque_);
  ASSERT_GT(wheel.mean, 0.0);
  for (int ring = 0; ring < rings.count(); ++ring) {
    const auto k = static_cast<std::size_t>(ring);
    const double r = rings.centre(ring);
    const double factor = 2.0 * std::numbers::pi * r * r * rings.height();
    const double carried =
        (*profile("stress_pr").mean[k] + *profile("dynamic_stress_rp").mean[k]) * factor;
    // Three bars of both sides, and 1 % for the width of a ring in which σ falls as r⁻².
    const double bar =
        std::hypot(*profile("stress_pr").standardError[k] * factor, *wheel.standardError);
    EXPECT_NEAR(carried, wheel.mean, 3.0 * bar + 0.01 * wheel.mean) << "ring " << ring + 1;
    // Bars so wide that anything fits would prove nothing.
    EXPECT_LT(bar, 0.25 * wheel.mean) << "ring " << ring + 1;
  }
}

TEST_F(ShearedCell, RadialStressInTheOutermostRingIsThePressureOnTheWall) {
  // d(r σ_rr)/dr = σ_φφ < σ_rr lets σ_rr fall by some per cent from the ring's middle to the wall.
  const double wall = estimateMean(pressure_).mean;
  EXPECT_GT(*profile("stress_rr").mean.back(), wall);
  EXPECT_LT(*profile("stress_rr").mean.back(), 1.12 * wall);
}

TEST_F(ShearedCell, ShearsInABandAtTheWheel) {
  const double rim = setup_.cell.omega * setup_.cell.innerRadius;
  const Profile& velocity = profile("azimuthal_velocity");
  EXPECT_GT(*velocity.mean[0], 0.15 * rim);
  EXPECT_LT(*velocity.mean[0], rim);
  EXPECT_LT(*velocity.mean[2], 0.4 * *velocity.mean[0]);
  // The first layer rolls backwards on the wheel (claim C8).
  EXPECT_LT(*profile("spin").mean[0], -3.0 * *profile("spin").standardError[0]);
}

TEST_F(ShearedCell, FabricTraceIsVolumeFractionTimesCoordination) {
  // Also of time means, since C is the mean weighted with volume.
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_NEAR(*profile("fabric_trace").mean[k],
                *profile("volume_fraction").mean[k] * *profile("coordination").mean[k],
                1e-12 * *profile("fabric_trace").mean[k]);
}

}  // namespace
