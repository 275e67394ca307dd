// The thesis' cell blown up, at its least size, which takes a second to make.
#include "cases/scaled_cell.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "adapters/engine.hpp"
#include "cases/couette.hpp"
#include "cases/larger_scene.hpp"
#include "cases/loader.hpp"
#include "support/data_folder.hpp"
#include "support/scratch_folder.hpp"
#include "tests/support/refusal.hpp"

namespace {

using namespace crossgrain;

Case thesisCell() {
  return loadCase(dataFolder() / "cases/couette/nu-0.804.toml").front();
}

TEST(ScaledCell, RimAndProportionAreKept) {
  const Case thesis = thesisCell();
  const Case scaled = scaledCase(thesis, 1000);
  EXPECT_EQ(couetteIn(scaled).particles.small + couetteIn(scaled).particles.large, 1000);
  // 2511 small ones of 2921: 859.6 of a thousand.
  EXPECT_EQ(couetteIn(scaled).particles.small, 860);
  EXPECT_NEAR(couetteIn(scaled).cell.omega * couetteIn(scaled).cell.innerRadius,
              couetteIn(thesis).cell.omega * couetteIn(thesis).cell.innerRadius, 1e-15);
  EXPECT_NEAR(couetteIn(scaled).cell.outerRadius / couetteIn(scaled).cell.innerRadius,
              couetteIn(thesis).cell.outerRadius / couetteIn(thesis).cell.innerRadius, 1e-12);
}

TEST(ScaledCell, DisksAreSpreadOverTheRingAndHardlyOverlap) {
  const Case setup = scaledCase(thesisCell(), 1000);
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

/// The room between the walls' surfaces less half a small disk is filled alike: the maker's own
/// rule, as tests/bench/README.md has it.
TEST(ScaledCell, EverySize_HasTheSameVolumeFractionOfTheRoom) {
  const auto fractionOfTheRoom = [](const Case& setup) {
    const Cell& cell = couetteIn(setup).cell;
    const double lost = cell.wallRadius + 0.5 * couetteIn(setup).particles.smallRadius;
    const double inner = cell.innerRadius + lost, outer = cell.outerRadius - lost;
    const double ring = cell.outerRadius * cell.outerRadius - cell.innerRadius * cell.innerRadius;
    return volumeFraction(setup) * ring / (outer * outer - inner * inner);
  };
  const double first = fractionOfTheRoom(scaledCase(thesisCell(), 1000));
  for (const std::size_t disks : {10'000u, 100'000u, 1'000'000u, 10'000'000u}) {
    const Case scaled = scaledCase(thesisCell(), disks);
    EXPECT_EQ(couetteIn(scaled).particles.small + couetteIn(scaled).particles.large,
              static_cast<int>(disks));
    // Numbers of disks are whole: one of 1000 is 10⁻³.
    EXPECT_NEAR(fractionOfTheRoom(scaled), first, 1e-3 * first) << disks;
    EXPECT_NEAR(couetteIn(scaled).cell.omega * couetteIn(scaled).cell.innerRadius, 0.1032,
                1e-12);  // the rim's speed
  }
}

/// A disk at rest in a box of 3 x 2, periodic along both, with a wall disk that turns about itself.
Scene smallScene() {
  Scene scene;
  scene.disks = {{0.5}, {1.0}, {0.1}, {Vec2(1.0, 1.0)}, {Vec2(0.3, 0.0)}, {2.0}};
  WallBody& wheel = scene.bodies.emplace_back();
  wheel.name = "wheel";
  wheel.centre = Vec2(2.5, 1.0);
  wheel.diskPosition = {Vec2(2.5, 1.25)};
  wheel.diskRadius = {0.25};
  wheel.motion.kind = MotionKind::rotating;
  scene.box = BoxOf<2>{Vec2(0.0, 0.0), Vec2(3.0, 2.0), {true, true}};
  return scene;
}

TEST(LargerScene, PeriodicBox_GrowsByWholeCopiesAlongItsShortestSide) {
  const Scene six = besideItself(smallScene(), 6);  // 2: along y, then 4 > 3, 3: along x
  ASSERT_EQ(six.disks.size(), 6u);
  EXPECT_EQ(six.box->high, Vec2(9.0, 4.0));
  std::vector<std::pair<double, double>> places;
  for (const Vec2& at : six.disks.position) places.emplace_back(at.x(), at.y());
  std::ranges::sort(places);
  EXPECT_EQ(places, (std::vector<std::pair<double, double>>{
                        {1, 1}, {1, 3}, {4, 1}, {4, 3}, {7, 1}, {7, 3}}));
  EXPECT_EQ(six.disks.spin, std::vector<double>(6, 2.0));
  ASSERT_EQ(six.bodies.size(), 6u);  // each wheel turns about its own centre
  for (const WallBody& wheel : six.bodies)
    EXPECT_EQ(wheel.diskPosition.front(), Vec2(wheel.centre + Vec2(0.0, 0.25)));
}

TEST(LargerScene, WallsAndGravity_LeaveTheDirectionsThatTheyDoNotLieAcross) {
  Scene scene = smallScene();
  scene.box.reset();
  scene.gravity = Vec2(0.0, -9.81);
  scene.bodies.push_back({});
  scene.bodies.back().name = "floor";
  scene.bodies.back().planes = {{Vec2::Zero(), Vec2::UnitY()}};
  const Scene two = besideItself(scene, 2);
  // From 0.5 to 2.75 and a diameter of the largest, along x.
  EXPECT_EQ(two.disks.position.back(), Vec2(1.0 + 2.25 + 1.0, 1.0));
  EXPECT_EQ(two.bodies.size(), 3u);
  EXPECT_FALSE(two.box);
  scene.bodies.back().planes.push_back({Vec2::Zero(), Vec2::UnitX()});
  EXPECT_EQ(test::refusalOf<UnsupportedScene>([&] { besideItself(scene, 2); }),
            "the scene cannot be made larger: a plane of \"floor\" lies across x, gravity lies "
            "across y");
}

}  // namespace
