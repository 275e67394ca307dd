// The thesis' cell blown up, at its least size, which takes a second to make.
#include "cases/scaled_cell.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "cases/loader.hpp"
#include "support/data_folder.hpp"
#include "support/scratch_folder.hpp"

namespace {

using namespace crossgrain;

TEST(ScaledCell, RimAndProportionAreKept) {
  const Case thesis = loadCase(dataFolder() / "cases/couette/nu-0.804.toml").front();
  const Case scaled = scaledCase(1000);
  EXPECT_EQ(couetteIn(scaled).particles.small + couetteIn(scaled).particles.large, 1000);
  // 2511 small ones of 2921: 859.6 of a thousand.
  EXPECT_EQ(couetteIn(scaled).particles.small, 860);
  EXPECT_NEAR(couetteIn(scaled).cell.omega * couetteIn(scaled).cell.innerRadius,
              couetteIn(thesis).cell.omega * couetteIn(thesis).cell.innerRadius, 1e-15);
  EXPECT_NEAR(couetteIn(scaled).cell.outerRadius / couetteIn(scaled).cell.innerRadius,
              couetteIn(thesis).cell.outerRadius / couetteIn(thesis).cell.innerRadius, 1e-12);
}

TEST(ScaledCell, DisksAreSpreadOverTheRingAndHardlyOverlap) {
  const Case setup = scaledCase(1000);
  const ScratchFolder folder;
  const Packing packing = scaledPacking(setup, folder.path, [](double) {});
  const std::vector<Vec2>& at = packing.disks.position;
  ASSERT_EQ(at.size(), 1000u);
  double deepest = 0.0;
  int rightAbove = 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double r = at[i].norm(), a = packing.disks.radius[i];
    EXPECT_GT(r, couetteIn(setup).cell.innerRadius) << i;
    EXPECT_LT(r, couetteIn(setup).cell.outerRadius) << i;
    rightAbove += at[i].x() > 0.0 && at[i].y() > 0.0;
    for (std::size_t j = 0; j < i; ++j)
      deepest = std::max(deepest, (a + packing.disks.radius[j] - (at[i] - at[j]).norm()) / a);
  }
  EXPECT_LT(deepest, 0.05);          // of a radius; 0.023 was seen
  EXPECT_NEAR(rightAbove, 250, 10);  // a quarter
}

}  // namespace
